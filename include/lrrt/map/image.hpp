// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// A decoded picture with 8 bits per channel.
///
/// Pixels are row-major from the top left, channels interleaved: 1 grey, 2 grey + alpha, 3 RGB, 4 RGBA.
/// Alpha 0 is transparent, 255 opaque.
struct Image {
  int width = 0;                     ///< pixels
  int height = 0;                    ///< pixels
  int channels = 1;                  ///< 1 to 4
  std::vector<std::uint8_t> pixels;  ///< width × height × channels values

  /// True when the last channel is transparency.
  bool has_alpha() const { return channels == 2 || channels == 4; }
  /// Channels without transparency: 1 for grey, 3 for colours.
  int color_channels() const { return has_alpha() ? channels - 1 : channels; }
};

/// Turns a picture file into pixels. liblrrt has no decoder of its own; lrrt/io/read_map.hpp holds one made from
/// OpenCV.
using ImageDecoder = std::function<Image(const std::filesystem::path&)>;

/// Checks a size that a file states.
/// @param source name of the file for the error text.
/// @throws MapError for a side below 1 or for more than max_map_pixels pixels.
void check_map_size(std::int64_t width, std::int64_t height, const std::string& source);

/// Checks that size, channels and number of pixel values fit together.
/// @throws MapError when they do not.
void check_image(const Image& image);

/// Reads a plain picture as a map in pixels.
///
/// Dark is occupied: luminance (299 R + 587 G + 114 B) / 1000 below half of 255 is Cell::occupied, anything else is
/// Cell::free. A fully transparent pixel (alpha 0) is Cell::unknown; partial transparency changes nothing.
/// @throws MapError for an inconsistent image.
OccupancyMap map_from_image(const Image& image);

}  // namespace lrrt
