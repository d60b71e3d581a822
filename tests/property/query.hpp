// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "ground.hpp"
#include "lrrt/plan.hpp"
#include "lrrt/predict/region_predictor.hpp"

namespace lrrt::property {

/// A query that its number decides: map, robot, ends, planner, strategy, region, limits.
class Query {
 public:
  explicit Query(std::uint64_t number);
  Query(const Query&) = delete;
  Query& operator=(const Query&) = delete;

  const PlanRequest& request() const { return *request_; }
  const PlanOptions& options() const { return options_; }
  const std::shared_ptr<const RegionPredictor>& predictor() const { return predictor_; }
  const Ground& ground() const { return *ground_; }
  /// What the query is like, for a report.
  std::string words() const;

 private:
  void choose_robot(Random& random);
  void choose_ends(Random& random);
  void choose_options(Random& random);
  void make_region(Random& random);
  Eigen::Vector2d random_pixel_point(Random& random) const;
  Pose2 random_end(Random& random) const;
  bool fits(const Pose2& pose) const;

  std::string family_;
  std::string region_;
  std::unique_ptr<OccupancyMap> map_;
  std::unique_ptr<PlanRequest> request_;
  std::unique_ptr<Ground> ground_;
  std::vector<Pixel> open_;  ///< where the reference point may be
  PlanOptions options_;
  std::shared_ptr<const RegionPredictor> predictor_;
};

/// The motion as a word.
const char* word(Motion motion);

}  // namespace lrrt::property
