// SPDX-License-Identifier: BSD-3-Clause
#include "hybrid_search.hpp"

#include <ompl/base/ScopedState.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <queue>
#include <utility>

#include "lrrt/map/footprint.hpp"
#include "lrrt/region/geodesic.hpp"
#include "lrrt/stopwatch.hpp"
#include "robot.hpp"

namespace lrrt::bench {
namespace {

namespace ob = ompl::base;

constexpr int headings = 24;
constexpr double angle = 6.283185307179586 / headings;
/// What the distance that is left counts, to one of the length so far: ways need not be shortest, but soon.
constexpr double haste = 2.0;

std::shared_ptr<ob::SE2StateSpace> space_for(Motion motion, double turning_radius) {
  if (motion == Motion::dubins) return std::make_shared<ForwardSpace>(turning_radius);
  return std::make_shared<ob::ReedsSheppStateSpace>(turning_radius);
}

}  // namespace

/// One search: its open and closed poses.
class HybridRun {
 public:
  HybridRun(const HybridSearch& search, const Pose2& start, const Pose2& goal)
      : search_(search),
        room_(search.room_),
        goal_(goal),
        left_(room_.free_mask(), room_.width(), room_.height(), pixel(goal)),
        from_(search.space_),
        to_(search.space_) {
    const double arc = search.radius_ * angle;
    cell_ = std::max(room_.resolution(), arc / std::sqrt(2.0));
    const int turns = std::max(1, static_cast<int>(std::ceil(std::sqrt(2.0) * cell_ / arc - 1e-9)));
    step_ = arc * turns;
    turns_ = turns;
    columns_ = static_cast<std::size_t>(std::ceil(room_.width() * room_.resolution() / cell_)) + 1;
    rows_ = static_cast<std::size_t>(std::ceil(room_.height() * room_.resolution() / cell_)) + 1;
    closed_.resize(columns_ * rows_ * headings, false);
    add({start, 0, none, 0.0, {0.0, 0.0}});
  }

