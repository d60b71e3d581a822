// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "lrrt/map/image.hpp"
#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// Reads a map of any supported kind: `.yaml` and `.yml` as map_server (metres), a `.map` file that begins with the
/// word `type` as MovingAI (pixels), everything else as a plain picture (pixels). The case of the extension does not
/// matter.
/// @param decode turns picture files into pixels.
/// @throws MapError that names the file and what is wrong with it.
OccupancyMap read_map(const std::filesystem::path& path, const ImageDecoder& decode);

}  // namespace lrrt
