// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <vector>

#include "lrrt/map/distance_field.hpp"
#include "lrrt/map/swept_footprint.hpp"
#include "lrrt/ompl/pose_motion.hpp"
#include "lrrt/sampling/random.hpp"
#include "scenes.hpp"

namespace lrrt::micro {
namespace {

constexpr int side = 512;
constexpr double pi = 3.141592653589793;
constexpr double turning_radius = 10.0;
/// So many that a processor cannot learn them by heart.
constexpr std::size_t count = 1024;

using RobotMaker = Polygon (*)();

Polygon rectangle() {
  return Polygon::rectangle(10.0, 7.0, 3.0);
}

/// An L of the same size.
Polygon concave() {
  return Polygon({{7.0, -3.5}, {7.0, 3.5}, {2.0, 3.5}, {2.0, 1.0}, {-3.0, 1.0}, {-3.0, -3.5}});
}

struct Robot {
  Robot(SceneMaker scene, RobotMaker outline)
      : map(scene(side).map), field(map), walk(map, field, outline()), reach(walk.polygon().circumscribed_radius()) {}

  Pose2 draw(Random& random) const {
    const double x = random.uniform(0.0, side);
    const double y = random.uniform(0.0, side);
    return {x, y, random.uniform(-pi, pi)};
  }
  bool is_free(const PoseMotion& motion) const {
    return walk.is_free([&](double t) { return motion.at(t); }, motion.speed());
  }

  const OccupancyMap& map;
  DistanceField field;
  FootprintWalk walk;
  double reach;
};

/// A random pose in the map.
void footprint_pose(benchmark::State& state, SceneMaker scene, RobotMaker outline) {
  const Robot robot(scene, outline);
  Random random(1);
  std::vector<Pose2> poses;
  while (poses.size() < count) poses.push_back(robot.draw(random));
  time_checks(state, poses, [&](const Pose2& at) { return robot.walk.is_free(at); });
}

/// An arc between free poses: the tightest turn, all of it free or not.
void footprint_arc(benchmark::State& state, SceneMaker scene, RobotMaker outline, double length, bool free = true) {
  const Robot robot(scene, outline);
  Random random(1);
  std::vector<PoseMotion> motions;
  while (motions.size() < count) {
    const Pose2 from = robot.draw(random);
    const Pose2 to = along_arc(from, length, length / turning_radius);
    PoseMotion motion(from, to, robot.reach);
    motion.append(length, 1.0 / turning_radius);
    if (robot.walk.is_free(from) && robot.walk.is_free(to) && robot.is_free(motion) == free) motions.push_back(motion);
  }
  time_checks(state, motions, [&](const PoseMotion& motion) { return robot.is_free(motion); });
}

BENCHMARK_CAPTURE(footprint_pose, clutter_rectangle, clutter, rectangle)->Name("footprint/pose/clutter/rectangle");
BENCHMARK_CAPTURE(footprint_pose, clutter_concave, clutter, concave)->Name("footprint/pose/clutter/concave");
BENCHMARK_CAPTURE(footprint_pose, maze_rectangle, maze, rectangle)->Name("footprint/pose/maze/rectangle");
BENCHMARK_CAPTURE(footprint_pose, maze_concave, maze, concave)->Name("footprint/pose/maze/concave");
BENCHMARK_CAPTURE(footprint_arc, open_rectangle_short, open_space, rectangle, 10.0)
    ->Name("footprint/arc/open/rectangle/short");
BENCHMARK_CAPTURE(footprint_arc, clutter_rectangle_short, clutter, rectangle, 10.0)
    ->Name("footprint/arc/clutter/rectangle/short");
BENCHMARK_CAPTURE(footprint_arc, clutter_rectangle_long, clutter, rectangle, 40.0)
    ->Name("footprint/arc/clutter/rectangle/long");
BENCHMARK_CAPTURE(footprint_arc, clutter_rectangle_blocked, clutter, rectangle, 40.0, false)
    ->Name("footprint/arc/clutter/rectangle/blocked");
BENCHMARK_CAPTURE(footprint_arc, clutter_concave_short, clutter, concave, 10.0)
    ->Name("footprint/arc/clutter/concave/short");
BENCHMARK_CAPTURE(footprint_arc, clutter_concave_long, clutter, concave, 40.0)
    ->Name("footprint/arc/clutter/concave/long");
BENCHMARK_CAPTURE(footprint_arc, maze_rectangle_short, maze, rectangle, 10.0)
    ->Name("footprint/arc/maze/rectangle/short");

}  // namespace
}  // namespace lrrt::micro
