// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/predict/region_predictor.hpp"

#include "number_of_query.hpp"

namespace lrrt {

std::vector<Prediction> RegionPredictor::predict_many(const OccupancyMap& map,
                                                      const std::vector<RegionQuery>& queries) const {
  std::vector<Prediction> predictions;
  predictions.reserve(queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    naming_query(i, [&] { predictions.push_back(predict(map, queries[i].start, queries[i].goal)); });
  }
  return predictions;
}

}  // namespace lrrt
