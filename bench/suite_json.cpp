// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "suite.hpp"

namespace lrrt::bench {
namespace {

Json pair(const Eigen::Vector2d& point) {
  return Json::array({point.x(), point.y()});
}

Json to_json(const QuerySource& query) {
  switch (query.kind) {
    case QuerySource::Kind::farthest:
      break;
    case QuerySource::Kind::random:
      return {{"kind", "random"}, {"count", query.count}, {"apart", query.apart}, {"seed", query.seed}};
    case QuerySource::Kind::points:
      return {{"kind", "points"}, {"start", pair(query.start)}, {"goal", pair(query.goal)}};
    case QuerySource::Kind::scen: {
      Json json = {{"kind", "scen"}, {"count", query.count}};
      if (!query.path.empty()) json["path"] = query.path;
      return json;
    }
  }
  return {{"kind", "farthest"}};
}

Json to_json(const MapSource& source) {
  Json json;
  if (source.kind == MapSource::Kind::maze) {
    json = {
        {"kind", "maze"},        {"name", source.name},     {"level", source.level}, {"algorithm", source.algorithms},
        {"count", source.count}, {"pixels", source.pixels}, {"braid", source.braid}, {"seed", source.seed}};
  } else {
    const bool file = source.kind == MapSource::Kind::file;
    json = {{"kind", file ? "file" : "folder"}, {"name", source.name}, {"path", source.path}};
  }
  for (const QuerySource& query : source.queries) json["queries"].push_back(to_json(query));
  return json;
}

Json to_json(const PlanRow& row) {
  const PlanOptions& o = row.options;
  const bool unlimited = o.iteration_limit == std::numeric_limits<std::size_t>::max();
  return {{"name", row.name},           {"planner", o.planner},
          {"strategy", row.strategy},   {"alpha", o.alpha},
          {"model", row.model},         {"range", o.range},
          {"goal_bias", o.goal_bias},   {"goal_tolerance", o.goal_tolerance},
          {"stop", row.stop},           {"cost_factor", o.cost_factor},
          {"time_limit", o.time_limit}, {"iteration_limit", unlimited ? 0 : o.iteration_limit},
          {"neighbors", row.neighbors}};
}

Json body_json(const PlanSuite& suite) {
  Json json = {{"kind", "plan"},           {"baseline", suite.baseline},
               {"runs", suite.runs},       {"seed", suite.seed},
               {"radius", suite.radius},   {"unknown", suite.unknown == UnknownIs::free ? "free" : "occupied"},
               {"threads", suite.threads}, {"reference", suite.reference}};
  for (const MapSource& source : suite.maps) json["maps"].push_back(to_json(source));
  for (const PlanRow& row : suite.rows) json["planners"].push_back(to_json(row));
  return json;
}

Json body_json(const PredictSuite& suite) {
  return {{"kind", "predict"},    {"models", suite.models},     {"sizes", suite.sizes}, {"threads", suite.threads},
          {"batch", suite.batch}, {"spinning", suite.spinning}, {"level", suite.level}, {"mazes", suite.mazes},
          {"runs", suite.runs},   {"seed", suite.seed}};
}

}  // namespace

Json to_json(const Suite& suite) {
  Json json;
  if (!suite.title.empty()) json["title"] = suite.title;
  json.update(std::visit([](const auto& body) { return body_json(body); }, suite.body));
  return json;
}

}  // namespace lrrt::bench
