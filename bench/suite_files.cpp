// SPDX-License-Identifier: BSD-3-Clause
#include "suite_files.hpp"

#include <set>

#include "given_maps.hpp"
#include "made_regions.hpp"
#include "models.hpp"

namespace lrrt::bench {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> maps_of(const MapSource& source, const Suite& suite) {
  const fs::path path = suite.resolved(source.path);
  switch (source.kind) {
    case MapSource::Kind::maze:
      break;
    case MapSource::Kind::file:
      return {path};
    case MapSource::Kind::folder:
      return maps_in(path);
    case MapSource::Kind::mosaic:
      return maps_below(path);
  }
  return {};
}

void add(const std::vector<fs::path>& more, std::vector<fs::path>& files) {
  files.insert(files.end(), more.begin(), more.end());
}

std::vector<fs::path> lists_of(const QuerySource& query, const std::vector<fs::path>& maps, const Suite& suite) {
  if (query.kind != QuerySource::Kind::scen) return {};
  if (!query.path.empty()) return {suite.resolved(query.path)};
  std::vector<fs::path> lists;
  lists.reserve(maps.size());
  for (const fs::path& map : maps) lists.emplace_back(map.string() + ".scen");
  return lists;
}

std::vector<fs::path> files_of(const PlanSuite& body, const Suite& suite) {
  std::vector<fs::path> files = files_of_maps(suite);
  std::set<std::string> models;
  for (const PlanRow& row : body.rows) {
    if (row.guided() && models.insert(row.model).second && !made_region(row.model)) {
      files.push_back(model_path(suite, row.model));
    }
  }
  return files;
}

std::vector<fs::path> files_of(const PredictSuite& body, const Suite& suite) {
  std::vector<fs::path> files;
  for (const std::string& pattern : body.models) {
    for (const std::string& model : matching_models(suite, pattern).found) files.push_back(model_path(suite, model));
  }
  return files;
}

}  // namespace

std::vector<fs::path> files_of_maps(const Suite& suite) {
  const auto* body = std::get_if<PlanSuite>(&suite.body);
  if (body == nullptr) return {};
  std::vector<fs::path> files;
  for (const MapSource& source : body->maps) {
    const std::vector<fs::path> maps = maps_of(source, suite);
    add(maps, files);
    for (const QuerySource& query : source.queries) add(lists_of(query, maps, suite), files);
  }
  return files;
}

std::vector<fs::path> files_of(const Suite& suite) {
  return std::visit([&](const auto& body) { return files_of(body, suite); }, suite.body);
}

}  // namespace lrrt::bench
