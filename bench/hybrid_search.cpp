// SPDX-License-Identifier: BSD-3-Clause
#include "hybrid_search.hpp"

#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <queue>
#include <string>
#include <utility>

#include "lrrt/map/footprint.hpp"
#include "lrrt/region/geodesic.hpp"
#include "rival.hpp"
#include "robot.hpp"

namespace lrrt::bench {
namespace {

namespace ob = ompl::base;

constexpr double tau = 6.283185307179586;
constexpr int headings = 24;
constexpr double heading_step = tau / headings;
/// What the distance that is left counts, to one of the length so far.
constexpr double haste = 2.0;

double checked(double turning_radius, const OccupancyMap& map) {
  const double pixels = turning_radius / map.resolution();
  if (pixels >= 0.25 && pixels <= 1e6) return turning_radius;
  throw SuiteError(std::string(hybrid_search_name) + ": a turning radius of " + std::to_string(pixels) +
                   " pixels: expected one of a quarter of a pixel to a million; is 'scale' right?");
}

std::shared_ptr<ob::SE2StateSpace> space_for(Motion motion, double turning_radius) {
  if (motion == Motion::dubins) return std::make_shared<ForwardSpace>(turning_radius);
  return std::make_shared<ob::ReedsSheppStateSpace>(turning_radius);
}

}  // namespace

/// One search: its open and closed poses.
class HybridRun {
 public:
  HybridRun(const HybridSearch& search, const OccupancyMap& room, const Pose2& start, const Pose2& goal)
      : search_(search),
        room_(room),
        goal_(goal),
        walk_(room_.free_mask(), room_.width(), room_.height(), pixel(goal)),
        from_(search.space_),
        to_(search.space_) {
    const double arc = search.radius_ * heading_step;
    cell_ = std::max(room_.resolution(), arc / std::sqrt(2.0));
    turns_ = std::max(1, static_cast<int>(std::ceil(std::sqrt(2.0) * cell_ / arc - 1e-9)));  // a step leaves its cell
    step_ = arc * turns_;
    columns_ = static_cast<std::size_t>(std::ceil(room_.width() * room_.resolution() / cell_)) + 1;
    const auto rows = static_cast<std::size_t>(std::ceil(room_.height() * room_.resolution() / cell_)) + 1;
    closed_.resize(columns_ * rows * headings, false);
    if (reaches_goal(start)) add({start, 0, none, 0.0, {0.0, 0.0}});
  }

  CarWay run(const std::function<bool()>& ended) {
    for (std::size_t tried = 0; !open_.empty() && !ended(); ++tried) {
      const std::size_t at = open_.top().second;
      open_.pop();
      if (!close(nodes_[at])) continue;
      if (const std::optional<Shot> shot = shot_from(nodes_[at].pose, tried)) return told(at, *shot);
      spread(at);
    }
    return {};
  }

 private:
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  struct Arc {
    double length;
    double curvature;
  };
  struct Node {
    Pose2 pose;
    int heading;  ///< steps from that of the start, 0 to 23
    std::size_t parent;
    double length;  ///< up to here
    Arc arc;        ///< that led here
  };
  /// A free curve to the goal.
  struct Shot {
    PoseMotion curve;
    double length;
  };

  Pixel pixel(const Pose2& pose) const { return OccupancyMap::pixel_of(room_.to_pixel({pose.x, pose.y})); }
  bool reaches_goal(const Pose2& pose) const { return walk_.at(pixel(pose)) != Geodesic::unreached; }
  double remaining(const Pose2& pose) const { return walk_.at(pixel(pose)) * Geodesic::unit * room_.resolution(); }

  void add(const Node& node) {
    open_.emplace(node.length + haste * remaining(node.pose), nodes_.size());
    nodes_.push_back(node);
  }

  std::size_t cell(const Node& node) const {
    const Eigen::Vector2d place = room_.to_pixel({node.pose.x, node.pose.y}) * room_.resolution() / cell_;
    const auto column = static_cast<std::size_t>(place.x());
    const auto row = static_cast<std::size_t>(place.y());
    return (row * columns_ + column) * headings + static_cast<std::size_t>(node.heading);
  }

  /// @return false where another pose was first.
  bool close(const Node& node) {
    const std::size_t at = cell(node);
    if (closed_[at]) return false;
    closed_[at] = true;
    return true;
  }

  PoseMotion motion(const Pose2& from, const Arc& arc) const {
    const Pose2 to = along_arc(from, arc.length, arc.length * arc.curvature);
    PoseMotion motion(from, to, search_.body_->outline().circumscribed_radius());
    motion.append(arc.length, arc.curvature);
    return motion;
  }

