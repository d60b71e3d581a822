// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "fields.hpp"
#include "json.hpp"
#include "lrrt/plan.hpp"

namespace lrrt::bench {

/// Where the start and goal pairs of a map come from.
struct QuerySource {
  enum class Kind {
    farthest,  ///< the two ends of the longest way
    random,    ///< random places in the largest component, far apart; where there are headings, random ones
    points,    ///< given points
    scen,      ///< a MovingAI scenario list
  };
  Kind kind = Kind::farthest;
  int count = 1;       ///< random: pairs a map; scen: so many of the list, evenly spread, 0 for all
  double apart = 0.5;  ///< random: least straight distance, as a share of the component's diagonal
  double far = 0.0;    ///< random: if above 0, instead: least walking distance, as a share of the longest way
  /// random: a motion; only pairs between which HybridSearch finds a way for it. Empty for no such condition.
  std::string drivable;
  std::uint64_t seed = 1;  ///< random
  Pose2 start{};           ///< points: map units, radians
  Pose2 goal{};            ///< points: map units, radians
  std::string path;        ///< scen: file; empty for the map's own name and ".scen"
};

/// One entry of a suite's `maps`: one map, or many that are reported together.
struct MapSource {
  enum class Kind {
    maze,    ///< generated
    file,    ///< one map
    folder,  ///< every map in it
    mosaic,  ///< generated of the maps in a folder, see mosaic_of()
  };
  Kind kind = Kind::maze;
  std::string name;                            ///< the group's heading
  std::string path;                            ///< file, folder, mosaic
  int level = 25;                              ///< maze: blocks a side
  std::vector<std::string> algorithms{"dfs"};  ///< maze: taken in turn
  int count = 1;                               ///< maze, mosaic: how many
  int pixels = 256;                            ///< side of the map; file, folder: longer side, 0 leaves it as it is
  int tile = 512;                              ///< mosaic: side of a tile, pixels
  int corridor = 16;                           ///< mosaic: width of the ways between tiles, pixels
  double braid = 0.0;                          ///< maze: share of dead ends with a second exit
  std::uint64_t seed = 1;                      ///< maze, mosaic
  double scale = 1.0;                          ///< what the robot's lengths are multiplied by on these maps
  std::vector<QuerySource> queries;
};

/// One row of the report: a planner with all of its settings.
struct PlanRow {
  std::string name;
  std::string strategy = "region";  ///< a word that the library knows
  std::string model = "default";    ///< a file, the model that ships, or one of made_region_names()
  std::string stop = "first";       ///< a word that the library knows
  std::string neighbors = "grid";   ///< a word that the library knows
  std::string motion = "plane";     ///< a word that the library knows
  double turning_radius = 0.0;      ///< of a car, map units before MapSource::scale
  int detail = 0;                   ///< pixels a side of the maps that the model is shown; 0 leaves it to the model
  std::string after;                ///< what happens between two plans, of which the second counts: move, obstacle
  bool session = false;             ///< whether the second plan is that of a session, which knows the first one
  std::string baseline;             ///< name of the row that this one is compared with; empty for the suite's
  PlanOptions options;              ///< complete but for the seed

  bool has_heading() const { return motion != "plane"; }
  bool guided() const { return options.strategy != Strategy::uniform; }
};

/// `kind: plan`: planners against each other on the same queries with the same seeds.
struct PlanSuite {
  std::vector<MapSource> maps;
  std::vector<PlanRow> rows;
  std::string baseline;    ///< name of the row that the others are compared with
  int runs = 10;           ///< seeds a query
  std::uint64_t seed = 1;  ///< of the first run; the next run takes the next number
  double radius = 0.0;     ///< of the disc-shaped robot, or a margin around its outline; map units before the scale
  std::optional<Polygon> outline{};  ///< of the robot, map units before the scale; for rows with a heading
  double move = 1.0;      ///< how far the robot gets along its path, for rows after a move; map units before the scale
  double obstacle = 0.3;  ///< side of the square that stands on the path, for rows after an obstacle; the same units
  UnknownIs unknown = UnknownIs::occupied;
  int threads = 0;        ///< of one prediction; 0 lets the library choose
  bool reference = true;  ///< whether the exact shortest path is computed; for a point or disc in the plane

