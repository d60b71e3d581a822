// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "lrrt/map/image.hpp"
#include "lrrt/map/occupancy_map.hpp"

namespace lrrt {

/// How the brightness of a map_server picture turns into occupancy.
enum class MapServerMode {
  trinary,  ///< thresholds; in between is unknown
  scale,    ///< the same, and transparent pixels are unknown
  raw,      ///< the brightness is the occupancy in percent
};

/// Meta data of a map in the format of ROS map_server (ROS 1 map_server, ROS 2 nav2_map_server).
struct MapServerMeta {
  std::filesystem::path source;                 ///< the YAML file, for error texts; may be empty
  std::filesystem::path image;                  ///< the picture; relative paths are resolved against the YAML file
  double resolution = 0.05;                     ///< metres per pixel
  Pose2 origin;                                 ///< lower-left corner of the lower-left pixel: metres, radians
  bool negate = false;                          ///< white is occupied instead of black
  double occupied_thresh = 0.65;                ///< occupancy above this is occupied, 0..1
  double free_thresh = 0.196;                   ///< occupancy below this is free, 0..1
  MapServerMode mode = MapServerMode::trinary;  ///< `mode` is the only optional field of the YAML file
};

/// Parses the text of a map_server YAML file; fields of other tools are ignored.
/// @param source path of the YAML file: named in errors, and its folder is where a relative `image` starts.
/// @throws MapError that names file and field: broken YAML, missing field, wrong type, a resolution or an
/// origin beyond the bounds of OccupancyMap, numbers that are not finite, thresholds out of 0..1 or out of order, an
/// unknown mode.
MapServerMeta parse_map_server(const std::string& text, const std::filesystem::path& source);

/// Reads the picture of a map_server map as free, occupied and unknown cells in metres.
///
/// Occupancy of a pixel is p = (255 − shade) / 255, or shade / 255 with `negate`, where shade averages the channels:
/// - `trinary`: p > occupied_thresh is occupied, p < free_thresh is free, else unknown. As map_server does, an alpha
///   channel counts as one more channel beside R, G and B (grey counts three times).
/// - `scale`: alpha below 255 is unknown; alpha is not averaged. Between the thresholds map_server would publish a
///   probability; a trinary map has none, so those pixels are unknown.
/// - `raw`: shade is the occupancy in percent and `negate` and alpha are ignored: 0..100 are compared with the
/// thresholds
///   as p = shade / 100, above 100 is unknown.
/// The comparisons are strict: a pixel exactly on a threshold is unknown.
/// @throws MapError for an inconsistent image or meta data.
OccupancyMap interpret(const Image& image, const MapServerMeta& meta);

/// Reads a map_server map from its YAML file.
/// @throws MapError as above, and when the YAML file or the picture is missing or `decode` refuses the picture.
OccupancyMap read_map_server(const std::filesystem::path& path, const ImageDecoder& decode);

}  // namespace lrrt
