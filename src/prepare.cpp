// SPDX-License-Identifier: BSD-3-Clause
#include "prepare.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lrrt/map/flood.hpp"
#include "lrrt/map/footprint.hpp"
#include "lrrt/ompl/map_projection.hpp"
#include "lrrt/ompl/suitable_range.hpp"

namespace lrrt {
namespace {

struct Ends {
  Pixel start;
  Pixel goal;
};

Ends ends_on(const OccupancyMap& map, const PlanRequest& request) {
  return {OccupancyMap::pixel_of(map.to_pixel(request.start)), OccupancyMap::pixel_of(map.to_pixel(request.goal))};
}

std::optional<PlanStatus> outside(const OccupancyMap& map, const PlanRequest& request) {
  const Ends ends = ends_on(map, request);
  if (!map.contains(ends.start)) return PlanStatus::start_outside;
  if (!map.contains(ends.goal)) return PlanStatus::goal_outside;
  return std::nullopt;
}

std::optional<PlanStatus> occupied(bool start_is_free, bool goal_is_free) {
  if (!start_is_free) return PlanStatus::start_occupied;
  if (!goal_is_free) return PlanStatus::goal_occupied;
  return std::nullopt;
}

bool joined(const OccupancyMap& map, const PlanRequest& request) {
  const Ends ends = ends_on(map, request);
  return map.is_free(ends.start) && map.is_free(ends.goal) &&
         Flood(map.free_mask(), map.width(), map.height(), ends.start).reached(ends.goal);
}

/// A robot without an outline is a point in a map whose obstacles are grown by its radius: an outline too small to
/// matter.
Polygon speck(double resolution) {
  const double side = 1e-6 * resolution;
  return Polygon({{side, 0.0}, {-side, side}, {-side, -side}});
}

/// The pixels with a point at which a disc fits, but for rounding; what is closed is closed for sure.
OccupancyMap with_room_somewhere(const CollisionMap& map, double radius) {
  // No point of a pixel lies farther from its centre than half a diagonal, and the nearest pixel that is not free
  // reaches half a side towards it.
  const double most_off = 0.5 * (std::sqrt(2.0) - 1.0) + 1e-6;
  const double needed = radius / map.map().resolution() - most_off;
  std::vector<Cell> cells = map.map().cells();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (cells[i] == Cell::free && map.field().values()[i] < needed) cells[i] = Cell::occupied;
  }
  return map.map().with_cells(std::move(cells));
}

/// Where the reference point may be: the map with its obstacles grown by the disc around that point that the outline
/// holds. Gaps that no heading fits through are closed, and no prediction leads there.
///
/// inflated() asks the worst point of each pixel, so it may close what is open by a part of a pixel, a gap or the pixel
/// of a start. Where it leaves start and goal apart, what is closed for sure decides.
/// @return null when start and goal are not joined even so: then no path exists.
std::shared_ptr<const CollisionMap> room_for(const CollisionBody& body, const PlanRequest& request) {
  const double radius = body.outline().inscribed_radius();
  OccupancyMap room = inflated(body.map()->map(), radius);
  if (!joined(room, request)) {
    room = with_room_somewhere(*body.map(), radius);
    if (!joined(room, request)) return nullptr;
  }
  return std::make_shared<const CollisionMap>(std::move(room));
}

Prepared prepare_plane(OccupancyMap map, const PlanRequest& request, double goal_tolerance) {
  Prepared prepared;
  const Ends ends = ends_on(map, request);
  prepared.hopeless = occupied(map.is_free(ends.start), map.is_free(ends.goal));
  if (!prepared.hopeless && !joined(map, request)) prepared.hopeless = PlanStatus::not_connected;
  if (prepared.hopeless) return prepared;
  prepared.arrived = (request.goal - request.start).norm() <= goal_tolerance;
  if (!prepared.arrived) prepared.map = std::make_shared<const CollisionMap>(std::move(map));
  return prepared;
}

Prepared prepare_poses(OccupancyMap map, const PlanRequest& request) {
  Prepared prepared;
  const double pixel = map.resolution();
  const auto grown = std::make_shared<const CollisionMap>(std::move(map));
  const auto body = std::make_shared<const CollisionBody>(grown, request.outline ? *request.outline : speck(pixel));
  prepared.hopeless = occupied(body->is_free(pose(request.start, request.start_heading)),
                               body->is_free(pose(request.goal, request.goal_heading)));
  if (prepared.hopeless) return prepared;
  prepared.map = request.outline ? room_for(*body, request) : joined(grown->map(), request) ? grown : nullptr;
  if (!prepared.map) {
    prepared.hopeless = PlanStatus::not_connected;
    return prepared;
  }
  prepared.body = body;
  prepared.reach = std::max(pixel, body->outline().circumscribed_radius() + request.radius);
  prepared.arrived =
      request.start == request.goal && wrapped_angle(request.start_heading) == wrapped_angle(request.goal_heading);
  return prepared;
}

}  // namespace

Prepared prepare(const PlanRequest& request, double goal_tolerance) {
  OccupancyMap map = inflated(request.map.get().resolved(request.unknown), request.radius);
  Prepared prepared;
  prepared.hopeless = outside(map, request);
  if (prepared.hopeless) return prepared;
  return request.motion == Motion::plane ? prepare_plane(std::move(map), request, goal_tolerance)
                                         : prepare_poses(std::move(map), request);
}

double default_range(const Prepared& prepared, const PlanRequest& request) {
  const double range = suitable_range(*prepared.map);
  return request.motion == Motion::dubins || request.motion == Motion::reeds_shepp
             ? std::max(range, request.turning_radius)
             : range;
}

Pose2 pose(const Eigen::Vector2d& point, double heading) {
  return {point.x(), point.y(), wrapped_angle(heading)};
}

}  // namespace lrrt
