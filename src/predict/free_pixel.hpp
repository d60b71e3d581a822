// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// The pixel of a point, map units. @param name of the point, for the text of the error.
/// @throws RequestError when the pixel is not free.
Pixel free_pixel(const OccupancyMap& map, const Eigen::Vector2d& point, const char* name);

}  // namespace lrrt
