// SPDX-License-Identifier: BSD-3-Clause
#include "judge.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <vector>

#include "support.hpp"

namespace lrrt::property {
namespace {

using Eigen::Vector2d;

/// The status that follows from the ends alone; anything with a search counts as solved here.
PlanStatus status_in_the_plane(const Query& query) {
  const Ground& ground = query.ground();
  const OccupancyMap& map = ground.grown();
  const Pixel start = OccupancyMap::pixel_of(ground.to_pixel(query.request().start));
  const Pixel goal = OccupancyMap::pixel_of(ground.to_pixel(query.request().goal));
  if (!map.contains(start)) return PlanStatus::start_outside;
  if (!map.contains(goal)) return PlanStatus::goal_outside;
  if (!map.is_free(start)) return PlanStatus::start_occupied;
  if (!map.is_free(goal)) return PlanStatus::goal_occupied;
  return test::flood(map, start)[map.index(goal)] != 0 ? PlanStatus::solved : PlanStatus::not_connected;
}

/// Whether a status comes from a search.
bool searched(PlanStatus status) {
  return status == PlanStatus::solved || status == PlanStatus::time_limit || status == PlanStatus::iteration_limit;
}

std::string judge_status(const Query& query, PlanStatus status) {
  const Ground& ground = query.ground();
  if (ground.on_a_border(ground.to_pixel(query.request().start)) ||
      ground.on_a_border(ground.to_pixel(query.request().goal))) {
    return {};  // rounding decides
  }
  const PlanStatus expected = status_in_the_plane(query);
  if (query.request().motion != Motion::plane) {
    const bool outside = expected == PlanStatus::start_outside || expected == PlanStatus::goal_outside;
    if (!outside) return judge_pose_status(query, status);
  }
  if (expected == PlanStatus::solved ? searched(status) : status == expected) return {};
  return std::string("status ") + to_string(status) + " where " + to_string(expected) + " is true";
}

std::string judge_history(const PlanResult& result) {
  if (result.cost_history.empty()) return "no cost history";
  for (std::size_t i = 1; i < result.cost_history.size(); ++i) {
    if (!(result.cost_history[i].cost < result.cost_history[i - 1].cost)) return "a cost history that does not fall";
  }
  if (std::abs(result.cost_history.back().cost - result.cost) > 1e-9 * (1.0 + result.cost)) {
    return "a cost that is not the last of its history";
  }
  return {};
}

std::string judge_ends(const Query& query, const PlanResult& result) {
  const PlanRequest& request = query.request();
  const double tolerance = query.options().goal_tolerance;
  if (result.path.size() < 2) return "a path of less than two points";
  if (result.path.front() != request.start) return "a path that begins elsewhere";
  if (tolerance == 0.0 && result.path.back() != request.goal) return "a path that ends elsewhere";
  if ((result.path.back() - request.goal).norm() > tolerance * (1.0 + 1e-9)) {
    return "a path that ends farther from the goal than allowed";
  }
  const bool headings = request.motion != Motion::plane;
  if (result.headings.size() != (headings ? result.path.size() : 0)) return "headings that do not fit the path";
  return {};
}

std::string judge_region(const Query& query, const PlanResult& result) {
  if (query.options().strategy == Strategy::uniform) {
    return result.region || result.draws.guided > 0 ? "a region in an unguided search" : "";
  }
  if (!result.region) return {};  // hopeless, or done at once
  if (!result.region->connected()) return "a region that does not join start and goal";
  const std::vector<std::uint8_t>& mask = result.region->mask();
  for (std::size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] != 0 && query.ground().grown().cells()[i] != Cell::free) return "a region on pixels that are not free";
  }
  return {};
}

/// Every edge of a tree in the plane was checked; PRM and its like keep edges that they did not check yet.
std::string judge_tree(const Query& query, const PlanResult& result) {
  const std::string& planner = query.options().planner;
  const bool checked = planner == "RRT" || planner == "RRTConnect" || planner == "RRTstar";
  if (query.request().motion != Motion::plane || !checked) return {};
  const Ground& ground = query.ground();
  for (const TreeEdge& edge : result.tree) {
    if (test::crosses_blocked(ground.grown(), ground.to_pixel(edge.from), ground.to_pixel(edge.to))) {
      return "an edge of the tree that is not free";
    }
  }
  return {};
}

}  // namespace

std::string judge(const Query& query, const PlanResult& result) {
  for (const std::string& complaint :
       {judge_status(query, result.status), judge_region(query, result), judge_tree(query, result)}) {
    if (!complaint.empty()) return complaint;
  }
  if (!result.solved()) {
    const bool empty = result.path.empty() && result.headings.empty() && std::isinf(result.cost);
    return empty ? "" : "a path without a solution";
  }
  for (const std::string& complaint : {judge_ends(query, result), judge_history(result)}) {
    if (!complaint.empty()) return complaint;
  }
  return query.request().motion == Motion::plane ? judge_path(query, result) : judge_poses(query, result);
}

std::string compare(const PlanResult& one, const PlanResult& other) {
  const auto same_edge = [](const TreeEdge& a, const TreeEdge& b) { return a.from == b.from && a.to == b.to; };
  if (one.status != other.status) return "another status";
  if (one.path != other.path || one.headings != other.headings) return "another path";
  if (one.cost != other.cost) return "another cost";
  if (one.iterations != other.iterations || one.nodes != other.nodes) return "other counts";
  if (one.motion_checks != other.motion_checks) return "another number of motion checks";
  if (one.draws.guided != other.draws.guided || one.draws.uniform != other.draws.uniform) return "other draws";
  if (!std::equal(one.tree.begin(), one.tree.end(), other.tree.begin(), other.tree.end(), same_edge)) {
    return "another tree";
  }
  return {};
}

}  // namespace lrrt::property
