// SPDX-License-Identifier: BSD-3-Clause
#include "problems.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <set>
#include <utility>

#include "given_maps.hpp"
#include "lrrt/io/read_map.hpp"
#include "maze.hpp"
#include "models.hpp"
#include "queries.hpp"

namespace lrrt::bench {
namespace {

namespace fs = std::filesystem;

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

std::vector<NamedMap> make_mosaics(const MapSource& source, const Suite& suite) {
  const UnknownIs unknown = std::get<PlanSuite>(suite.body).unknown;
  std::vector<OccupancyMap> parts;
  for (const fs::path& file : maps_below(suite.resolved(source.path)))
    parts.push_back(read_map(file).resolved(unknown));
  Random random(source.seed);
  std::vector<NamedMap> maps;
  for (int i = 0; i < source.count; ++i) {
    const std::string name = source.name + " #" + std::to_string(i);
    OccupancyMap mosaic = mosaic_of(parts, {source.pixels, source.tile, source.corridor}, random);
    maps.push_back({name, "", std::make_shared<const OccupancyMap>(std::move(mosaic)), std::nullopt});
  }
  return maps;
}

OccupancyMap read_sized(const fs::path& file, int pixels) {
  OccupancyMap map = read_map(file);
  return pixels == 0 ? map : resized(map, pixels);
}

std::vector<NamedMap> maps_of(const MapSource& source, const Suite& suite) {
  std::vector<NamedMap> maps;
  if (source.kind == MapSource::Kind::maze) {
    Random random(source.seed);
    for (int i = 0; i < source.count; ++i) maps.push_back(make_maze(source, i, random));
    return maps;
  }
  if (source.kind == MapSource::Kind::mosaic) return make_mosaics(source, suite);
  const fs::path path = suite.resolved(source.path);
  const bool folder = source.kind == MapSource::Kind::folder;
  for (const fs::path& file : folder ? maps_in(path) : std::vector<fs::path>{path}) {
    const std::string name = folder ? source.name + "/" + file.filename().string() : source.name;
    maps.push_back({name, file, std::make_shared<const OccupancyMap>(read_sized(file, source.pixels)), std::nullopt});
  }
  return maps;
}

/// The queries of one map.
void add_problems(const MapSource& source, const NamedMap& named, const Suite& suite, std::vector<Problem>& problems) {
  const Ground ground(*named.map, std::get<PlanSuite>(suite.body), source.scale);
  for (std::size_t i = 0; i < source.queries.size(); ++i) {
    const std::string suffix = source.queries.size() > 1 ? " [" + std::to_string(i) + "]" : "";
    for (const Query& q : queries_of(source.queries[i], named, ground, suite)) {
      problems.push_back({source.name,
                          named.name,
                          named.map,
                          q.name + suffix,
                          {q.start.x, q.start.y},
                          {q.goal.x, q.goal.y},
                          q.start.yaw,
                          q.goal.yaw,
                          source.scale});
    }
  }
}

}  // namespace

std::vector<Problem> make_problems(const Suite& suite) {
  std::vector<Problem> problems;
  std::set<std::string> names;
  for (const MapSource& source : std::get<PlanSuite>(suite.body).maps) {
    for (const NamedMap& named : maps_of(source, suite)) {
      if (!names.insert(named.name).second) {
        throw SuiteError("maps: a second map is called '" + named.name +
                         "': expected a 'name' of its own for the entry '" + source.name + "'");
      }
      add_problems(source, named, suite, problems);
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
