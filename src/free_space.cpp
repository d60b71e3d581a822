// SPDX-License-Identifier: BSD-3-Clause
#include "free_space.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lrrt/map/footprint.hpp"
#include "lrrt/ompl/map_projection.hpp"
#include "lrrt/ompl/suitable_range.hpp"

namespace lrrt {
namespace {

std::optional<PlanStatus> outside(const OccupancyMap& map, const PlanRequest& request) {
  const auto contains = [&](const Eigen::Vector2d& point) {
    return map.contains(OccupancyMap::pixel_of(map.to_pixel(point)));
  };
  if (!contains(request.start)) return PlanStatus::start_outside;
  if (!contains(request.goal)) return PlanStatus::goal_outside;
  return std::nullopt;
}

std::optional<PlanStatus> occupied(bool start_is_free, bool goal_is_free) {
  if (!start_is_free) return PlanStatus::start_occupied;
  if (!goal_is_free) return PlanStatus::goal_occupied;
  return std::nullopt;
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

bool starts_at_goal(const PlanRequest& request, const PlanOptions& options) {
  if (is_driven(request.motion)) {
    return (request.goal - request.start).norm() <= options.goal_tolerance &&
           angle_between(request.goal_heading, request.start_heading) <= options.heading_tolerance;
  }
  return request.start == request.goal && wrapped_angle(request.start_heading) == wrapped_angle(request.goal_heading);
}

std::shared_ptr<const OccupancyMap> shared(OccupancyMap map) {
  return std::make_shared<const OccupancyMap>(std::move(map));
}

}  // namespace

FreeSpace::FreeSpace(const PlanRequest& request, int detail)
    : detail_(detail), grown_(shared(inflated(request.map.get().resolved(request.unknown), request.radius)), detail) {}

Prepared FreeSpace::prepare(const PlanRequest& request, const PlanOptions& options) {
  Prepared prepared;
  prepared.hopeless = outside(grown_.map(), request);
  if (prepared.hopeless) return prepared;
  return request.motion == Motion::plane ? prepare_plane(request, options.goal_tolerance)
                                         : prepare_poses(request, options);
}

Prepared FreeSpace::prepare_plane(const PlanRequest& request, double goal_tolerance) {
  Prepared prepared;
  const auto is_free = [&](const Eigen::Vector2d& point) {
    return grown_.map().is_free(OccupancyMap::pixel_of(grown_.map().to_pixel(point)));
  };
  prepared.hopeless = occupied(is_free(request.start), is_free(request.goal));
  if (prepared.hopeless) return prepared;
  prepared.guidance = grown_.joining(request.start, request.goal);
  if (!prepared.guidance) prepared.hopeless = PlanStatus::not_connected;
  if (prepared.hopeless) return prepared;
  prepared.arrived = (request.goal - request.start).norm() <= goal_tolerance;
  if (!prepared.arrived) prepared.map = grown_.collision();
  return prepared;
}

const std::shared_ptr<const CollisionBody>& FreeSpace::body(const PlanRequest& request) {
  if (!body_) {
    body_ = std::make_shared<const CollisionBody>(
        grown_.collision(), request.outline ? *request.outline : speck(grown_.map().resolution()));
  }
  return body_;
}

bool FreeSpace::is_free(const PlanRequest& request, const Pose2& from, const Pose2& to) {
  if (request.motion == Motion::plane) return grown_.collision()->is_free({from.x, from.y}, {to.x, to.y});
  const CollisionBody& robot = *body(request);
  const double reach = robot.outline().circumscribed_radius();
  if (request.motion == Motion::turning) return robot.is_free(PoseMotion(from, to, reach));
  return robot.is_free(PoseMotion::arc(from, to, reach));
}

/// Gaps that no heading fits through are closed, and no prediction leads there.
///
/// inflated() asks the worst point of each pixel, so it may close what is open by a part of a pixel, a gap or the pixel
/// of a start. Where it leaves start and goal apart, what is closed for sure decides.
Room* FreeSpace::joining_room(const PlanRequest& request, std::shared_ptr<const OccupancyMap>& guidance) {
  const auto joins = [&](Room& room) {
    guidance = room.joining(request.start, request.goal);
    return guidance != nullptr;
  };
  if (!request.outline) return joins(grown_) ? &grown_ : nullptr;
  const double radius = body_->outline().inscribed_radius();
  if (!inside_) inside_.emplace(shared(inflated(grown_.map(), radius)), detail_);
  if (joins(*inside_)) return &*inside_;
  if (!closed_) closed_.emplace(shared(with_room_somewhere(*grown_.collision(), radius)), detail_);
  return joins(*closed_) ? &*closed_ : nullptr;
}

Prepared FreeSpace::prepare_poses(const PlanRequest& request, const PlanOptions& options) {
  Prepared prepared;
  prepared.body = body(request);
  prepared.hopeless = occupied(prepared.body->is_free(pose(request.start, request.start_heading)),
                               prepared.body->is_free(pose(request.goal, request.goal_heading)));
  if (prepared.hopeless) return prepared;
  Room* const room = joining_room(request, prepared.guidance);
  if (room == nullptr) {
    prepared.hopeless = PlanStatus::not_connected;
    return prepared;
  }
  prepared.map = room->collision();
  prepared.reach =
      std::max(grown_.map().resolution(), prepared.body->outline().circumscribed_radius() + request.radius);
  prepared.arrived = starts_at_goal(request, options);
  return prepared;
}

double default_range(const Prepared& prepared, const PlanRequest& request) {
  const double range = suitable_range(*prepared.map);
  return request.motion == Motion::dubins || request.motion == Motion::reeds_shepp || request.motion == Motion::car
             ? std::max(range, request.turning_radius)
             : range;
}

Pose2 pose(const Eigen::Vector2d& point, double heading) {
  return {point.x(), point.y(), wrapped_angle(heading)};
}

}  // namespace lrrt
