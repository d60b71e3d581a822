// SPDX-License-Identifier: BSD-3-Clause
#include "made_regions.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <utility>

#include "lrrt/predict/grid_predictors.hpp"
#include "lrrt/region/geodesic.hpp"
#include "lrrt/sampling/random.hpp"

namespace lrrt::bench {
namespace {

using Plane = std::vector<float>;

/// What a bad region is made of: the query, and the perfect region for it.
struct Original {
  const OccupancyMap& map;
  Eigen::Vector2d start;
  Eigen::Vector2d goal;
  const Plane& perfect;
};

Pixel pixel_of(const OccupancyMap& map, const Eigen::Vector2d& point) {
  return OccupancyMap::pixel_of(map.to_pixel(point));
}

Plane perfect_plane(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
  return AStarPredictor().predict(map, start, goal).region.probability();
}

Plane constant(const Original& o, float value) {
  return Plane(o.map.size(), value);
}

Plane inverted(const Original& o) {
  Plane plane = o.perfect;
  for (float& p : plane) p = 1.0F - p;
  return plane;
}

Plane noise(const Original& o) {
  Random random(o.map.size());
  Plane plane(o.map.size());
  for (float& p : plane) p = static_cast<float>(random.uniform());
  return plane;
}

/// Every third stretch of 24 pixels of walking distance from the start is missing.
Plane broken(const Original& o) {
  constexpr double stretch = 24.0;
  const Geodesic walk(o.map.free_mask(), o.map.width(), o.map.height(), pixel_of(o.map, o.start));
  Plane plane = o.perfect;
  for (const Pixel p : walk.reached()) {
    const auto number = static_cast<int>(walk.at(p) * Geodesic::unit / stretch);
    if (number % 3 == 2) plane[o.map.index(p)] = 0.0F;
  }
  return plane;
}

Plane shifted(const Original& o) {
  constexpr int by = 4;
  Plane plane(o.map.size(), 0.0F);
  for (int r = by; r < o.map.height(); ++r) {
    for (int c = by; c < o.map.width(); ++c) plane[o.map.index({c, r})] = o.perfect[o.map.index({c - by, r - by})];
  }
  return plane;
}

/// What lies within 32 pixels of walking distance of the start.
Plane room(const Original& o) {
  constexpr double reach = 32.0;
  const Geodesic walk(o.map.free_mask(), o.map.width(), o.map.height(), pixel_of(o.map, o.start));
  Plane plane(o.map.size(), 0.0F);
  for (const Pixel p : walk.reached()) {
    if (walk.at(p) * Geodesic::unit <= reach) plane[o.map.index(p)] = 1.0F;
  }
  return plane;
}

/// The way from the start to the pixel that is farthest from the goal.
Plane wrong(const Original& o) {
  const Geodesic walk(o.map.free_mask(), o.map.width(), o.map.height(), pixel_of(o.map, o.goal));
  return perfect_plane(o.map, o.start, o.map.center(walk.reached().back()));
}

const std::map<std::string, std::function<Plane(const Original&)>>& bad_regions() {
  static const std::map<std::string, std::function<Plane(const Original&)>> table = {
      {"broken", broken},
      {"shifted", shifted},
      {"wrong", wrong},
      {"room", room},
      {"noise", noise},
      {"empty", [](const Original& o) { return constant(o, 0.0F); }},
      {"full", [](const Original& o) { return constant(o, 1.0F); }},
      {"inverted", inverted}};
  return table;
}

class BadRegion final : public RegionPredictor {
 public:
  explicit BadRegion(std::function<Plane(const Original&)> made) : made_(std::move(made)) {}

  Prediction predict(const OccupancyMap& map, const Eigen::Vector2d& start,
                     const Eigen::Vector2d& goal) const override {
    const Plane perfect = perfect_plane(map, start, goal);
    return GivenRegion(map.width(), map.height(), made_({map, start, goal, perfect})).predict(map, start, goal);
  }

 private:
  std::function<Plane(const Original&)> made_;
};

}  // namespace

const std::vector<std::string>& made_region_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"astar", "eroded", "potential"};
    for (const auto& entry : bad_regions()) all.push_back(entry.first);
    return all;
  }();
  return names;
}

std::shared_ptr<const RegionPredictor> made_region(const std::string& name) {
  if (name == "astar") return std::make_shared<const AStarPredictor>();
  if (name == "eroded") return std::make_shared<const AStarPredictor>(1.0);
  if (name == "potential") return std::make_shared<const PotentialFieldPredictor>();
  const auto found = bad_regions().find(name);
  return found == bad_regions().end() ? nullptr : std::make_shared<const BadRegion>(found->second);
}

}  // namespace lrrt::bench
