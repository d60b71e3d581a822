// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <tuple>
#include <utility>

#include "given_maps.hpp"
#include "lrrt/map/components.hpp"
#include "maze.hpp"

namespace lrrt::bench {
namespace {

/// Pixels around a tile that its map leaves blocked.
constexpr int margin = 4;

/// A square grid of pixels that are blocked until they are opened.
class Canvas {
 public:
  explicit Canvas(int side)
      : side_(side), cells_(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), Cell::occupied) {}

  void open(Pixel p) {
    if (p.c < 1 || p.r < 1 || p.c >= side_ - 1 || p.r >= side_ - 1) return;
    cells_[static_cast<std::size_t>(p.r) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(p.c)] =
        Cell::free;
  }
  /// Opens a straight way along a row or a column. @param width pixels.
  void open_way(Pixel from, Pixel to, int width) {
    const int before = (width - 1) / 2;
    const int after = width / 2;
    for (int r = std::min(from.r, to.r) - before; r <= std::max(from.r, to.r) + after; ++r) {
      for (int c = std::min(from.c, to.c) - before; c <= std::max(from.c, to.c) + after; ++c) open({c, r});
    }
  }
  OccupancyMap map() && { return {side_, side_, std::move(cells_)}; }

 private:
  int side_;
  std::vector<Cell> cells_;
};

/// Pixels of a component, and the box that holds them.
struct Part {
  std::vector<Pixel> pixels;
  PixelBox box;
};

/// The largest component of the free pixels. @throws MapError when there is none.
Part largest_part(const OccupancyMap& map) {
  const Components components(map);
  const int label = largest_component(components);
  return {pixels_of(components, label), components.box(label)};
}

/// What of a part fits into a square: all of it, or the largest piece in a window around one of its pixels.
Part fitting_part(const Part& whole, int side, Random& random) {
  if (whole.box.width <= side && whole.box.height <= side) return whole;
  const Pixel middle = whole.pixels[random.index(whole.pixels.size())];
  const auto begin = [&](int at, int low, int length) {
    return std::clamp(at - side / 2, low, low + std::max(0, length - side));
  };
  const Pixel corner{begin(middle.c, whole.box.c, whole.box.width), begin(middle.r, whole.box.r, whole.box.height)};
  std::vector<Cell> cells(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), Cell::occupied);
  OccupancyMap window(side, side, cells);
  for (const Pixel p : whole.pixels) {
    const Pixel inside{p.c - corner.c, p.r - corner.r};
    if (window.contains(inside)) cells[window.index(inside)] = Cell::free;
  }
  return largest_part(window.with_cells(std::move(cells)));
}

/// A part moved to a box's corner and turned, with the box's sides along the way.
Part turned(Part part, std::size_t quarters) {
  for (Pixel& p : part.pixels) p = {p.c - part.box.c, p.r - part.box.r};
  part.box.c = part.box.r = 0;
  for (std::size_t i = 0; i < quarters; ++i) {
    for (Pixel& p : part.pixels) p = {part.box.height - 1 - p.r, p.c};
    std::swap(part.box.width, part.box.height);
  }
  return part;
}

/// The pixels of a turned part somewhere in a square of so many pixels a side.
std::vector<Pixel> placed(Part part, Pixel corner, int side, Random& random) {
  const auto shift = [&](int length) {
    return static_cast<int>(random.index(static_cast<std::size_t>(side) - static_cast<std::size_t>(length) + 1));
  };
  const int c = corner.c + shift(part.box.width);
  const int r = corner.r + shift(part.box.height);
  for (Pixel& p : part.pixels) p = {p.c + c, p.r + r};
  return std::move(part.pixels);
}

/// One of the pixels of a tile nearest to its side in a direction.
Pixel near_side(const std::vector<Pixel>& tile, Pixel direction, Random& random) {
  constexpr std::size_t most = 200;
  std::vector<Pixel> nearest(std::min(most, tile.size()));
  std::partial_sort_copy(tile.begin(), tile.end(), nearest.begin(), nearest.end(), [&](Pixel a, Pixel b) {
    const auto order = [&](Pixel p) { return std::make_tuple(-(p.c * direction.c + p.r * direction.r), p.r, p.c); };
    return order(a) < order(b);
  });
  return nearest[random.index(nearest.size())];
}

/// Joins two neighbouring tiles: out of the one, along the seam between them, into the other.
void join(Canvas& canvas, const std::vector<Pixel>& from, const std::vector<Pixel>& to, Pixel direction, int seam,
          int width, Random& random) {
  const Pixel a = near_side(from, direction, random);
  const Pixel b = near_side(to, {-direction.c, -direction.r}, random);
  const bool across = direction.c != 0;
  const Pixel a_seam = across ? Pixel{seam, a.r} : Pixel{a.c, seam};
  const Pixel b_seam = across ? Pixel{seam, b.r} : Pixel{b.c, seam};
  canvas.open_way(a, a_seam, width);
  canvas.open_way(a_seam, b_seam, width);
  canvas.open_way(b_seam, b, width);
}

}  // namespace

OccupancyMap mosaic_of(const std::vector<OccupancyMap>& maps, const MosaicLayout& layout, Random& random) {
  const int along = layout.side / layout.tile;
  const int offset = (layout.side - along * layout.tile) / 2;
  const int room = layout.tile - 2 * margin;
  Canvas canvas(layout.side);
  std::vector<Part> parts(maps.size());
  std::transform(maps.begin(), maps.end(), parts.begin(), largest_part);
  std::vector<std::vector<Pixel>> tiles;
  for (int i = 0; i < along * along; ++i) {
    Part part = fitting_part(parts[random.index(parts.size())], room, random);
    part = turned(std::move(part), random.index(4));
    const Pixel corner{offset + i % along * layout.tile + margin, offset + i / along * layout.tile + margin};
    tiles.push_back(placed(std::move(part), corner, room, random));
    for (const Pixel p : tiles.back()) canvas.open(p);
  }
  const auto tile = [&](int i) -> const std::vector<Pixel>& { return tiles[static_cast<std::size_t>(i)]; };
  for (int i = 0; i < along * along; ++i) {
    const int right = offset + (i % along + 1) * layout.tile;
    const int below = offset + (i / along + 1) * layout.tile;
    if (i % along + 1 < along) join(canvas, tile(i), tile(i + 1), {1, 0}, right, layout.corridor, random);
    if (i / along + 1 < along) join(canvas, tile(i), tile(i + along), {0, 1}, below, layout.corridor, random);
  }
  return std::move(canvas).map();
}

}  // namespace lrrt::bench
