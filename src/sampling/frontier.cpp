// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/sampling/frontier.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "lrrt/error.hpp"

namespace lrrt {
namespace {

/// How far the band reaches, in steps of the planner: most extensions end within one step.
constexpr double steps_ahead = 2.0;
constexpr double steps_back = 1.0;
/// A pixel takes part when the way over it is longer than the best one by at most this share and so many steps.
constexpr double detour_share = 0.05;
constexpr double detour_steps = 4.0;
/// Draws without progress after which the band has doubled, and after which the wish for guided draws has halved.
constexpr double patience = 64.0;
constexpr double trust = 512.0;
constexpr double batch_trust = 8192.0;
constexpr double least_confidence = 0.1;
constexpr double most_doublings = 30.0;
/// Share of the draws from the shortest ways alone: where they pass a gap of a pixel, few others of the band lie in it.
constexpr double way_share = 0.25;
/// Once a path is known: share of the draws around its corners, the least that stays of it, and by how much a path must
/// be shorter to be worth more of them.
constexpr double corner_share = 0.5;
constexpr double least_corner_share = 0.05;
constexpr double worthwhile = 1e-3;
/// Short ways are looked for once so many draws were made that looking at every pixel costs little beside them, and
/// only on maps on which it takes a few milliseconds: a search must end in time.
constexpr std::size_t pixels_a_draw = 64;
constexpr std::size_t most_pixels = std::size_t{1} << 19U;
/// Before that: tries for a pixel of the region that could shorten the path.
constexpr int most_tries = 8;
constexpr double tau = 6.283185307179586;
/// How far ahead a direction looks, pixels: single steps go eight ways only, and a far look leads through walls.
constexpr double least_look = 4.0;
constexpr double most_look = 12.0;

}  // namespace

FrontierStrategy::Front FrontierStrategy::make_front(const Geodesic& to_other, const Geodesic& from_own, Pixel root,
                                                     std::int32_t most_detour) {
  Front front;
  const std::int32_t whole = to_other.at(root);
  front.horizon = whole;
  for (const Pixel p : to_other.reached()) {
    const std::int32_t distance = to_other.at(p);
    const std::int32_t behind = from_own.at(p);
    if (behind == Geodesic::unreached || distance + behind - whole > most_detour) continue;
    const auto whole_pixels = static_cast<std::size_t>(distance * Geodesic::unit);
    while (front.first.size() <= whole_pixels) front.first.push_back(front.pixels.size());
    front.pixels.push_back(p);
    if (distance + behind == whole) front.way.push_back(p);
  }
  return front;
}

FrontierStrategy::FrontierStrategy(std::shared_ptr<const OccupancyMap> map, const PromisingRegion& region, Pixel start,
                                   Pixel goal, const FrontierOptions& options)
    : map_(std::move(map)),
      width_(region.width()),
      height_(region.height()),
      start_(start),
      goal_(goal),
      step_(options.step),
      growth_(options.growth),
      trees_(growth_ == Growth::two_trees ? 2 : 1),
      tree_of_(region.mask().size(), 0) {
  if (!(step_ > 0.0))
    throw RequestError("a planner's step of " + std::to_string(step_) + " pixels: expected more than 0");
  Geodesic to_goal(region.mask(), width_, height_, goal);
  Geodesic to_start(region.mask(), width_, height_, start);
  const std::int32_t whole = to_goal.at(start);
  if (whole == Geodesic::unreached) {
    throw RequestError("the promising region does not join start and goal: bridge its gaps first");
  }
  const double detour = detour_share * whole + detour_steps * step_ / Geodesic::unit;
  const auto most_detour = static_cast<std::int32_t>(std::min(detour, 0.5 * std::numeric_limits<std::int32_t>::max()));
  fronts_[0] = make_front(to_goal, to_start, start, most_detour);
  if (trees_ == 2) {
    fronts_[1] = make_front(to_start, to_goal, goal, most_detour);
    fronts_[1].to_other = std::move(to_start);
  }
  fronts_[0].to_other = std::move(to_goal);
  tree_of_[index(start)] |= 1U;
  tree_of_[index(goal)] |= 2U;
}

Eigen::Vector2d FrontierStrategy::draw(Random& random) {
  ++stalled_;
  return path_.empty() ? draw_ahead(random) : draw_for_shorter(random);
}

Eigen::Vector2d FrontierStrategy::draw_ahead(Random& random) {
  const Front& front = fronts_[turn_];
  if (growth_ == Growth::batch) return point_in(front.pixels[random.index(front.pixels.size())], random);
  turn_ = (turn_ + 1) % trees_;
  if (random.uniform() < way_share) return point_in(draw_on_way(front, random), random);
  const double reach = step_ * std::exp2(std::min(static_cast<double>(stalled_) / patience, most_doublings));
  const double horizon = front.horizon * Geodesic::unit;
  const auto first_from = [&](double distance) {
    if (distance >= static_cast<double>(front.first.size())) return front.pixels.size();
    return distance <= 0.0 ? 0 : front.first[static_cast<std::size_t>(distance)];
  };
  const std::size_t low = std::min(first_from(horizon - steps_ahead * reach), front.pixels.size() - 1);
  const std::size_t high = std::max(low + 1, first_from(horizon + steps_back * reach + 1.0));
  return point_in(front.pixels[low + random.index(high - low)], random);
}

Pixel FrontierStrategy::draw_on_way(const Front& front, Random& random) const {
  const auto first_from = [&](double distance) {
    const auto nearer = [&](Pixel p) { return front.to_other.at(p) * Geodesic::unit < distance; };
    return static_cast<std::size_t>(std::partition_point(front.way.begin(), front.way.end(), nearer) -
                                    front.way.begin());
  };
  const double horizon = front.horizon * Geodesic::unit;
  const std::size_t low = std::min(first_from(horizon - steps_ahead * step_), front.way.size() - 1);
  const std::size_t high = std::max(low + 1, first_from(horizon + steps_back * step_));
  return front.way[low + random.index(high - low)];
}

Eigen::Vector2d FrontierStrategy::draw_for_shorter(Random& random) {
  ++draws_on_path_;
  if (random.uniform() < std::max(least_corner_share, corner_share * fading(trust))) return draw_at_corner(random);
  if (!ways_ && map_ && map_->size() <= std::min(most_pixels, pixels_a_draw * draws_on_path_)) {
    ways_ = ShortWays::between(*map_, start_, goal_, length_);
    map_.reset();  // looked at; where its free pixels do not join the ends, the region is all there is
  }
  return ways_ ? ways_->draw(random) : draw_on_region(random);
}

Eigen::Vector2d FrontierStrategy::draw_at_corner(Random& random) const {
  const Eigen::Vector2d corner = path_[random.index(path_.size())];
  const double radius = step_ * random.uniform();
  const double angle = random.uniform(0.0, tau);
  return corner + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
}

Eigen::Vector2d FrontierStrategy::draw_on_region(Random& random) const {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  for (int i = 0; i < most_tries; ++i) {
    point = point_in(fronts_[0].pixels[random.index(fronts_[0].pixels.size())], random);
    if ((point - path_.front()).norm() + (point - path_.back()).norm() < length_) break;
  }
  return point;
}

bool FrontierStrategy::contains(const Eigen::Vector2d& point) const {
  return fronts_[0].to_other.at(OccupancyMap::pixel_of(point)) != Geodesic::unreached;
}

std::optional<Eigen::Vector2d> FrontierStrategy::direction(const Eigen::Vector2d& point) const {
  const Geodesic& to_goal = fronts_[0].to_other;
  Pixel at = OccupancyMap::pixel_of(point);
  if (to_goal.at(at) == Geodesic::unreached) return std::nullopt;
  const auto steps = static_cast<int>(std::ceil(std::clamp(step_, least_look, most_look)));
  for (int i = 0; i < steps; ++i) {
    const Pixel next = to_goal.step_towards_source(at);
    if (next == at) break;
    at = next;
  }
  const Eigen::Vector2d ahead = Eigen::Vector2d(at.c + 0.5, at.r + 0.5) - point;
  if (ahead.squaredNorm() == 0.0) return std::nullopt;
  return ahead;
}

bool FrontierStrategy::improved(const std::vector<Eigen::Vector2d>& path, double length) {
  const bool first = path_.empty();
  path_ = path;
  length_ = length;
  if (ways_) ways_->limit(length);
  if (first || !(length > (1.0 - worthwhile) * noted_length_)) {
    noted_length_ = length;
    stalled_ = 0;
  }
  return true;
}

void FrontierStrategy::connected(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
  const Pixel first = OccupancyMap::pixel_of(from);
  const Pixel last = OccupancyMap::pixel_of(to);
  if (!inside(first) || !inside(last)) return;
  // A tree from the goal checks its motions backwards, so the pixel that is known may be either end.
  const bool forwards = tree_of_[index(first)] != 0;
  const Pixel known = forwards ? first : last;
  const Pixel fresh = forwards ? last : first;
  const std::uint8_t trees = tree_of_[index(known)];
  if (trees == 0) return;
  tree_of_[index(fresh)] = static_cast<std::uint8_t>(tree_of_[index(fresh)] | trees);
  if (!path_.empty()) return;
  for (std::size_t tree = 0; tree < trees_; ++tree) {
    if ((trees >> tree & 1U) == 0) continue;
    const std::int32_t distance = fronts_[tree].to_other.at(fresh);
    if (distance == Geodesic::unreached || distance >= fronts_[tree].horizon) continue;
    fronts_[tree].horizon = distance;
    stalled_ = 0;
  }
}

double FrontierStrategy::fading(double half_life) const {
  return std::exp2(-static_cast<double>(stalled_) / half_life);
}

double FrontierStrategy::confidence() const {
  if (ways_) return 1.0;  // draws wherever a shorter path could lead are no risk
  return std::max(least_confidence, fading(growth_ == Growth::batch ? batch_trust : trust));
}

}  // namespace lrrt