  /// Adds the poses that lie a step ahead, and behind.
  void spread(std::size_t at) {
    const Node from = nodes_[at];
    for (const double length : {step_, -step_}) {
      if (length < 0.0 && !search_.reverse_) break;
      for (const int side : {0, 1, -1}) {
        const Arc arc{length, side / search_.radius_};
        const int turn = length > 0.0 ? side * turns_ : -side * turns_;
        const int heading = ((from.heading + turn) % headings + headings) % headings;
        const Node next{along_arc(from.pose, length, length * arc.curvature), heading, at, from.length + step_, arc};
        if (!reaches_goal(next.pose) || closed_[cell(next)]) continue;
        if (search_.body_->is_free(motion(from.pose, arc))) add(next);
      }
    }
  }

  /// The shortest curve to the goal where it is free: tried the more often, the nearer it is.
  std::optional<Shot> shot_from(const Pose2& pose, std::size_t tried) {
    const auto pause = static_cast<std::size_t>(remaining(pose) / (2.0 * search_.radius_));
    if (tried % (pause + 1) != 0) return std::nullopt;
    const auto write = [](const Pose2& from, ob::ScopedState<>& state) {
      auto* values = state->as<ob::SE2StateSpace::StateType>();
      values->setXY(from.x, from.y);
      values->setYaw(std::remainder(from.yaw, tau));
    };
    write(pose, from_);
    write(goal_, to_);
    const PoseMotion curve = search_.steering_.between(from_.get(), to_.get());
    if (!search_.body_->is_free(curve)) return std::nullopt;
    return Shot{curve, search_.space_->distance(from_.get(), to_.get())};
  }

  CarWay told(std::size_t at, const Shot& shot) const {
    std::vector<std::size_t> nodes;
    for (std::size_t i = at; i != none; i = nodes_[i].parent) nodes.push_back(i);
    std::reverse(nodes.begin(), nodes.end());
    CarWay way{{nodes_[nodes.front()].pose}, nodes_[at].length + shot.length};
    const auto append = [&](const PoseMotion& motion) {
      for (const double t : motion.moments(room_.resolution())) way.poses.push_back(motion.at(t));
    };
    for (std::size_t i = 1; i < nodes.size(); ++i) append(motion(nodes_[nodes[i - 1]].pose, nodes_[nodes[i]].arc));
    append(shot.curve);
    way.poses.back() = goal_;
    return way;
  }

  const HybridSearch& search_;
  const OccupancyMap& room_;
  Pose2 goal_;
  Geodesic walk_;  ///< from the goal
  double cell_;    ///< side, map units
  int turns_;      ///< headings that a step turns by on an arc
  double step_;    ///< length, map units
  std::size_t columns_;
  std::vector<bool> closed_;
  std::vector<Node> nodes_;
  using Rank = std::pair<double, std::size_t>;
  std::priority_queue<Rank, std::vector<Rank>, std::greater<>> open_;
  ob::ScopedState<> from_;
  ob::ScopedState<> to_;
};

HybridSearch::HybridSearch(std::shared_ptr<const CollisionBody> body, Motion motion, double turning_radius)
    : body_(std::move(body)),
      reverse_(motion == Motion::reeds_shepp),
      radius_(checked(turning_radius, body_->map()->map())),
      space_(space_for(motion, turning_radius)),
      steering_(*space_, body_->outline().circumscribed_radius()) {}

CarWay HybridSearch::find(const Pose2& start, const Pose2& goal, const std::function<bool()>& ended) const {
  const OccupancyMap& map = body_->map()->map();
  const double inscribed = body_->outline().inscribed_radius();
  const OccupancyMap room = inflated(map, inscribed);
  CarWay way = HybridRun(*this, room, start, goal).run(ended);
  if (!way.poses.empty() || ended()) return way;
  // inflated() asks the worst point of each pixel: it closes no more than a diagonal too much
  const OccupancyMap crevices = inflated(map, std::max(0.0, inscribed - std::sqrt(2.0) * map.resolution()));
  return HybridRun(*this, crevices, start, goal).run(ended);
}

PlanResult hybrid_search(const Problem& problem, const PlanSuite& suite, const PlanRow& row,
                         const CancelToken& cancel) {
  RivalRun run(row, cancel);
  const auto body = body_on(planning_map(problem, suite), outline_at(suite, problem.scale).value());
  const auto blocked = blocked_end(problem, [&](const Pose2& pose) { return body->is_free(pose); });
  if (blocked) return run.failed(*blocked);
  const HybridSearch search(body, motion_from_string(row.motion), row.turning_radius * problem.scale);
  run.prepared();
  std::size_t tried = 0;
  bool over = false;
  const CarWay way = search.find(start_of(problem), goal_of(problem), [&] {
    over = over || tried >= row.options.iteration_limit || (tried % 64 == 0 && run.over());
    if (!over) ++tried;
    return over;
  });
  if (way.poses.empty()) return run.failed(PlanStatus::iteration_limit, tried);
  std::vector<Eigen::Vector2d> path;
  std::vector<double> yaws;
  for (const Pose2& pose : way.poses) {
    path.emplace_back(pose.x, pose.y);
    yaws.push_back(wrapped_angle(pose.yaw));
  }
  return run.solved(std::move(path), std::move(yaws), way.length, tried);
}

}  // namespace lrrt::bench
