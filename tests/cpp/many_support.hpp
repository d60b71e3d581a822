// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "lrrt/error.hpp"
#include "lrrt/predict/region_predictor.hpp"
#include "support.hpp"

namespace lrrt::test {

/// Queries between random free pixels of a map, which need not be joined.
inline std::vector<RegionQuery> random_queries(const OccupancyMap& map, std::size_t count, Random& random) {
  std::vector<RegionQuery> queries(count);
  for (RegionQuery& query : queries) query = {random_free_point(map, random), random_free_point(map, random)};
  return queries;
}

/// Expects the regions of predict(), one by one, in the order of the queries.
/// @param tolerance of a probability; where it is 0 everything has to be the same.
/// @return the sides of the network's pictures.
inline std::set<int> expect_one_by_one(const RegionPredictor& predictor, const OccupancyMap& map,
                                       const std::vector<RegionQuery>& queries, float tolerance = 0.0F) {
  std::set<int> sides;
  const std::vector<Prediction> many = predictor.predict_many(map, queries);
  EXPECT_EQ(many.size(), queries.size());
  for (std::size_t i = 0; i < many.size(); ++i) {
    const Prediction one = predictor.predict(map, queries[i].start, queries[i].goal);
    EXPECT_EQ(many[i].input_side, one.input_side) << i;
    sides.insert(many[i].input_side);
    const std::vector<float>& expected = one.region.probability();
    const std::vector<float>& got = many[i].region.probability();
    EXPECT_EQ(got.size(), expected.size());
    if (tolerance > 0.0F) {
      for (std::size_t k = 0; k < got.size(); ++k) EXPECT_NEAR(got[k], expected[k], tolerance) << i;
      continue;
    }
    EXPECT_EQ(got, expected) << i;
    EXPECT_EQ(many[i].region.mask(), one.region.mask()) << i;
    EXPECT_EQ(many[i].region.connected(), one.region.connected()) << i;
    EXPECT_EQ(many[i].region.link_area(), one.region.link_area()) << i;
  }
  return sides;
}

/// The text of the RequestError that queries are refused with.
inline std::string refusal_of(const RegionPredictor& predictor, const OccupancyMap& map,
                              const std::vector<RegionQuery>& queries) {
  try {
    predictor.predict_many(map, queries);
  } catch (const RequestError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace lrrt::test
