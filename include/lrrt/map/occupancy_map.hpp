// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lrrt/map/pixel_box.hpp"

namespace lrrt {

/// State of one pixel of a map.
enum class Cell : std::uint8_t {
  free = 0,      ///< the robot may be here
  occupied = 1,  ///< an obstacle
  unknown = 2,   ///< not seen; see UnknownIs
};

/// Whether a planner may pass through unknown pixels.
enum class UnknownIs : std::uint8_t {
  occupied,  ///< unknown pixels are obstacles
  free,      ///< unknown pixels are free
};

/// Column and row of a pixel; row 0 is the top of the picture.
struct Pixel {
  int c = 0;  ///< column
  int r = 0;  ///< row
  /// True for the same pixel.
  friend bool operator==(Pixel a, Pixel b) { return a.c == b.c && a.r == b.r; }
  /// True for another pixel.
  friend bool operator!=(Pixel a, Pixel b) { return !(a == b); }
};

/// A position and a heading in the plane: of a robot, or of a map's lower-left corner in its frame.
struct Pose2 {
  double x = 0.0;    ///< map units
  double y = 0.0;    ///< map units
  double yaw = 0.0;  ///< radians, counter-clockwise
};

/// Axis-aligned bounds in map units.
struct Bounds {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();   ///< least x and y
  Eigen::Vector2d high = Eigen::Vector2d::Zero();  ///< largest x and y
};

/// Most pixels that a map may have: 16384 × 16384.
inline constexpr std::int64_t max_map_pixels = std::int64_t{1} << 28;

/// Bounds of a map's frame: beyond them pixels cannot be told apart any more in double precision, or OMPL's distances
/// overflow.
inline constexpr double finest_resolution = 1e-6;   ///< metres per pixel
inline constexpr double coarsest_resolution = 1e6;  ///< metres per pixel
inline constexpr double farthest_origin = 1e9;      ///< metres from zero, along x and y

/// A trinary occupancy grid and the frame it lives in.
///
/// Two frames exist. *Pixel coordinates* are continuous, x right and y down; pixel (c, r) covers [c, c+1) × [r, r+1).
/// *Map units* are what users speak: the same as pixel coordinates for a plain picture, metres with y up for a map that
/// has a resolution and an origin (the convention of ROS map_server). This class is the only place that converts.
class OccupancyMap {
 public:
  /// A plain picture: map units are pixels.
  /// @param cells row-major, row 0 at the top, width × height values.
  /// @throws MapError when a side is not positive, the number of cells does not fit, or there are more than
  /// max_map_pixels.
  OccupancyMap(int width, int height, std::vector<Cell> cells);

  /// A metric map in the convention of ROS map_server.
  /// @param resolution metres per pixel, from 1e-6 to 1e6.
  /// @param origin pose of the lower-left corner of the lower-left pixel.
  /// @throws MapError as above, and for a resolution out of range or an origin that is not finite or farther than 1e9
  /// metres.
  OccupancyMap(int width, int height, std::vector<Cell> cells, double resolution, Pose2 origin);

  /// Columns.
  int width() const { return width_; }
  /// Rows.
  int height() const { return height_; }
  /// Number of pixels.
  std::size_t size() const { return cells_.size(); }
  /// Row-major, row 0 at the top.
  const std::vector<Cell>& cells() const { return cells_; }

  /// True for a map in metres, false for a plain picture.
  bool is_metric() const { return frame_.metric; }
  /// Map units per pixel; 1 for a plain picture, unless it was coarsened.
  double resolution() const { return frame_.resolution * frame_.coarseness; }
  /// Pose of the lower-left corner of the lower-left pixel; zeros for a plain picture.
  Pose2 origin() const;
  /// Pixels along either side of this map's pixels in the map that it was made from, see coarsened(); else 1.
  int coarseness() const { return frame_.coarseness; }

  /// True when the pixel lies on the map.
  bool contains(Pixel p) const { return p.c >= 0 && p.r >= 0 && p.c < width_ && p.r < height_; }
  /// Row-major index of a pixel that the map contains.
  std::size_t index(Pixel p) const {
    return static_cast<std::size_t>(p.r) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(p.c);
  }
  /// State of a pixel that the map contains.
  Cell at(Pixel p) const { return cells_[index(p)]; }
  /// True when the pixel lies on the map and is free (unknown is not free; see resolved()).
  bool is_free(Pixel p) const { return contains(p) && at(p) == Cell::free; }

  /// Row-major, 1 where a pixel is free, else 0.
  std::vector<std::uint8_t> free_mask() const;

  /// Pixel that holds a point in pixel coordinates; far-away points saturate and are never on the map.
  static Pixel pixel_of(const Eigen::Vector2d& point);
  /// Map units to pixel coordinates.
  Eigen::Vector2d to_pixel(const Eigen::Vector2d& world) const;
  /// Pixel coordinates to map units.
  Eigen::Vector2d to_world(const Eigen::Vector2d& pixel) const;
  /// Centre of a pixel in map units.
  Eigen::Vector2d center(Pixel p) const { return to_world({p.c + 0.5, p.r + 0.5}); }
  /// Smallest axis-aligned box in map units that holds the whole map.
  Bounds bounds() const;

  /// The same map with every unknown pixel turned into free or occupied.
  OccupancyMap resolved(UnknownIs meaning) const;
  /// The same frame with other cells. @throws MapError when their number does not fit.
  OccupancyMap with_cells(std::vector<Cell> cells) const;
  /// A part of the map. Map units mean the same on it, exactly: a pixel that holds a point holds it on both.
  /// @throws MapError when the box is empty or leaves the map.
  OccupancyMap cropped(const PixelBox& box) const;
  /// The map in larger pixels: free where all of factor × factor pixels are, occupied where one of them is or the block
  /// leaves the map, else unknown. Map units mean the same on it, exactly, so what is free on it is free on this map.
  /// @throws MapError when the factor is no power of two from 1 to 16384.
  OccupancyMap coarsened(int factor) const;
  /// The least factor with which coarsened() leaves at most so many pixels a side, one at the least.
  int coarsening_to(int most_side) const;

 private:
  /// From map units to the pixels of the map that this one was made from, and on to its own.
  struct Frame {
    bool metric = false;
    double resolution = 1.0;  ///< of the original, as are the next four
    Pose2 origin{};
    double cos_yaw = 1.0;
    double sin_yaw = 0.0;
    double height = 0.0;
    Eigen::Vector2d corner = Eigen::Vector2d::Zero();  ///< of this map, pixels of the original, whole numbers
    int coarseness = 1;                                ///< a power of two, so that no division rounds
  };

  OccupancyMap(int width, int height, std::vector<Cell> cells, const Frame& frame);

  int width_;
  int height_;
  std::vector<Cell> cells_;
  Frame frame_;
};

}  // namespace lrrt
