// SPDX-License-Identifier: BSD-3-Clause
#include "problems.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

#include "lrrt/io/read_map.hpp"
#include "lrrt/map/components.hpp"
#include "lrrt/map/footprint.hpp"
#include "lrrt/map/moving_ai.hpp"
#include "maze.hpp"
#include "models.hpp"

namespace lrrt::bench {
namespace {

namespace fs = std::filesystem;

/// A map and, where it was generated, the ends of its longest way.
struct NamedMap {
  std::string name;
  fs::path file;  ///< empty for a generated one
  std::shared_ptr<const OccupancyMap> map;
  std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> ends;
};

/// Start and goal with a name.
struct NamedQuery {
  std::string name;
  Eigen::Vector2d start;
  Eigen::Vector2d goal;
};

NamedMap make_maze(const MapSource& source, int number, Random& random) {
  const std::string& word = source.algorithms[static_cast<std::size_t>(number) % source.algorithms.size()];
  const std::vector<std::string>& words = maze_algorithm_names();
  const auto algorithm = static_cast<MazeAlgorithm>(std::find(words.begin(), words.end(), word) - words.begin());
  OccupancyMap maze = perfect_maze(source.level, algorithm, random);
  if (source.braid > 0.0) maze = braided(maze, source.braid, random);
  const auto [start, goal] = farthest_pixels(maze);
  NamedMap result;
  result.name = source.name + " #" + std::to_string(number) + " " + word;
  result.map = std::make_shared<const OccupancyMap>(drawn(maze, source.pixels));
  result.ends = {drawn_center(maze, start, source.pixels), drawn_center(maze, goal, source.pixels)};
  return result;
}

std::string lower_extension(const fs::path& path) {
  std::string text = path.extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool has_yaml_beside(fs::path path) {
  std::error_code ignored;
  return fs::exists(path.replace_extension(".yaml"), ignored) || fs::exists(path.replace_extension(".yml"), ignored);
}

/// Maps in a folder, by name; the picture of a map_server map is no map of its own.
std::vector<fs::path> maps_in(const fs::path& folder) {
  constexpr std::array<const char*, 9> pictures = {".png", ".pgm",  ".ppm", ".pbm", ".bmp",
                                                   ".jpg", ".jpeg", ".pnm", ".map"};
  std::vector<fs::path> result;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored)) {
    const std::string extension = lower_extension(entry.path());
    const bool yaml = extension == ".yaml" || extension == ".yml";
    const bool picture = std::find(pictures.begin(), pictures.end(), extension) != pictures.end();
    if (yaml || (picture && !has_yaml_beside(entry.path()))) result.push_back(entry.path());
  }
  std::sort(result.begin(), result.end());
  if (result.empty()) throw SuiteError("maps: the folder " + folder.string() + " holds no map or does not exist");
  return result;
}

std::vector<NamedMap> maps_of(const MapSource& source, const Suite& suite) {
  std::vector<NamedMap> maps;
  if (source.kind == MapSource::Kind::maze) {
    Random random(source.seed);
    for (int i = 0; i < source.count; ++i) maps.push_back(make_maze(source, i, random));
    return maps;
  }
  const fs::path path = suite.resolved(source.path);
  const bool folder = source.kind == MapSource::Kind::folder;
  for (const fs::path& file : folder ? maps_in(path) : std::vector<fs::path>{path}) {
    const std::string name = folder ? source.name + "/" + file.filename().string() : source.name;
    maps.push_back({name, file, std::make_shared<const OccupancyMap>(read_map(file)), std::nullopt});
  }
  return maps;
}

std::vector<NamedQuery> farthest(const NamedMap& named, const OccupancyMap& planning) {
  const bool given = named.ends && planning.is_free(OccupancyMap::pixel_of(planning.to_pixel(named.ends->first))) &&
                     planning.is_free(OccupancyMap::pixel_of(planning.to_pixel(named.ends->second)));
  if (given) return {{"farthest", named.ends->first, named.ends->second}};
  const auto [start, goal] = farthest_pixels(planning);
  return {{"farthest", planning.center(start), planning.center(goal)}};
}

/// The free pixels of the largest component, and the diagonal of its box.
struct Room {
  std::vector<Pixel> pixels;
  double diagonal = 0.0;
};

Room largest_room(const OccupancyMap& map) {
  const Components components(map);
  const int label = components.label(farthest_pixels(map).first);
  const PixelBox& box = components.box(label);
  Room room;
  room.diagonal = std::hypot(box.width, box.height);
  for (int r = box.r; r < box.r + box.height; ++r) {
    for (int c = box.c; c < box.c + box.width; ++c) {
      if (components.label({c, r}) == label) room.pixels.push_back({c, r});
    }
  }
  return room;
}

/// Pairs at least so far apart; where chance finds none, the farthest pair that it saw.
std::vector<NamedQuery> random_pairs(const QuerySource& source, const OccupancyMap& planning) {
  constexpr int tries = 1000;
  const Room room = largest_room(planning);
  Random random(source.seed);
  std::vector<NamedQuery> queries;
  for (int i = 0; i < source.count; ++i) {
    std::pair<Pixel, Pixel> best;
    double farthest = -1.0;
    for (int k = 0; k < tries && farthest < source.apart * room.diagonal; ++k) {
      const Pixel a = room.pixels[random.index(room.pixels.size())];
      const Pixel b = room.pixels[random.index(room.pixels.size())];
      const double distance = std::hypot(a.c - b.c, a.r - b.r);
      if (distance > farthest) best = {a, b};
      farthest = std::max(farthest, distance);
    }
    queries.push_back({"random #" + std::to_string(i), planning.center(best.first), planning.center(best.second)});
  }
  return queries;
}

/// Problems of a scenario list, evenly spread over it: such lists are sorted by difficulty.
std::vector<NamedQuery> scenario_queries(const QuerySource& source, const NamedMap& named, const Suite& suite) {
  fs::path path = suite.resolved(source.path);
  if (source.path.empty()) path = named.file.string() + ".scen";
  const std::vector<Scenario> scenarios = read_scenarios(path);
  const std::size_t all = scenarios.size();
  const std::size_t wanted = source.count == 0 ? all : std::min(all, static_cast<std::size_t>(source.count));
  std::vector<NamedQuery> queries;
  for (std::size_t i = 0; i < wanted; ++i) {
    const std::size_t line = wanted == 1 ? all - 1 : i * (all - 1) / (wanted - 1);
    const Scenario& s = scenarios[line];
    if (s.width != named.map->width() || s.height != named.map->height()) {
      throw SuiteError(path.string() + ": problem " + std::to_string(line) + " is for a map of " +
                       std::to_string(s.width) + "×" + std::to_string(s.height) + " pixels; expected one for " +
                       named.name + ", " + std::to_string(named.map->width()) + "×" +
                       std::to_string(named.map->height()));
    }
    queries.push_back({"scen #" + std::to_string(line), named.map->center(s.start), named.map->center(s.goal)});
  }
  return queries;
}

std::vector<NamedQuery> queries_of(const QuerySource& source, const NamedMap& named, const OccupancyMap& planning,
                                   const Suite& suite) {
  switch (source.kind) {
    case QuerySource::Kind::farthest:
      break;
    case QuerySource::Kind::random:
      return random_pairs(source, planning);
    case QuerySource::Kind::points:
      return {{"points", source.start, source.goal}};
    case QuerySource::Kind::scen:
      return scenario_queries(source, named, suite);
  }
  return farthest(named, planning);
}

}  // namespace

OccupancyMap planning_map(const OccupancyMap& map, const PlanSuite& suite) {
  return inflated(map.resolved(suite.unknown), suite.radius);
}

std::vector<Problem> make_problems(const Suite& suite) {
  const auto& body = std::get<PlanSuite>(suite.body);
  std::vector<Problem> problems;
  for (const MapSource& source : body.maps) {
    for (const NamedMap& named : maps_of(source, suite)) {
      const OccupancyMap planning = planning_map(*named.map, body);
      for (std::size_t i = 0; i < source.queries.size(); ++i) {
        const std::string suffix = source.queries.size() > 1 ? " [" + std::to_string(i) + "]" : "";
        for (const NamedQuery& q : queries_of(source.queries[i], named, planning, suite)) {
          problems.push_back({source.name, named.name, named.map, q.name + suffix, q.start, q.goal});
        }
      }
    }
  }
  return problems;
}

std::string map_checksum(const OccupancyMap& map) {
  std::string bytes = std::to_string(map.width()) + "x" + std::to_string(map.height()) + " ";
  for (const Cell cell : map.cells()) bytes += static_cast<char>(cell);
  return checksum_of(bytes);
}

}  // namespace lrrt::bench
