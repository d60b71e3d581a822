// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "lrrt/map/components.hpp"
#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/region/picture.hpp"

namespace lrrt {

/// What a network expects of its input picture.
struct InputSpec {
  int size = 256;       ///< side of the square input, pixels; the largest, where there are several
  int marker_side = 5;  ///< side of the start and goal squares, input pixels; a larger map pixel makes a larger square
  Colours colours{};    ///< colours of the picture
  /// Sides, ascending, that take the place of `size` where passages stay at least `least_passage` pixels wide in them.
  std::vector<int> smaller{};
  double least_passage = 5.0;  ///< input pixels
};

/// Where a map lies inside the network's input.
///
/// The part of the map that matters is enlarged by a whole factor where it is smaller than the input, scaled down where
/// it is larger, and centred.
struct InputFit {
  int map_width = 0;   ///< of the map that was encoded, pixels
  int map_height = 0;  ///< of the map that was encoded, pixels
  int size = 0;        ///< side of the input, pixels
  PixelBox crop{};     ///< the part of the map that is shown, map pixels
  double scale = 1.0;  ///< input pixels per map pixel
  PixelBox placed{};   ///< where that part lies in the input, input pixels

  /// Input pixels per map column; differs from `scale` where scaling down had to round the shorter side.
  double scale_x() const { return static_cast<double>(placed.width) / crop.width; }
  /// Input pixels per map row.
  double scale_y() const { return static_cast<double>(placed.height) / crop.height; }

  /// Nearest resampling of a map-sized array onto the input.
  /// @param values row-major, map.width × map.height. @param fill value outside the map's part.
  /// @return size × size values. @throws RequestError when the number of values is not the map's.
  std::vector<std::uint8_t> to_input(const std::vector<std::uint8_t>& values, std::uint8_t fill) const;

  /// Brings a plane of the network's output back to map pixels: averaged where the map was enlarged, interpolated where
  /// it was scaled down, 0 outside the part that was shown.
  /// @param plane size × size values. @return map_width × map_height values.
  std::vector<float> to_map(const float* plane) const;
};

/// Turns a map, a start and a goal into the picture that the network sees. Training and inference share this one
/// encoder.
///
/// The picture shows the bounding box of the free component of start and goal plus one pixel, so that a small room in a
/// large empty scan fills the input. Scaling down averages areas: a thin passage or wall stays visible as grey.
///
/// Where the network takes smaller pictures too, the smallest is used in which every passage keeps its least width,
/// that is, every free pixel shown lies in a free square of that width: the time of a prediction goes with the area of
/// the picture. Maps that are shown at less than half their size always take the largest.
class Encoder {
 public:
  /// @throws RequestError when a side is not within 8 to 8192 pixels, the marker does not fit into it, the smaller
  /// sides do not ascend below `size`, or the least passage is not within 1 to `size`.
  explicit Encoder(InputSpec spec = {});

  /// What the network expects.
  const InputSpec& spec() const { return spec_; }

  /// @param start,goal map units. @param image receives 3 × side × side bytes, the red, the green, the blue plane; side
  /// is the `size` of what is returned.
  /// @throws RequestError when start or goal does not lie on a free pixel.
  InputFit encode(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                  std::vector<std::uint8_t>& image) const;

  /// The same, the picture being written where the caller wants it.
  /// @param place is told the side and returns room for the 3 × side × side bytes.
  InputFit encode(const OccupancyMap& map, const Eigen::Vector2d& start, const Eigen::Vector2d& goal,
                  const std::function<std::uint8_t*(int side)>& place) const;

 private:
  InputSpec spec_;
};

}  // namespace lrrt
