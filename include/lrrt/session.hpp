// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "lrrt/planner.hpp"

namespace lrrt {

/// Where a robot is and where it shall go.
struct Query {
  Eigen::Vector2d start;       ///< map units
  Eigen::Vector2d goal;        ///< map units
  double start_heading = 0.0;  ///< radians, see PlanRequest
  double goal_heading = 0.0;   ///< the same
};

/// Many queries of one robot on one map, which may change a little from one to the next.
///
/// What does not change from query to query is made once: grown obstacles, the distance field, components, larger
/// pixels. And a path is good for more than one query: replan() keeps what is still free of it.
///
/// Not for concurrent use; a session for each thread may share one predictor.
class Session {
 public:
  /// @param robot the map, which is copied, and the robot; start, goal and cancel token do not matter.
  Session(Planner planner, const PlanRequest& robot);
  /// Forgets everything.
  ~Session();
  /// Moves a session with all that it knows.
  Session(Session&&) noexcept;
  /// Moves a session with all that it knows.
  Session& operator=(Session&&) noexcept;

  /// The map as it is now.
  const OccupancyMap& map() const;

  /// Plans as Planner::plan() does, with the same result.
  /// @throws RequestError as Planner::plan(). @throws ModelError likewise.
  PlanResult plan(const Query& query, const CancelToken& cancel = {});

  /// Plans many queries; their regions are predicted together, see RegionPredictor::predict_many. The results are those
  /// of plan(), in the order of the queries, and the last one is what replan() goes on from. The time of preparing
  /// together is the first result's.
  /// @throws RequestError as plan(), and then there is no result. @throws ModelError likewise.
  std::vector<PlanResult> plan(const std::vector<Query>& queries, const CancelToken& cancel = {});

  /// Plans from where the robot is now to the goal of the last query, along the path of the last result as far as it is
  /// still free: ways to that path, and around what stands on it since, are planned near by, unguided, by RRT-Connect
  /// (RRT where the robot only drives forwards). Where there is no such path, a way near by is not found, or the robot
  /// is driven (Motion::unicycle, Motion::car) or shall keep a clearance, plans as
  /// plan() does. PlanResult::reused tells how much was kept. A path that became longer than it would have to be is
  /// kept, too; plan() looks anew. A call that is cancelled leaves the path of the last result for the next one.
  /// @param start map units. @param heading radians.
  /// @throws RequestError when there was no query yet, else as plan().
  PlanResult replan(const Eigen::Vector2d& start, double heading = 0.0, const CancelToken& cancel = {});

  /// The map has changed.
  /// @param part the map as it is now, or a part of it: of the same resolution, its pixels on those of the map.
  /// @throws MapError when they are not, or the part leaves the map.
  void update(const OccupancyMap& part);

 private:
  class Memory;
  std::unique_ptr<Memory> memory_;
};

}  // namespace lrrt