  CarWay run(const std::function<bool(std::size_t)>& ended) {
    for (std::size_t tried = 0; !open_.empty() && !ended(tried); ++tried) {
      const std::size_t at = open_.top().second;
      open_.pop();
      if (!close(nodes_[at])) continue;
      if (std::optional<PoseMotion> last = shot(nodes_[at], tried)) return told(at, *last);
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
    int heading;  ///< steps of 15° from that of the start
    std::size_t parent;
    double length;  ///< up to here
    Arc arc;        ///< that led here
  };

  Pixel pixel(const Pose2& pose) const { return OccupancyMap::pixel_of(room_.to_pixel({pose.x, pose.y})); }

  double left(const Pose2& pose) const { return left_.at(pixel(pose)) * Geodesic::unit * room_.resolution(); }

  void add(const Node& node) {
    open_.emplace(node.length + haste * left(node.pose), nodes_.size());
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

  void spread(std::size_t at) {
    const Node from = nodes_[at];
    for (const double length : {step_, -step_}) {
      if (length < 0.0 && !search_.reverse_) break;
      for (const int side : {0, 1, -1}) {
        const Arc arc{length, side / search_.radius_};
        const int turn = length > 0.0 ? side * turns_ : -side * turns_;
        Node next{along_arc(from.pose, length, length * arc.curvature), (from.heading + turn + headings * 4) % headings,
                  at, from.length + step_, arc};
        if (!room_.is_free(pixel(next.pose)) || left_.at(pixel(next.pose)) == Geodesic::unreached) continue;
        if (closed_[cell(next)] || !search_.body_->is_free(motion(from.pose, arc))) continue;
        add(next);
      }
    }
  }

  /// The shortest curve to the goal where it is free: tried the more often, the nearer it is.
  std::optional<PoseMotion> shot(const Node& node, std::size_t tried) {
    const auto pause = static_cast<std::size_t>(left(node.pose) / (2.0 * search_.radius_));
    if (tried % (pause + 1) != 0) return std::nullopt;
    const auto write = [](const Pose2& pose, ob::ScopedState<>& state) {
      auto* values = state->as<ob::SE2StateSpace::StateType>();
      values->setXY(pose.x, pose.y);
      values->setYaw(std::remainder(pose.yaw, headings * angle));
    };
    write(node.pose, from_);
    write(goal_, to_);
    PoseMotion curve = search_.steering_.between(from_.get(), to_.get());
    if (!search_.body_->is_free(curve)) return std::nullopt;
    last_ = search_.space_->distance(from_.get(), to_.get());
    return curve;
  }

  CarWay told(std::size_t at, const PoseMotion& last) const {
    std::vector<std::size_t> nodes;
    for (std::size_t i = at; i != none; i = nodes_[i].parent) nodes.push_back(i);
    std::reverse(nodes.begin(), nodes.end());
    CarWay way{{nodes_.front().pose}, nodes_[at].length + last_};
    const auto append = [&](const PoseMotion& motion) {
      for (const double t : motion.moments(room_.resolution())) way.poses.push_back(motion.at(t));
    };
    for (std::size_t i = 1; i < nodes.size(); ++i) append(motion(nodes_[nodes[i - 1]].pose, nodes_[nodes[i]].arc));
    append(last);
    way.poses.back() = goal_;
    return way;
  }

  const HybridSearch& search_;
  const OccupancyMap& room_;
  Pose2 goal_;
  Geodesic left_;
  double cell_;  ///< side, map units
  double step_;
  int turns_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<bool> closed_;
  std::vector<Node> nodes_;
  using Rank = std::pair<double, std::size_t>;
  std::priority_queue<Rank, std::vector<Rank>, std::greater<>> open_;
  ob::ScopedState<> from_;
  ob::ScopedState<> to_;
  double last_ = 0.0;
};

HybridSearch::HybridSearch(std::shared_ptr<const CollisionBody> body, OccupancyMap room, Motion motion,
                           double turning_radius)
    : body_(std::move(body)),
      room_(std::move(room)),
      reverse_(motion == Motion::reeds_shepp),
      radius_(turning_radius),
      space_(space_for(motion, turning_radius)),
      steering_(*space_, body_->outline().circumscribed_radius()) {}

CarWay HybridSearch::find(const Pose2& start, const Pose2& goal, const std::function<bool(std::size_t)>& ended) const {
  if (!body_->is_free(start) || !body_->is_free(goal)) return {};
  return HybridRun(*this, start, goal).run(ended);
}

PlanResult hybrid_search(const Problem& problem, const PlanSuite& suite, const PlanRow& row,
                         const CancelToken& cancel) {
  PlanResult result;
  const Stopwatch watch;
  const Polygon outline = outline_at(suite, problem.scale).value();
  const auto map = std::make_shared<const CollisionMap>(planning_map(problem, suite));
  const HybridSearch search(std::make_shared<const CollisionBody>(map, outline),
                            inflated(map->map(), outline.inscribed_radius()), motion_from_string(row.motion),
                            row.turning_radius * problem.scale);
  result.timings.prepare = watch.total_ms();
  const double latest = result.timings.prepare + 1e3 * row.options.time_limit;
  std::size_t tries = 0;
  const CarWay way = search.find({problem.start.x(), problem.start.y(), problem.start_heading},
                                 {problem.goal.x(), problem.goal.y(), problem.goal_heading}, [&](std::size_t tried) {
                                   tries = tried;
                                   return tried % 64 == 0 && (cancel.cancelled() || watch.total_ms() > latest);
                                 });
  result.timings.total = watch.total_ms();
  result.timings.plan = result.timings.total - result.timings.prepare;
  result.iterations = tries;
  if (way.poses.empty()) return result;
  result.status = PlanStatus::solved;
  for (const Pose2& pose : way.poses) {
    result.path.emplace_back(pose.x, pose.y);
    result.headings.push_back(pose.yaw);
  }
  result.cost = way.length;
  result.cost_history = {{result.timings.plan, tries, way.length}};
  return result;
}

}  // namespace lrrt::bench
