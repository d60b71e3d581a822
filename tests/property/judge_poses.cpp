// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "footprint_oracle.hpp"
#include "judge.hpp"
#include "support.hpp"

namespace lrrt::property {
namespace {

using Eigen::Vector2d;

constexpr double pi = 3.14159265358979323846;
/// Poses that are looked at between two of the path.
constexpr int between = 10;
/// What curves that miss their ends by rounding may be off, pixels.
constexpr double hair = 1e-4;
/// A robot without an outline is a point; the library takes this for one, pixels.
constexpr double speck = 2e-6;

double to_origin(const Vector2d& a, const Vector2d& b) {
  const double t = std::clamp(-a.dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (a + t * (b - a)).norm();
}

/// Distances from the reference point, on or in the outline, to its nearest and its farthest point, map units.
struct Reach {
  double inner = 0.0;
  double outer = 0.0;
};

Reach reach_of(const PlanRequest& request) {
  if (!request.outline) return {};
  const std::vector<Vector2d>& corners = request.outline->vertices();
  Reach reach{std::numeric_limits<double>::infinity(), 0.0};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    reach.inner = std::min(reach.inner, to_origin(corners[i], corners[(i + 1) % corners.size()]));
    reach.outer = std::max(reach.outer, corners[i].norm());
  }
  return reach;
}

/// The robot of a query and what it touches.
class Robot {
 public:
  explicit Robot(const Query& query)
      : ground_(query.ground()),
        point_(!query.request().outline),
        oracle_(ground_.framed(), point_ ? std::vector<Vector2d>{{1.0, 0.0}, {-1.0, 1.0}, {-1.0, -1.0}}
                                         : query.request().outline->vertices()) {}

  bool is_free(const Pose2& pose) const { return point_ ? room(pose) > 0.0 : oracle_.is_free(pose); }
  /// Whether nothing is so near that rounding counts.
  bool is_clearly_free(const Pose2& pose) const { return point_ ? room(pose) > speck : oracle_.keeps(pose, 1e-6); }
  /// Whether the robot touches something at a pose and at all poses a hair away.
  bool is_clearly_not_free(const Pose2& pose) const {
    const double nudge = 2.0 * hair * ground_.framed().resolution();
    for (int k = 0; k < 9; ++k) {
      if (is_free({pose.x + (k % 3 - 1) * nudge, pose.y + (k / 3 - 1) * nudge, pose.yaw})) return false;
    }
    return true;
  }

 private:
  double room(const Pose2& pose) const { return clearance(ground_.grown(), ground_.to_pixel({pose.x, pose.y}), 0.1); }

  const Ground& ground_;
  bool point_;
  test::FootprintOracle oracle_;
};

/// One step of a path: a straight line with an even turn, or one arc.
struct Step {
  Pose2 from;
  Vector2d move;
  double turn;
  bool arc;

