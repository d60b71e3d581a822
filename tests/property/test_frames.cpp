// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "ground.hpp"
#include "run.hpp"

namespace lrrt::property {
namespace {

using Eigen::Vector2d;

/// A metric map with any frame that is allowed.
OccupancyMap random_frame(Random& random) {
  const int width = 1 + static_cast<int>(random.index(2000));
  const int height = 1 + static_cast<int>(random.index(200));
  const double resolution = std::pow(10.0, random.uniform(-6.0, 6.0));
  const double far = std::pow(10.0, random.uniform(-3.0, 9.0));
  std::vector<Cell> cells(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), Cell::free);
  const double x = random.uniform(-far, far);
  const double y = random.uniform(-far, far);
  return {width, height, std::move(cells), resolution, {x, y, random.uniform(-10.0, 10.0)}};
}

/// There and back, in both directions, as exactly as numbers of that size can be told; and as complex numbers have it.
Verdict check(std::uint64_t number) {
  Random random(number);
  const OccupancyMap map = random_frame(random);
  const double scale =
      std::max(std::abs(map.origin().x), std::abs(map.origin().y)) / map.resolution() + map.width() + map.height();
  const double slack = 1e-15 * 16.0 * scale;  // pixels
  const Ground ground(PlanRequest{map, {0.0, 0.0}, {0.0, 0.0}});
  for (int i = 0; i < 20; ++i) {
    const Vector2d pixel(random.uniform(-10.0, map.width() + 10.0), random.uniform(-10.0, map.height() + 10.0));
    const Vector2d world = map.to_world(pixel);
    if ((map.to_pixel(world) - pixel).norm() > slack) return {"a pixel does not come back", "pixel"};
    if ((ground.to_pixel(world) - pixel).norm() > slack) return {"another conversion says otherwise", "pixel"};
    if ((map.to_world(map.to_pixel(world)) - world).norm() > slack * map.resolution()) {
      return {"a point does not come back", "point"};
    }
    const Bounds box = map.bounds();
    const bool inside = pixel.x() >= 0.0 && pixel.y() >= 0.0 && pixel.x() <= map.width() && pixel.y() <= map.height();
    const double hair = slack * map.resolution();
    if (inside && ((world - box.low).minCoeff() < -hair || (box.high - world).minCoeff() < -hair)) {
      return {"a point of the map outside its bounds", "bounds"};
    }
  }
  return {"", "frame"};
}

TEST(Property, ConversionsRoundTrip) {
  for_all(2000, check);
}

}  // namespace
}  // namespace lrrt::property
