// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/swept_footprint.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "lrrt/error.hpp"

namespace lrrt {
namespace {

using Eigen::Vector2d;

/// From this clearance on, in pixels, the field's bound will do; nearer the exact clearance is needed, not least
/// because a tolerance, at most 1, is held against it.
constexpr double far_away = 2.0;
/// Share of a far clearance that is kept as the bound; the rest is the leap to the next look.
constexpr double kept = 0.75;
/// Pixels of an edge for which the exact clearance is found at a time. The cost hardly depends on these three.
constexpr double stretch = 3.0;
/// Single precision rounds the field's values by less than this share.
constexpr double rounding = 1e-7;

/// What one look-up tells about the distance from a point to the nearest pixel that is not free.
struct Reach {
  double least;
  double most;
};

Vector2d center(Pixel p) {
  return {p.c + 0.5, p.r + 0.5};
}

Reach look(const DistanceField& field, const Vector2d& point) {
  const Pixel pixel = OccupancyMap::pixel_of(point);
  const double between_centers = field.at(pixel);
  if (between_centers <= 0.0) return {0.0, 0.0};
  // A square reaches from half a side to half a diagonal around its centre.
  const double off_center = (point - center(pixel)).norm();
  return {between_centers * (1.0 - rounding) - off_center - std::sqrt(0.5),
          between_centers * (1.0 + rounding) + off_center - 0.5};
}

/// Squared distance from a segment to the closed square of side 1 around the origin.
double squared_gap(const Vector2d& a, const Vector2d& b) {
  const Vector2d edge = b - a;
  const Vector2d low = a.cwiseMin(b);
  const Vector2d high = a.cwiseMax(b);
  // Convex shapes are apart exactly when the normal of one of their sides separates them ...
  const bool apart = low.maxCoeff() > 0.5 || high.minCoeff() < -0.5 ||
                     std::abs(a.x() * edge.y() - a.y() * edge.x()) > 0.5 * edge.lpNorm<1>();
  if (!apart) return 0.0;
  // ... and a corner of one of them is then among their nearest points.
  const auto to_square = [](const Vector2d& p) { return (p.cwiseAbs().array() - 0.5).max(0.0).matrix().squaredNorm(); };
  double least = std::min(to_square(a), to_square(b));
  const double squared_length = std::max(edge.squaredNorm(), std::numeric_limits<double>::min());
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      const Vector2d to_corner = Vector2d(x, y) - a;
      const double share = std::clamp(edge.dot(to_corner) / squared_length, 0.0, 1.0);
      least = std::min(least, (share * edge - to_corner).squaredNorm());
    }
  }
  return least;
}

/// Columns to go from a pixel to the next one that may not be free.
int columns_to_next(float distance) {
  return static_cast<int>(std::ceil(distance));
}

/// Distance from a segment to the nearest pixel that is not free, at most `wanted`.
double exact_clearance(const DistanceField& field, const Vector2d& a, const Vector2d& b, double wanted) {
  const Vector2d margin(wanted, wanted);
  const Pixel first = OccupancyMap::pixel_of(a.cwiseMin(b) - margin);
  const Pixel last = OccupancyMap::pixel_of(a.cwiseMax(b) + margin);
  double nearest = wanted * wanted;
  bool found = false;
  for (int r = first.r; r <= last.r; ++r) {
    for (int c = first.c; c <= last.c;) {
      const float distance = field.at({c, r});
      if (distance > 0.0F) {
        c += columns_to_next(distance);
        continue;
      }
      const double gap = squared_gap(a - center({c, r}), b - center({c, r}));
      found = found || gap < nearest;
      nearest = std::min(nearest, gap);
      ++c;
    }
  }
  return found ? std::sqrt(nearest) : wanted;
}

/// Lower bound of the distance from an edge to the nearest pixel that is not free, at most `wanted`. Gives up once it
/// falls to `refused` or below.
double edge_clearance(const DistanceField& field, const Vector2d& a, const Vector2d& b, double wanted, double refused) {
  const double length = (b - a).norm();
  const Vector2d direction = (b - a) / std::max(length, std::numeric_limits<double>::min());
  double bound = wanted;
  double at = 0.0;
  do {  // at least one look, which finds an end that is not a number
    const Vector2d point = a + at * direction;
    const Reach reach = look(field, point);
    if (reach.most <= 0.0) return 0.0;  // only here may the point be off the map, even infinitely far
    double leap = 0.0;
    if (reach.least >= far_away) {
      bound = std::min(bound, kept * reach.least);
      leap = reach.least - bound;
    } else {
      leap = std::min(stretch, length - at);
      // what is nearest to this point is no farther from the edge, so there is no need to look beyond it
      bound = exact_clearance(field, point, point + leap * direction, std::min(bound, reach.most));
    }
    if (bound < wanted && bound <= refused) return bound;
    at += leap;
  } while (at < length);
  return bound;
}

