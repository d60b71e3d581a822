// SPDX-License-Identifier: BSD-3-Clause
#include "problem_export.hpp"

#include <cmath>
#include <map>

#include "lrrt/io/read_map.hpp"
#include "outputs.hpp"
#include "problems.hpp"
#include "reference.hpp"
#include "result_file.hpp"
#include "robot.hpp"
#include "suite_files.hpp"

namespace lrrt::bench {
namespace {

Image picture_of(const OccupancyMap& map) {
  Image image;
  image.width = map.width();
  image.height = map.height();
  image.channels = 1;
  for (int r = 0; r < map.height(); ++r) {
    for (int c = 0; c < map.width(); ++c) image.pixels.push_back(map.is_free({c, r}) ? 255 : 0);
  }
  return image;
}

Json point(const Eigen::Vector2d& p) {
  return {p.x(), p.y()};
}

Json problem_json(const Problem& problem, const OccupancyMap& map, const std::string& picture, const PlanSuite& suite) {
  const double optimum = suite.reference ? shortest_length(map, problem.start, problem.goal) : std::nan("");
  Json json = {{"group", problem.group},
               {"map", problem.map_name},
               {"query", problem.query},
               {"picture", picture},
               {"resolution", map.resolution()},
               {"start", point(problem.start)},
               {"goal", point(problem.goal)},
               {"start_pixel", point(map.to_pixel(problem.start))},
               {"goal_pixel", point(map.to_pixel(problem.goal))},
               {"optimum", number_or_null(optimum)}};
  if (suite.has_headings()) json["headings"] = {problem.start_heading, problem.goal_heading};
  json["scale"] = problem.scale;
  return json;
}

/// Makes the folder, where none of the suite's own maps may lie: pictures are called alike.
void make_folder(const std::filesystem::path& folder, const Suite& suite) {
  const auto refuse = [&](const std::string& problem) {
    throw ResultError("--problems " + folder.string() + ": " + problem);
  };
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder, error) || !can_make(folder / "problems.json.new")) {
    refuse("cannot be made; expected a folder that may be written");
  }
  for (const std::filesystem::path& file : files_of_maps(suite)) {
    if (!std::filesystem::equivalent(std::filesystem::absolute(file).parent_path(), folder, error)) continue;
    refuse("holds " + file.string() + ", which the suite reads; expected a folder of its own");
  }
}

}  // namespace

std::size_t export_problems(const Suite& suite, const std::filesystem::path& folder) {
  const auto* body = std::get_if<PlanSuite>(&suite.body);
  if (body == nullptr) throw SuiteError("--problems: the suite predicts and plans nothing; expected 'kind: plan'");
  make_folder(folder, suite);
  Json document = {{"suite", to_json(suite)}, {"problems", Json::array()}};
  std::map<std::string, std::string> pictures;  // by map
  for (const Problem& problem : make_problems(suite)) {
    const OccupancyMap map = planning_map(problem, *body);
    std::string& picture = pictures[problem.map_name];
    if (picture.empty()) {
      picture = "map_" + std::to_string(pictures.size()) + ".png";
      write_png(folder / picture, picture_of(map));
    }
    document["problems"].push_back(problem_json(problem, map, picture, *body));
  }
  write_file(folder / "problems.json", dumped(document, 1) + "\n");
  return document["problems"].size();
}

}  // namespace lrrt::bench