  /// Whether start and goal are poses: some row has headings.
  bool has_headings() const {
    return std::any_of(rows.begin(), rows.end(), [](const PlanRow& row) { return row.has_heading(); });
  }
};

/// `kind: predict`: how fast models predict.
struct PredictSuite {
  std::vector<std::string> models{"default"};  ///< files, patterns such as "models/*", or "default"
  std::vector<int> sizes{256};                 ///< sides of the maps, pixels
  std::vector<int> threads{1, 2};              ///< of one call
  std::vector<int> batch{1};                   ///< predictions of one call
  std::vector<bool> spinning{false};           ///< whether idle threads spin
  int level = 35;                              ///< blocks a side of the mazes that are shown
  int mazes = 8;                               ///< different mazes a size, taken in turn
  int runs = 200;                              ///< predictions a setting
  std::uint64_t seed = 1;                      ///< of the mazes
};

/// What a suite file says.
struct Suite {
  std::string title;
  std::filesystem::path folder;  ///< where relative paths start
  std::variant<PlanSuite, PredictSuite> body;

  /// A path in the suite, resolved.
  std::filesystem::path resolved(const std::string& path) const { return (folder / path).lexically_normal(); }
};

/// What the command line changes about a suite.
struct Overrides {
  std::optional<int> runs;
  std::optional<std::uint64_t> seed;
  std::optional<double> time_limit;
  /// Files and folders that take the place of the suite's maps: of each entry that reads files, with its settings but
  /// for the scale. Where none does, five random queries each.
  std::vector<std::string> maps;
  std::vector<std::string> models;  ///< files and patterns that take the place of the suite's models
};

/// Reads a suite.
/// @param text YAML; JSON as to_json() writes it is YAML too.
/// @param file its name in errors. @param folder where relative paths start.
/// @throws SuiteError that names file, line and key.
Suite parse_suite(const std::string& text, const std::string& file, const std::filesystem::path& folder);

/// @param name of a suite that ships, or a file. @throws SuiteError as parse_suite(), and when there is no such file.
Suite load_suite(const std::string& name);

/// Where a suite lies. @param name as for load_suite(). @throws SuiteError when there is no such file.
std::filesystem::path suite_file(const std::string& name);

/// The suites that ship, by name.
std::vector<std::string> shipped_suites();

/// @throws SuiteError when maps are not there, or the suite has no use for maps or models.
void apply(const Overrides& overrides, Suite& suite);

/// Everything that a suite says, defaults spelled out. parse_suite() reads it back.
Json to_json(const Suite& suite);

/// @param key of the number of mazes. @throws SuiteError when so many pictures of that side are more than fit into the
/// memory of most machines.
void check_pixels(const Fields& fields, const std::string& key, int count, int side);

/// What a suite says of one of its maps. @param headings whether given places have one.
Json to_json(const MapSource& source, bool headings);

/// Reads the body of a `kind: plan` suite. @throws SuiteError.
PlanSuite read_plan_suite(const Fields& fields);

/// Reads `maps`, each with its own queries or those at the top of the file. @param headings whether start and goal have
/// one. @throws SuiteError.
std::vector<MapSource> read_map_sources(const Fields& fields, bool headings);

/// Reads `planners`, the rows of the report. @param robot radius and outline that they plan for. @throws SuiteError.
std::vector<PlanRow> read_plan_rows(const Fields& fields, const PlanSuite& robot);

/// What a row may say, and the top of the file for all rows.
const std::vector<std::string>& row_keys();

}  // namespace lrrt::bench
