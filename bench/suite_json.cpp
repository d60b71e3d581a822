// SPDX-License-Identifier: BSD-3-Clause
#include <limits>

#include "suite.hpp"

namespace lrrt::bench {
namespace {

Json place(const Pose2& pose, bool headings) {
  return headings ? Json::array({pose.x, pose.y, pose.yaw}) : Json::array({pose.x, pose.y});
}

Json to_json(const QuerySource& query, bool headings) {
  switch (query.kind) {
    case QuerySource::Kind::farthest:
      break;
    case QuerySource::Kind::random: {
      Json json = {{"kind", "random"}, {"count", query.count}, {"seed", query.seed}};
      if (query.far > 0.0) {
        json["far"] = query.far;
      } else {
        json["apart"] = query.apart;
      }
      if (!query.drivable.empty()) json["drivable"] = query.drivable;
      return json;
    }
    case QuerySource::Kind::points:
      return {{"kind", "points"}, {"start", place(query.start, headings)}, {"goal", place(query.goal, headings)}};
    case QuerySource::Kind::scen: {
      Json json = {{"kind", "scen"}, {"count", query.count}};
      if (!query.path.empty()) json["path"] = query.path;
      return json;
    }
  }
  return {{"kind", "farthest"}};
}

Json settings_of(const MapSource& source) {
  switch (source.kind) {
    case MapSource::Kind::maze:
      return {
          {"kind", "maze"},        {"name", source.name},     {"level", source.level}, {"algorithm", source.algorithms},
          {"count", source.count}, {"pixels", source.pixels}, {"braid", source.braid}, {"seed", source.seed}};
    case MapSource::Kind::mosaic:
      return {{"kind", "mosaic"},    {"name", source.name},         {"path", source.path},   {"pixels", source.pixels},
              {"tile", source.tile}, {"corridor", source.corridor}, {"count", source.count}, {"seed", source.seed}};
    case MapSource::Kind::file:
    case MapSource::Kind::folder:
      break;
  }
  const bool file = source.kind == MapSource::Kind::file;
  return {{"kind", file ? "file" : "folder"}, {"name", source.name}, {"path", source.path}, {"pixels", source.pixels}};
}

Json to_json(const PlanRow& row) {
  const PlanOptions& o = row.options;
  const bool unlimited = o.iteration_limit == std::numeric_limits<std::size_t>::max();
  Json json = {{"name", row.name},
               {"planner", o.planner},
               {"strategy", row.strategy},
               {"alpha", o.alpha},
               {"model", row.model},
               {"detail", row.detail},
               {"range", o.range},
               {"goal_bias", o.goal_bias},
               {"goal_tolerance", o.goal_tolerance},
               {"stop", row.stop},
               {"cost_factor", o.cost_factor},
               {"time_limit", o.time_limit},
               {"iteration_limit", unlimited ? 0 : o.iteration_limit},
               {"neighbors", row.neighbors},
               {"motion", row.motion},
               {"turning_radius", row.turning_radius},
               {"simplify", o.simplify}};
  if (!row.baseline.empty()) json["baseline"] = row.baseline;
  if (!row.after.empty()) {
    json["after"] = row.after;
    json["session"] = row.session;
  }
  return json;
}

Json body_json(const PlanSuite& suite) {
  Json json = {{"kind", "plan"},           {"baseline", suite.baseline},
               {"runs", suite.runs},       {"seed", suite.seed},
               {"radius", suite.radius},   {"unknown", suite.unknown == UnknownIs::free ? "free" : "occupied"},
               {"threads", suite.threads}, {"reference", suite.reference},
               {"move", suite.move},       {"obstacle", suite.obstacle}};
  if (suite.outline) {
    for (const Eigen::Vector2d& corner : suite.outline->vertices()) json["outline"].push_back({corner.x(), corner.y()});
  }
  for (const MapSource& source : suite.maps) json["maps"].push_back(to_json(source, suite.has_headings()));
  for (const PlanRow& row : suite.rows) json["planners"].push_back(to_json(row));
  return json;
}

Json body_json(const PredictSuite& suite) {
  return {{"kind", "predict"},    {"models", suite.models},     {"sizes", suite.sizes}, {"threads", suite.threads},
          {"batch", suite.batch}, {"spinning", suite.spinning}, {"level", suite.level}, {"mazes", suite.mazes},
          {"runs", suite.runs},   {"seed", suite.seed}};
}

}  // namespace

Json to_json(const MapSource& source, bool headings) {
  Json json = settings_of(source);
  json["scale"] = source.scale;
  for (const QuerySource& query : source.queries) json["queries"].push_back(to_json(query, headings));
  return json;
}

Json to_json(const Suite& suite) {
  Json json;
  if (!suite.title.empty()) json["title"] = suite.title;
  json.update(std::visit([](const auto& body) { return body_json(body); }, suite.body));
  return json;
}

}  // namespace lrrt::bench
