// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/map/image.hpp"

#include <utility>

#include "lrrt/error.hpp"

namespace lrrt {
namespace {

/// Luminance of a pixel in thousandths of a grey level.
int luminance(const std::uint8_t* pixel, int color_channels) {
  if (color_channels == 1) return 1000 * pixel[0];
  return 299 * pixel[0] + 587 * pixel[1] + 114 * pixel[2];
}

Cell classify(const std::uint8_t* pixel, const Image& image) {
  constexpr int half = 255 * 1000 / 2;
  const int colors = image.color_channels();
  if (image.has_alpha() && pixel[colors] == 0) return Cell::unknown;
  return luminance(pixel, colors) < half ? Cell::occupied : Cell::free;
}

}  // namespace

void check_map_size(std::int64_t width, std::int64_t height, const std::string& source) {
  const std::string size = std::to_string(width) + "×" + std::to_string(height);
  if (width < 1 || height < 1) {
    throw MapError(source + ": size " + size + " is empty; expected at least 1×1 pixels; is the file damaged?");
  }
  if (width > max_map_pixels / height) {
    throw MapError(source + ": size " + size + " is too large; expected at most " + std::to_string(max_map_pixels) +
                   " pixels in all; use a coarser map or crop it");
  }
}

void check_image(const Image& image) {
  check_map_size(image.width, image.height, "image");
  if (image.channels < 1 || image.channels > 4) {
    throw MapError("image: channels is " + std::to_string(image.channels) +
                   "; expected 1 (grey), 2 (grey, alpha), 3 (RGB) or 4 (RGBA)");
  }
  const auto expected = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height) *
                        static_cast<std::size_t>(image.channels);
  if (image.pixels.size() != expected) {
    throw MapError("image: " + std::to_string(image.pixels.size()) +
                   " pixel values; expected width × height × channels = " + std::to_string(expected));
  }
}

OccupancyMap map_from_image(const Image& image) {
  check_image(image);
  std::vector<Cell> cells;
  cells.reserve(image.pixels.size() / static_cast<std::size_t>(image.channels));
  const std::uint8_t* const end = image.pixels.data() + image.pixels.size();
  for (const std::uint8_t* pixel = image.pixels.data(); pixel != end; pixel += image.channels) {
    cells.push_back(classify(pixel, image));
  }
  return OccupancyMap(image.width, image.height, std::move(cells));
}

}  // namespace lrrt