  /// Length of the arc, negative backwards.
  double length() const {
    const double half = 0.5 * turn;
    const double whole = half == 0.0 ? move.norm() : move.norm() * half / std::sin(half);
    const double course = from.yaw + half;
    return std::copysign(whole, std::cos(course) * move.x() + std::sin(course) * move.y());
  }
  Pose2 at(double t) const {
    if (!arc) return {from.x + t * move.x(), from.y + t * move.y(), from.yaw + t * turn};
    const double half = 0.5 * turn * t;
    const double chord = length() * t * (half == 0.0 ? 1.0 : std::sin(half) / half);
    return {from.x + chord * std::cos(from.yaw + half), from.y + chord * std::sin(from.yaw + half),
            from.yaw + t * turn};
  }
  /// Why a robot that drives along its heading cannot do this; empty where it can.
  std::string not_drivable(const PlanRequest& request) const {
    const double slack = hair * request.map.get().resolution();
    const Vector2d ahead(std::cos(from.yaw + 0.5 * turn), std::sin(from.yaw + 0.5 * turn));
    if (std::abs(ahead.x() * move.y() - ahead.y() * move.x()) > slack) return "goes sideways";
    if (request.motion == Motion::dubins && ahead.dot(move) < -slack) return "goes backwards";
    if (std::abs(turn) * request.turning_radius > std::abs(length()) + slack) return "turns too tightly";
    return {};
  }
};

std::string at(std::size_t i, const std::string& what) {
  return "step " + std::to_string(i) + ' ' + what;
}

/// Whether some point of every pixel on a way from start to goal leaves room for the disc that the outline holds.
bool room_all_along(const Query& query) {
  const Ground& ground = query.ground();
  const OccupancyMap& map = ground.grown();
  const double needed = reach_of(query.request()).inner / query.request().map.get().resolution() + 1e-6;
  const Pixel start = OccupancyMap::pixel_of(ground.to_pixel(query.request().start));
  const Pixel goal = OccupancyMap::pixel_of(ground.to_pixel(query.request().goal));
  const auto has_room = [&](Pixel p) {
    for (int k = 0; k < 49; ++k) {
      if (clearance(map, {p.c + (k % 7) / 6.0, p.r + (k / 7) / 6.0}, needed) >= needed) return true;
    }
    return p == start || p == goal;
  };
  std::vector<Cell> cells(map.size(), Cell::occupied);
  for (int r = 0; r < map.height(); ++r) {
    for (int c = 0; c < map.width(); ++c) {
      if (map.is_free({c, r}) && has_room({c, r})) cells[map.index({c, r})] = Cell::free;
    }
  }
  return test::flood(map.with_cells(std::move(cells)), start)[map.index(goal)] != 0;
}

}  // namespace

std::string judge_pose_status(const Query& query, PlanStatus status) {
  const PlanRequest& request = query.request();
  const Robot robot(query);
  const Pose2 start{request.start.x(), request.start.y(), request.start_heading};
  const Pose2 goal{request.goal.x(), request.goal.y(), request.goal_heading};
  if (status == PlanStatus::start_outside || status == PlanStatus::goal_outside) return "an end inside called outside";
  if (status == PlanStatus::start_occupied) return robot.is_clearly_free(start) ? "a free start called occupied" : "";
  if (!robot.is_free(start)) return std::string("status ") + to_string(status) + " where the start is occupied";
  if (status == PlanStatus::goal_occupied) return robot.is_clearly_free(goal) ? "a free goal called occupied" : "";
  if (!robot.is_free(goal)) return std::string("status ") + to_string(status) + " where the goal is occupied";
  if (status == PlanStatus::not_connected) {
    return room_all_along(query) ? "not_connected where there is room all along a way" : "";
  }
  const OccupancyMap& map = query.ground().grown();
  const std::size_t end = map.index(OccupancyMap::pixel_of(query.ground().to_pixel(request.goal)));
  const bool joined = test::flood(map, OccupancyMap::pixel_of(query.ground().to_pixel(request.start)))[end] != 0;
  return joined ? "" : std::string("status ") + to_string(status) + " where not_connected is true";
}

std::string judge_poses(const Query& query, const PlanResult& result) {
  const PlanRequest& request = query.request();
  const double pixel = request.map.get().resolution();
  const double reach = std::max(pixel, reach_of(request).outer + request.radius);
  const bool arc = request.motion != Motion::turning;
  const Robot robot(query);
  if (std::abs(std::remainder(result.headings.front() - request.start_heading, 2.0 * pi)) > 1e-12) {
    return "a path that begins with another heading";
  }
  if (query.options().goal_tolerance == 0.0 &&
      std::abs(std::remainder(result.headings.back() - request.goal_heading, 2.0 * pi)) > 1e-12) {
    return "a path that ends with another heading";
  }
  double cost = 0.0;
  for (std::size_t i = 0; i < result.path.size(); ++i) {
    if (!robot.is_free({result.path[i].x(), result.path[i].y(), result.headings[i]})) return at(i, "is not free");
    if (i == 0) continue;
    const Step step{{result.path[i - 1].x(), result.path[i - 1].y(), result.headings[i - 1]},
                    result.path[i] - result.path[i - 1],
                    std::remainder(result.headings[i] - result.headings[i - 1], 2.0 * pi),
                    arc};
    if (arc && !step.not_drivable(request).empty()) return at(i, step.not_drivable(request));
    if (step.move.norm() + reach * std::abs(step.turn) > pixel * (1.0 + hair)) return at(i, "is longer than a pixel");
    for (int k = 1; k < between; ++k) {
      if (robot.is_clearly_not_free(step.at(static_cast<double>(k) / between))) return at(i, "is not free on the way");
    }
    cost += arc ? std::abs(step.length()) : step.move.norm() + reach * std::abs(step.turn);
  }
  if (std::abs(cost - result.cost) > 1e-3 * pixel + 1e-6 * cost) return "a cost that is not the path's";
  return {};
}

}  // namespace lrrt::property
