// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/session.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "check_request.hpp"
#include "lrrt/error.hpp"
#include "lrrt/ompl/map_projection.hpp"
#include "lrrt/stopwatch.hpp"
#include "map_changes.hpp"
#include "neighbourhood.hpp"
#include "predict/number_of_query.hpp"
#include "steps.hpp"
#include "trail.hpp"

namespace lrrt {
namespace {

/// Longest pieces, in pixels, into which straight lines of a path are cut: what a piece crosses is looked at as a box.
constexpr double piece_pixels = 8.0;
/// How far along a path, in pixels, a way back to it or around something begins and ends beyond what it has to.
constexpr double least_margin = 10.0;
/// A part of the map in which no way was found is made larger by this factor, so often.
constexpr double larger = 3.0;
constexpr int tries = 3;

/// A stretch of the trail that has to be planned anew.
struct Gap {
  Pose2 from;
  std::size_t begin;  ///< the last pose of the trail that is kept before it, or the one nearest to where the robot is
  std::size_t end;    ///< the first pose of the trail that is kept after it
};

}  // namespace

/// What a session knows.
class Session::Memory {
 public:
  Memory(Planner planner, const PlanRequest& robot)
      : planner_(std::move(planner)),
        map_(robot.map.get()),
        robot_(robot),
        reach_(std::max(map_.resolution(), reach_of(robot))) {
    robot_.map = map_;
    robot_.start = robot_.goal = map_.center({0, 0});
    check(robot_, planner_.options());
  }
  Memory(const Memory&) = delete;
  Memory& operator=(const Memory&) = delete;

  const OccupancyMap& map() const { return map_; }

  std::vector<PlanResult> plan(const std::vector<Query>& queries, const CancelToken& cancel) {
    std::vector<Task> tasks;
    tasks.reserve(queries.size());
    for (std::size_t i = 0; i < queries.size(); ++i) {
      tasks.push_back({request_for(queries[i], cancel), std::nullopt, {}});
      const auto check_it = [&] { check(tasks.back().request, planner_.options()); };
      queries.size() > 1 ? naming_query(i, check_it) : check_it();
    }
    if (!tasks.empty()) last_ = queries.back();
    for (Task& task : tasks) prepare(task);
    predict(tasks);
    std::vector<PlanResult> results;
    results.reserve(tasks.size());
    for (Task& task : tasks) {
      if (task.prepared) search(*task.prepared, task.request, planner_.options(), task.result);
      const PlanTimings& t = task.result.timings;
      task.result.timings.total = t.prepare + t.encode + t.infer + t.region + t.plan;
      results.push_back(std::move(task.result));
    }
    if (!results.empty()) keep(trail_of(results.back()));
    return results;
  }

  PlanResult plan(const Query& query, const CancelToken& cancel) {
    return plan(std::vector<Query>{query}, cancel).front();
  }

  PlanResult replan(const Pose2& start, const CancelToken& cancel) {
    if (!last_) throw RequestError("replan() goes on to the goal of an earlier query: call plan() first");
    Query query = *last_;
    query.start = {start.x, start.y};
    query.start_heading = start.yaw;
    const PlanRequest request = request_for(query, cancel);
    check(request, planner_.options());
    const Stopwatch watch;
    PlanResult result;
    if (std::optional<Trail> mended = mend(pose(query.start, query.start_heading), cancel, result)) {
      last_ = query;
      result.status = PlanStatus::solved;
      mended->tell(robot_.motion, result);
      result.goal_distance = (result.path.back() - query.goal).norm();
      result.goal_turn = result.headings.empty() ? 0.0 : angle_between(result.headings.back(), query.goal_heading);
      result.timings.total = result.timings.plan = watch.total_ms();
      result.cost_history = {{result.timings.plan, result.iterations, result.cost}};
      keep(std::move(*mended));
      return result;
    }
    const double before = watch.total_ms();
    if (given_up(request, result)) return result;
    result = plan(query, cancel);
    result.timings.prepare += before;
    result.timings.total += before;
    return result;
  }

  void update(const OccupancyMap& part) {
    MapChanges changes = changes_between(map_, part);
    if (changes.boxes.empty()) return;
    map_ = std::move(changes.map);
    space_.reset();
    changed_.insert(changed_.end(), changes.boxes.begin(), changes.boxes.end());
  }

