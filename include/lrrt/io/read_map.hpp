// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "lrrt/map/image.hpp"
#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// Decodes a PNG, PGM, PPM, PBM, BMP or JPEG file; the content decides, not the extension.
///
/// Palettes are resolved, and 16-bit values and PGM/PPM values with another maximum than 255 are scaled to 0..255.
/// Colours come in the order R, G, B, alpha. EXIF rotation is not applied. Needs the library lrrt::io (OpenCV
/// imgcodecs).
/// @throws MapError that names the file: missing, of another format, damaged, or larger than max_map_pixels.
Image decode_image(const std::filesystem::path& path);

/// Reads a map of any supported kind: read_map(path, decode_image).
/// @throws MapError that names the file and what is wrong with it.
OccupancyMap read_map(const std::filesystem::path& path);

/// Writes a picture as PNG. The file appears complete or not at all: a temporary file beside it is renamed.
/// Grey + alpha is stored as RGBA.
/// @throws MapError when the image is inconsistent or the file cannot be written.
void write_png(const std::filesystem::path& path, const Image& image);

}  // namespace lrrt
