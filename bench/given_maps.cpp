// SPDX-License-Identifier: BSD-3-Clause
#include "given_maps.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <utility>

#include "fields.hpp"

namespace lrrt::bench {
namespace {

namespace fs = std::filesystem;

std::string lower_extension(const fs::path& path) {
  std::string text = path.extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool has_yaml_beside(fs::path path) {
  std::error_code ignored;
  return fs::exists(path.replace_extension(".yaml"), ignored) || fs::exists(path.replace_extension(".yml"), ignored);
}

/// By its name: a map file, but not the picture of a map_server map, which is no map of its own.
bool is_map(const fs::path& path) {
  constexpr std::array<const char*, 9> pictures = {".png", ".pgm",  ".ppm", ".pbm", ".bmp",
                                                   ".jpg", ".jpeg", ".pnm", ".map"};
  const std::string extension = lower_extension(path);
  if (extension == ".yaml" || extension == ".yml") return true;
  return std::find(pictures.begin(), pictures.end(), extension) != pictures.end() && !has_yaml_beside(path);
}

template <typename Iterator>
std::vector<fs::path> maps_among(const fs::path& path) {
  std::error_code error;
  if (fs::is_regular_file(path, error)) return {path};
  std::vector<fs::path> result;
  fs::path last = path;  // the folder that cannot be read, where one cannot
  Iterator entries(path, error);
  while (!error && entries != Iterator()) {
    last = entries->path();
    if (is_map(last)) result.push_back(last);
    entries.increment(error);
  }
  std::error_code ignored;
  if (error && fs::exists(path, ignored)) {
    throw SuiteError("maps: the folder " + last.string() + " cannot be read: " + error.message());
  }
  std::sort(result.begin(), result.end());
  if (result.empty()) throw SuiteError("maps: the folder " + path.string() + " holds no map or does not exist");
  return result;
}

}  // namespace

std::vector<fs::path> maps_in(const fs::path& path) {
  return maps_among<fs::directory_iterator>(path);
}

std::vector<fs::path> maps_below(const fs::path& path) {
  return maps_among<fs::recursive_directory_iterator>(path);
}

OccupancyMap resized(const OccupancyMap& map, int pixels) {
  const double factor = static_cast<double>(pixels) / std::max(map.width(), map.height());
  const auto side = [&](int old) { return std::max(1, static_cast<int>(std::lround(old * factor))); };
  const auto nearest = [](int i, int side, int old) { return static_cast<int>((i + 0.5) * old / side); };
  const int width = side(map.width());
  const int height = side(map.height());
  std::vector<Cell> cells;
  cells.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int r = 0; r < height; ++r) {
    const int row = nearest(r, height, map.height());
    for (int c = 0; c < width; ++c) cells.push_back(map.at({nearest(c, width, map.width()), row}));
  }
  if (!map.is_metric()) return {width, height, std::move(cells)};
  return {width, height, std::move(cells), map.resolution() / factor, map.origin()};
}

}  // namespace lrrt::bench
