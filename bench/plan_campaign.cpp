// SPDX-License-Identifier: BSD-3-Clause
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <utility>

#include "campaign.hpp"
#include "clearance.hpp"
#include "grid_search.hpp"
#include "hybrid_search.hpp"
#include "lrrt/planner.hpp"
#include "lrrt/predict/onnx_predictor.hpp"
#include "made_regions.hpp"
#include "models.hpp"
#include "portfolio.hpp"
#include "problems.hpp"
#include "reference.hpp"
#include "replanning.hpp"
#include "robot.hpp"

namespace lrrt::bench {
namespace {

/// The shortest path of a problem, computed when it is first asked for, once for all rows and seeds.
class Optimum {
 public:
  double of(const Problem& problem, const PlanSuite& suite) {
    std::call_once(once_, [&] {
      if (suite.reference) length_ = shortest_length(planning_map(problem, suite), problem.start, problem.goal);
    });
    return length_;
  }

 private:
  std::once_flag once_;
  double length_ = std::numeric_limits<double>::quiet_NaN();
};

/// Everything that one run needs.
struct PlanJob {
  std::shared_ptr<const Problem> problem;
  std::shared_ptr<Optimum> optimum;
  std::shared_ptr<const RegionPredictor> predictor;  ///< null for unguided rows
  std::shared_ptr<const PlanSuite> suite;
  PlanRow row;
  CancelToken cancel;
  bool limited_by_id = false;
};

/// Milliseconds from the call to the first path within a factor of the optimum; null when there was none.
Json time_within(const PlanResult& result, double target, double before_search) {
  for (const CostStep& step : result.cost_history) {
    if (step.cost <= target) return before_search + step.time;
  }
  return {};
}

Json times_json(const PlanResult& result) {
  const PlanTimings& t = result.timings;
  return {{"prepare", t.prepare}, {"encode", t.encode}, {"infer", t.infer},
          {"region", t.region},   {"plan", t.plan},     {"total", t.total}};
}

void add_path(Json& json, const PlanResult& result, const PlanJob& job, double optimum) {
  const PlanTimings& t = result.timings;
  const double before = t.prepare + t.encode + t.infer + t.region;
  const CostStep& first = result.cost_history.front();
  json["first_ms"] = before + first.time;
  json["search_ms"] = first.time;
  json["first_iteration"] = first.iteration;
  json["first_length"] = first.cost;
  json["length"] = result.cost;
  json["optimum"] = number_or_null(optimum);
  const Clearance clearance = clearance_of(planning_map(*job.problem, *job.suite), result.path);
  json["clearance"] = {{"least", clearance.least}, {"mean", clearance.mean}};
  for (const int percent : within_percents) {
    const double target = optimum * (1.0 + percent / 100.0);
    json["within_ms"][std::to_string(percent)] = time_within(result, target, before);
  }
  for (const CostStep& step : result.cost_history) json["history"].push_back({step.time, step.iteration, step.cost});
}

/// A place, with its heading where there are headings.
Json pose_json(const Eigen::Vector2d& place, double heading, const PlanSuite& suite) {
  Json json = {place.x(), place.y()};
  if (suite.has_headings()) json.push_back(heading);
  return json;
}

Json row_json(const PlanResult& result, const PlanJob& job, double optimum) {
  const Problem& p = *job.problem;
  const bool by_clock = job.limited_by_id || result.status == PlanStatus::time_limit ||
                        result.timings.plan >= 1e3 * job.row.options.time_limit;
  Json json = {{"group", p.group},
               {"map", p.map_name},
               {"query", p.query},
               {"start", pose_json(p.start, p.start_heading, *job.suite)},
               {"goal", pose_json(p.goal, p.goal_heading, *job.suite)},
               {"planner", job.row.name},
               {"seed", job.row.options.seed},
               {"status", to_string(result.status)},
               {"solved", result.solved()},
               {"iterations", result.iterations},
               {"nodes", result.nodes},
               {"motion_checks", result.motion_checks},
               {"reused", result.reused},
               {"ended_by_clock", by_clock},
               {"repeatable", job.row.options.planner != portfolio_name},
               {"times_ms", times_json(result)},
               {"draws", {{"guided", result.draws.guided}, {"uniform", result.draws.uniform}}}};
  if (result.region) {
    json["region"] = {{"area", result.region->area()}, {"bridge", result.region->bridge_area()}};
  }
  if (result.solved()) add_path(json, result, job, optimum);
  return json;
}

Json run_job(const PlanJob& job) {
  const Problem& p = *job.problem;
  const auto planned = [&] {
    const PlanRequest request = request_of(p, *job.suite, job.row, job.cancel);
    if (!job.row.after.empty()) return replanned(request, *job.suite, job.row, job.predictor, p.scale);
    const Planner planner(job.predictor, job.row.options);
    return planner.plan(request);
  };
  const auto answered = [&] {
    const std::string& name = job.row.options.planner;
    if (name == grid_search_name) return grid_search(p, *job.suite);
    if (name == hybrid_search_name) return hybrid_search(p, *job.suite, job.row, job.cancel);
    if (name == portfolio_name) return portfolio_search(p, *job.suite, job.row, job.cancel);
    return planned();
  };
  const PlanResult result = answered();
  // Afterwards: the search for the optimum must not warm the planner's caches.
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return row_json(result, job, result.solved() ? job.optimum->of(p, *job.suite) : nan);
}

/// A predictor that is shown maps of so many pixels a side, whatever it would see in full.
class InDetail final : public RegionPredictor {
 public:
  InDetail(std::shared_ptr<const RegionPredictor> inner, int detail) : inner_(std::move(inner)), detail_(detail) {}
  Prediction predict(const OccupancyMap& map, const Eigen::Vector2d& start,
                     const Eigen::Vector2d& goal) const override {
    return inner_->predict(map, start, goal);
  }
  int detail() const override { return detail_; }

