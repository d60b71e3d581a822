// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include "maze.hpp"
#include "number_rules.hpp"
#include "suite.hpp"

namespace lrrt::bench {
namespace {

constexpr NumberRule any_number{-endless, endless, "a number"};
constexpr NumberRule counts_or_all{0, 1e6, "0 (all) or a whole number up to 1000000"};
constexpr NumberRule sides{5, 16384, "a side from 5 to 16384 pixels"};
constexpr NumberRule sides_or_zero{0, 16384, "a side from 5 to 16384 pixels, or 0 for the map as it is"};
constexpr NumberRule tiles{32, 16384, "a side from 32 to 16384 pixels"};
constexpr NumberRule far_shares{1e-6, 1, "a share of the longest way, above 0 and up to 1"};
constexpr NumberRule scales{1e-6, 1e6, "a factor from 1e-6 to 1e6"};

/// A place, or a place and a heading where there are any.
Pose2 place(const Fields& fields, const std::string& key, bool headings) {
  const char* expected = headings ? "[x, y, heading] in map units and radians" : "two numbers [x, y] in map units";
  fields.require(key, expected);
  const std::vector<double> numbers = fields.numbers(key, {}, any_number);
  if (numbers.size() != (headings ? 3 : 2)) fields.refuse(key, expected);
  return {numbers[0], numbers[1], headings ? numbers[2] : 0.0};
}

QuerySource read_random(const Fields& fields) {
  fields.allow_only({"kind", "count", "apart", "far", "drivable", "seed"});
  QuerySource query;
  query.kind = QuerySource::Kind::random;
  query.count = static_cast<int>(fields.count("count", query.count, counts));
  query.apart = fields.number("apart", query.apart, shares);
  query.far = fields.number("far", query.far, far_shares);
  if (fields.has("apart") && fields.has("far")) {
    fields.refuse("far", "either 'apart' (as the crow flies) or 'far' (walking), not both");
  }
  if (fields.has("drivable")) query.drivable = fields.word("drivable", "", {"dubins", "reeds_shepp"});
  query.seed = fields.seed("seed", query.seed);
  return query;
}

QuerySource read_query(const Fields& fields, bool headings) {
  const std::string kind = fields.word("kind", "", {"farthest", "random", "points", "scen"});
  if (kind == "random") return read_random(fields);
  QuerySource query;
  if (kind == "farthest") {
    fields.allow_only({"kind"});
  } else if (kind == "points") {
    fields.allow_only({"kind", "start", "goal"});
    query.kind = QuerySource::Kind::points;
    query.start = place(fields, "start", headings);
    query.goal = place(fields, "goal", headings);
  } else {
    fields.allow_only({"kind", "path", "count"});
    query.kind = QuerySource::Kind::scen;
    query.path = fields.text("path", "");
    query.count = static_cast<int>(fields.count("count", 0, counts_or_all));
  }
  return query;
}

std::vector<QuerySource> read_queries(const Fields& fields, bool headings, const std::vector<QuerySource>& fallback) {
  if (!fields.has("queries")) return fallback;
  std::vector<QuerySource> result;
  for (const Fields& child : fields.children("queries")) result.push_back(read_query(child, headings));
  return result;
}

MapSource read_maze(const Fields& fields) {
  fields.allow_only({"kind", "name", "level", "algorithm", "count", "pixels", "braid", "seed", "scale", "queries"});
  MapSource source;
  source.level = static_cast<int>(fields.count("level", source.level, levels));
  if (source.level % 2 == 0) fields.refuse("level", levels.expected);
  source.algorithms = fields.texts("algorithm", source.algorithms);
  const std::vector<std::string>& known = maze_algorithm_names();
  for (const std::string& name : source.algorithms) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      fields.refuse("algorithm", "dfs, prim, wilson, or a list of such");
    }
  }
  source.count = static_cast<int>(fields.count("count", source.count, counts));
  source.pixels = static_cast<int>(fields.count("pixels", source.pixels, sides));
  if (source.pixels < source.level) fields.refuse("pixels", "at least one pixel a block");
  check_pixels(fields, "count", source.count, source.pixels);
  source.braid = fields.number("braid", source.braid, shares);
  source.seed = fields.seed("seed", source.seed);
  const std::string level = std::to_string(source.level);
  source.name = "mazes of " + level + "×" + level + " blocks on " + std::to_string(source.pixels) + " pixels";
  return source;
}

MapSource read_mosaic(const Fields& fields) {
  fields.allow_only({"kind", "name", "path", "pixels", "tile", "corridor", "count", "seed", "scale", "queries"});
  MapSource source;
  source.kind = MapSource::Kind::mosaic;
  source.pixels = static_cast<int>(fields.count("pixels", 4096, sides));
  source.tile = static_cast<int>(fields.count("tile", source.tile, tiles));
  if (source.tile > source.pixels) fields.refuse("tile", "no more than 'pixels'");
  source.corridor = static_cast<int>(fields.count("corridor", source.corridor, counts));
  if (source.corridor > source.tile / 4) fields.refuse("corridor", "at most a quarter of 'tile'");
  source.count = static_cast<int>(fields.count("count", source.count, counts));
  check_pixels(fields, "count", source.count, source.pixels);
  source.seed = fields.seed("seed", source.seed);
  return source;
}

MapSource read_files(const Fields& fields, MapSource::Kind kind) {
  fields.allow_only({"kind", "name", "path", "pixels", "scale", "queries"});
  MapSource source;
  source.kind = kind;
  source.pixels = static_cast<int>(fields.count("pixels", 0, sides_or_zero));
  if (source.pixels > 0 && source.pixels < sides.least) fields.refuse("pixels", sides_or_zero.expected);
  return source;
}

MapSource read_map_source(const Fields& fields, bool headings, const std::vector<QuerySource>& queries) {
  const std::string kind = fields.word("kind", "", {"maze", "file", "folder", "mosaic"});
  MapSource source;
  if (kind == "maze") {
    source = read_maze(fields);
  } else {
    source = kind == "mosaic" ? read_mosaic(fields)
                              : read_files(fields, kind == "file" ? MapSource::Kind::file : MapSource::Kind::folder);
    fields.require("path", "a path, relative to the suite's folder");
    source.path = source.name = fields.text("path", "");
  }
  source.name = fields.text("name", source.name);
  source.scale = fields.number("scale", source.scale, scales);
  source.queries = read_queries(fields, headings, queries);
  if (source.queries.empty()) fields.refuse_all("no queries: expected a list 'queries' here or at the top of the file");
  return source;
}

}  // namespace

std::vector<MapSource> read_map_sources(const Fields& fields, bool headings) {
  fields.require("maps", "a list of maps");
  const std::vector<QuerySource> queries = read_queries(fields, headings, {});
  std::vector<MapSource> maps;
  for (const Fields& child : fields.children("maps")) {
    MapSource source = read_map_source(child, headings, queries);
    const auto same = [&](const MapSource& other) { return other.name == source.name; };
    if (std::any_of(maps.begin(), maps.end(), same)) {
      child.refuse_all("a second entry is called '" + source.name + "': expected a 'name' of its own");
    }
    maps.push_back(std::move(source));
  }
  return maps;
}

}  // namespace lrrt::bench