/// How to_pixel() turns differences; taken over the whole map, so that a far origin rounds nothing away.
Eigen::Matrix2d linear_part(const OccupancyMap& map) {
  const double span = map.resolution() * std::max(map.width(), map.height());
  const Vector2d base = map.to_world({0.0, 0.0});
  Eigen::Matrix2d linear;
  linear.col(0) = (map.to_pixel(base + Vector2d(span, 0.0)) - map.to_pixel(base)) / span;
  linear.col(1) = (map.to_pixel(base + Vector2d(0.0, span)) - map.to_pixel(base)) / span;
  return linear;
}

}  // namespace

FootprintWalk::FootprintWalk(const OccupancyMap& map, const DistanceField& field, Polygon polygon, double tolerance)
    : map_(map),
      field_(field),
      polygon_(std::move(polygon)),
      tolerance_(tolerance),
      inscribed_(polygon_.contains(Vector2d::Zero()) ? polygon_.inscribed_radius() / map.resolution() : -1.0),
      circumscribed_(polygon_.circumscribed_radius() / map.resolution()),
      to_pixels_(linear_part(map)) {
  if (map.width() != field.width() || map.height() != field.height())
    throw RequestError("the distance field has another size than the map: it must be made from it");
  if (!(tolerance >= 1e-6 && tolerance <= 1.0))
    throw RequestError("tolerance " + std::to_string(tolerance) + ": expected 1e-6 to 1 pixels");
}

bool FootprintWalk::is_free(const Pose2& pose) const {
  const Placed robot = placed(pose);
  if (look(field_, robot.position).least >= circumscribed_ + touching) return true;
  return clearance(robot, touching) >= touching && is_hollow(robot);
}

double FootprintWalk::clearance(const Placed& robot, double wanted) const {
  const Reach reach = look(field_, robot.position);
  if (reach.least - circumscribed_ >= wanted) return wanted;
  if (reach.most <= inscribed_) return 0.0;
  double bound = wanted;
  Vector2d from = robot.pixel_of(polygon_.vertices().back());
  for (const Vector2d& vertex : polygon_.vertices()) {
    const Vector2d to = robot.pixel_of(vertex);
    bound = edge_clearance(field_, from, to, bound, tolerance_);
    if (bound < wanted && bound <= tolerance_) break;
    from = to;
  }
  return bound;
}

FootprintWalk::Placed FootprintWalk::placed(const Pose2& pose) const {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (!std::isfinite(pose.yaw)) return {{nan, nan}, to_pixels_};
  const double cos = std::cos(pose.yaw);
  const double sin = std::sin(pose.yaw);
  Eigen::Matrix2d turned;
  turned << cos, -sin, sin, cos;
  return {map_.to_pixel({pose.x, pose.y}), to_pixels_ * turned};
}

bool FootprintWalk::is_hollow(const Placed& robot) const {
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  for (const Vector2d& vertex : polygon_.vertices()) {
    const double y = robot.pixel_of(vertex).y();
    low = std::min(low, y);
    high = std::max(high, y);
  }
  for (int r = static_cast<int>(std::floor(low)); r < high; ++r) {
    if (!row_is_hollow(robot, r)) return false;
  }
  return true;
}

bool FootprintWalk::row_is_hollow(const Placed& robot, int row) const {
  // A pixel that the outline does not touch lies inside exactly when its centre does, and so do its neighbours that are
  // not free either.
  const double y = row + 0.5;
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  Vector2d from = robot.pixel_of(polygon_.vertices().back());
  for (const Vector2d& vertex : polygon_.vertices()) {
    const Vector2d to = robot.pixel_of(vertex);
    if ((from.y() < y) != (to.y() < y)) {
      const double x = from.x() + (to.x() - from.x()) * (y - from.y()) / (to.y() - from.y());
      low = std::min(low, x);
      high = std::max(high, x);
    }
    from = to;
  }
  if (low > high) return true;
  for (int c = static_cast<int>(std::ceil(low - 0.5)); c + 0.5 <= high;) {
    const float distance = field_.at({c, row});
    if (distance > 0.0F) {
      c += columns_to_next(distance);
      continue;
    }
    if (polygon_.contains(robot.vertex_of(center({c, row})))) return false;
    while (c + 0.5 <= high && field_.at({c, row}) <= 0.0F) ++c;
  }
  return true;
}

}  // namespace lrrt