 private:
  std::shared_ptr<const RegionPredictor> inner_;
  int detail_;
};

/// The models of a suite, each loaded and called once before anything is measured.
class Predictors {
 public:
  Predictors(const Suite& suite, Campaign& campaign) : suite_(suite), campaign_(campaign) {}

  /// Null for an unguided row.
  std::shared_ptr<const RegionPredictor> of(const PlanRow& row) {
    if (!row.guided()) return nullptr;
    std::shared_ptr<const RegionPredictor>& known = loaded_[row.model];
    if (!known) known = loaded(row.model);
    return row.detail == 0 ? known : std::make_shared<const InDetail>(known, row.detail);
  }

 private:
  std::shared_ptr<const RegionPredictor> loaded(const std::string& model) {
    if (std::shared_ptr<const RegionPredictor> made = made_region(model)) return made;
    const std::filesystem::path file = model_path(suite_, model);
    OnnxOptions options;
    options.threads = std::get<PlanSuite>(suite_.body).threads;
    auto predictor = std::make_shared<const OnnxPredictor>(file, options);
    const OccupancyMap empty(16, 16, std::vector<Cell>(256, Cell::free));
    predictor->predict(empty, {2.5, 2.5}, {13.5, 13.5});
    campaign_.onnxruntime = predictor->info().runtime_version;
    campaign_.inputs["models"][model] = file_checksum(file);
    return predictor;
  }

  const Suite& suite_;
  Campaign& campaign_;
  std::map<std::string, std::shared_ptr<const RegionPredictor>> loaded_;
};

/// One run of one row on one problem.
Job job_of(PlanJob job, int run, std::size_t pair, const IterationLimits& limits) {
  job.row.options.seed = job.suite->seed + static_cast<std::uint64_t>(run);
  const std::string id = job.problem->map_name + " | " + job.problem->query + " | " + job.row.name + " | " +
                         std::to_string(job.row.options.seed);
  const auto limit = limits.find(id);
  if (limit != limits.end() && job.row.options.planner != portfolio_name) {
    job.limited_by_id = true;
    job.row.options.iteration_limit = limit->second;
    job.row.options.time_limit = 1e9;
  }
  std::string label = job.problem->map_name + ", " + job.row.name;
  return {id, std::move(label), [job = std::move(job)] { return run_job(job); }, pair};
}

/// Every job is held in memory: a slip of the pen in the suite must not take all of it.
void check_jobs(std::size_t problems, const PlanSuite& suite) {
  constexpr std::size_t most = 4'000'000;
  const std::size_t per_problem = suite.rows.size() * static_cast<std::size_t>(suite.runs);
  if (problems <= most / per_problem) return;
  throw SuiteError("the suite asks for " + std::to_string(problems) + " queries × " + std::to_string(per_problem) +
                   " runs: expected at most " + std::to_string(most) + " in all; lower 'runs' or 'count'");
}

}  // namespace

Campaign plan_campaign(const Suite& suite, const CancelToken& cancel, const IterationLimits& limits) {
  const auto shared_suite = std::make_shared<const PlanSuite>(std::get<PlanSuite>(suite.body));
  const PlanSuite& body = *shared_suite;
  Campaign campaign;
  Predictors predictors(suite, campaign);
  std::vector<std::shared_ptr<const RegionPredictor>> by_row;
  for (const PlanRow& row : body.rows) by_row.push_back(predictors.of(row));
  std::size_t pair = 0;
  const std::vector<Problem> problems = make_problems(suite);
  check_jobs(problems.size(), body);
  for (const Problem& problem : problems) {
    const auto shared = std::make_shared<const Problem>(problem);
    const auto optimum = std::make_shared<Optimum>();
    Json& checksum = campaign.inputs["maps"][problem.map_name];
    if (checksum.is_null()) checksum = map_checksum(*problem.map);
    // Rows innermost: whatever else the machine does falls on all of them alike.
    for (int run = 0; run < body.runs; ++run, ++pair) {
      for (std::size_t i = 0; i < body.rows.size(); ++i) {
        campaign.jobs.push_back(
            job_of({shared, optimum, by_row[i], shared_suite, body.rows[i], cancel}, run, pair, limits));
      }
    }
  }
  return campaign;
}

}  // namespace lrrt::bench
