// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace lrrt {

/// Exact squared Euclidean distance of every pixel to the nearest blocked one, where everything outside the picture is
/// blocked too. Two passes in whole numbers (Meijster, Roerdink, Hesselink 2000), so it is exact at any size; OpenCV's
/// precise transform is not: it loses pixels on pictures wider than 4096.
/// @param open row-major, not 0 where a pixel is open; width × height values.
/// @return row-major squared distances between pixel centres, pixels²; 0 for blocked pixels. They fit: no pixel is
/// farther from the outside than half the shorter side, and a map has fewer than 2³¹ pixels.
std::vector<std::int32_t> squared_distances(const std::vector<std::uint8_t>& open, int width, int height);

}  // namespace lrrt
