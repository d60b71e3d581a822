// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hybrid_search.hpp"
#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/sampling/random.hpp"
#include "suite.hpp"

namespace lrrt::bench {

/// A map of a suite and, where it is a maze, the ends of its longest way.
struct NamedMap {
  std::string name;
  std::filesystem::path file;  ///< empty for a generated one
  std::shared_ptr<const OccupancyMap> map;
  std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> ends;
};

/// Start and goal with a name. Headings are 0 where there are none.
struct Query {
  std::string name;
  Pose2 start;
  Pose2 goal;
};

/// Where a suite's robot may stand on one map.
class Ground {
 public:
  /// @param map with unknown pixels. @param suite must outlive this. @param scale see MapSource.
  Ground(const OccupancyMap& map, const PlanSuite& suite, double scale);

  /// The map in which the largest disc around the reference point that the robot holds is a point. Places that are not
  /// joined here are not joined for the robot.
  const OccupancyMap& room() const { return room_; }
  bool has_headings() const { return suite_.has_headings(); }
  /// A place and, where there are headings, a random one. @return nothing where the robot touches something.
  std::optional<Pose2> draw(const Eigen::Vector2d& place, Random& random) const;
  /// The same for the centre of a pixel of the room.
  std::optional<Pose2> draw(Pixel pixel, Random& random) const { return draw(room_.center(pixel), random); }
  /// What tells whether a car can drive from pose to pose: that of the suite's first row with the motion. There is one,
  /// and an outline.
  HybridSearch car(const std::string& motion) const;

 private:
  const PlanSuite& suite_;
  double scale_;
  OccupancyMap room_;
  std::shared_ptr<const CollisionBody> body_;  ///< null without an outline
};

/// The queries that a source draws on a map. The same arguments give the same queries.
/// @throws SuiteError when the robot has no room, or a scenario list is for another map.
std::vector<Query> queries_of(const QuerySource& source, const NamedMap& named, const Ground& ground,
                              const Suite& suite);

}  // namespace lrrt::bench