 private:
  /// A query on its way.
  struct Task {
    PlanRequest request;
    std::optional<Prepared> prepared;  ///< nothing when no search is needed
    PlanResult result;
  };

  void prepare(Task& task) {
    if (given_up(task.request, task.result)) return;
    if (!space_) space_.emplace(make_free_space(task.request, planner_.predictor().get(), task.result));
    task.prepared = look(*space_, task.request, planner_.options(), task.result);
  }

  /// Queries that are guided in pixels of one size are predicted together.
  void predict(std::vector<Task>& tasks) const {
    if (!planner_.predictor()) return;
    std::map<const OccupancyMap*, std::vector<Task*>> together;
    for (Task& task : tasks) {
      if (task.prepared) together[task.prepared->guidance.get()].push_back(&task);
    }
    for (const auto& group : together) {
      if (group.second.front()->request.cancel.cancelled()) return;  // search() says so of each
      const std::string failure = failure_of(planner_.options(), [&] { predict(*group.first, group.second); });
      for (Task* task : group.second) {
        task->result.predict_error = failure;
        if (!failure.empty()) task->result.region = nullptr;
      }
    }
  }

  void predict(const OccupancyMap& map, const std::vector<Task*>& tasks) const {
    std::vector<RegionQuery> queries;
    queries.reserve(tasks.size());
    for (const Task* task : tasks) queries.push_back({task->request.start, task->request.goal});
    std::vector<Prediction> predictions = planner_.predictor()->predict_many(map, queries);
    for (std::size_t i = 0; i < tasks.size(); ++i) {
      take_region(std::move(predictions[i]), *tasks[i]->prepared, tasks[i]->request, tasks[i]->result);
    }
  }

  PlanRequest request_for(const Query& query, const CancelToken& cancel) const {
    PlanRequest request = robot_;
    request.start = query.start;
    request.goal = query.goal;
    request.start_heading = query.start_heading;
    request.goal_heading = query.goal_heading;
    request.cancel = cancel;
    return request;
  }

  Trail trail_of(const PlanResult& result) const {
    return {result, robot_.motion, reach_, piece_pixels * map_.resolution()};
  }

  void keep(Trail trail) {
    trail_ = std::move(trail);
    changed_.clear();
  }

  /// How far along the trail gaps begin and end beyond what they have to, map units.
  double margin() const {
    return std::max({least_margin * map_.resolution(), 2.0 * reach_, 2.0 * robot_.turning_radius});
  }

  /// The trail from a pose on, mended where it is not free any more; nothing when that cannot be done near by.
  std::optional<Trail> mend(const Pose2& start, const CancelToken& cancel, PlanResult& result) {
    // What a driven robot does, and what clearance costs, is not told by the poses of a path alone.
    if (trail_.empty() || is_driven(robot_.motion) || planner_.options().clearance > 0.0) return std::nullopt;
    const std::size_t nearest = trail_.nearest(start, reach_);
    Trail mended;
    std::size_t done = nearest;  // the trail is dealt with up to here
    double kept = 0.0;
    const auto keep_until = [&](std::size_t end) {
      mended.append(trail_, done, end);
      kept += trail_.cost_to(end) - trail_.cost_to(done);
    };
    for (const Gap& gap : gaps(start, nearest)) {
      if (gap.begin > done) keep_until(gap.begin);
      const std::optional<PlanResult> way = way_across(gap, cancel);
      if (!way) return std::nullopt;
      result.iterations += way->iterations;
      result.nodes += way->nodes;
      result.motion_checks += way->motion_checks;
      const Trail piece = trail_of(*way);
      mended.append(piece, 0, piece.size() - 1);
      done = gap.end;
    }
    if (mended.empty() || done + 1 < trail_.size()) keep_until(trail_.size() - 1);
    result.reused = mended.cost() > 0.0 ? kept / mended.cost() : 1.0;
    return mended;
  }

  /// What has to be planned anew: the way from the robot to the trail, and around what blocks it.
  std::vector<Gap> gaps(const Pose2& start, std::size_t nearest) {
    std::vector<Gap> result;
    const Pose2& near = trail_.pose(nearest);
    const double off = std::hypot(near.x - start.x, near.y - start.y);
    const bool on_trail = off == 0.0 && near.yaw == start.yaw;
    if (!on_trail) result.push_back({start, nearest, after(nearest, margin() + off)});
    for (const std::size_t i : blocked_pieces(nearest)) {
      const std::size_t begin = trail_.at_cost(trail_.cost_to(i) - margin());
      const std::size_t end = after(i + 1, margin());
      if (!result.empty() && begin <= result.back().end) {
        result.back().end = std::max(result.back().end, end);
      } else if (begin <= nearest) {
        result.push_back({start, nearest, end});
      } else {
        result.push_back({trail_.pose(begin), begin, end});
      }
    }
    return result;
  }

  std::size_t after(std::size_t i, double cost) const { return trail_.at_cost(trail_.cost_to(i) + cost); }

  /// The pixels between two poses; of a piece of the trail those that it crosses.
  PixelBox box_of(const Pose2& a, const Pose2& b) const {
    const Eigen::Vector2d p = map_.to_pixel({a.x, a.y});
    const Eigen::Vector2d q = map_.to_pixel({b.x, b.y});
    const Pixel low = OccupancyMap::pixel_of(p.cwiseMin(q));
    const Pixel high = OccupancyMap::pixel_of(p.cwiseMax(q));
    return {low.c, low.r, high.c - low.c + 1, high.r - low.r + 1};
  }
  PixelBox box_of(std::size_t piece) const { return box_of(trail_.pose(piece), trail_.pose(piece + 1)); }

  /// Pieces i to i + 1 from a pose of the trail on that are not free any more, in their order.
  std::vector<std::size_t> blocked_pieces(std::size_t first) {
    std::vector<std::size_t> blocked;
    for (std::size_t i = first; !changed_.empty() && i + 1 < trail_.size(); ++i) {
      std::vector<std::size_t> run;  // pieces in a row that a change may have touched
      PixelBox box;
      for (; i + 1 < trail_.size() && near_change(i); ++i) {
        box = run.empty() ? box_of(i) : united(box, box_of(i));
        run.push_back(i);
      }
      if (run.empty()) continue;
      Neighbourhood around(robot_, box);
      std::copy_if(run.begin(), run.end(), std::back_inserter(blocked),
                   [&](std::size_t k) { return !around.is_free(trail_.pose(k), trail_.pose(k + 1)); });
    }
    return blocked;
  }

  bool near_change(std::size_t piece) const {
    const PixelBox box = widened(box_of(piece), reach_ / map_.resolution() + 1.0);
    return std::any_of(changed_.begin(), changed_.end(), [&](const PixelBox& c) { return overlap(box, c); });
  }

  std::optional<PlanResult> way_across(const Gap& gap, const CancelToken& cancel) {
    const Pose2& to = trail_.pose(gap.end);
    PixelBox box = box_of(gap.from, to);
    for (std::size_t i = gap.begin; i < gap.end; ++i) box = united(box, box_of(i));
    double room = margin() / map_.resolution();
    for (int i = 0; i < tries && !cancel.cancelled(); ++i, room *= larger) {
      Neighbourhood around(robot_, widened(box, room));
      if (auto way = around.plan(gap.from, to, planner_.options(), cancel)) return way;
    }
    return std::nullopt;
  }

  Planner planner_;
  OccupancyMap map_;
  PlanRequest robot_;  ///< on that map
  double reach_;       ///< of its farthest point, at least a pixel; map units
  std::optional<FreeSpace> space_;
  std::optional<Query> last_;
  Trail trail_;                    ///< of the last result; empty when there was no path
  std::vector<PixelBox> changed_;  ///< since that trail was free
};

Session::Session(Planner planner, const PlanRequest& robot)
    : memory_(std::make_unique<Memory>(std::move(planner), robot)) {}
Session::~Session() = default;
Session::Session(Session&&) noexcept = default;
Session& Session::operator=(Session&&) noexcept = default;

const OccupancyMap& Session::map() const {
  return memory_->map();
}

PlanResult Session::plan(const Query& query, const CancelToken& cancel) {
  return memory_->plan(query, cancel);
}

std::vector<PlanResult> Session::plan(const std::vector<Query>& queries, const CancelToken& cancel) {
  return memory_->plan(queries, cancel);
}

PlanResult Session::replan(const Eigen::Vector2d& start, double heading, const CancelToken& cancel) {
  return memory_->replan({start.x(), start.y(), heading}, cancel);
}

void Session::update(const OccupancyMap& part) {
  memory_->update(part);
}

}  // namespace lrrt
