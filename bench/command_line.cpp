// SPDX-License-Identifier: BSD-3-Clause
#include "command_line.hpp"

#include <algorithm>
#include <iostream>
#include <thread>

#include "campaign.hpp"
#include "machine.hpp"
#include "ompl_log.hpp"
#include "outputs.hpp"
#include "problem_export.hpp"
#include "replay.hpp"
#include "shard.hpp"
#include "suite_files.hpp"
#include "table.hpp"

namespace lrrt::bench {
namespace {

bool is_plan(const Suite& suite) {
  return std::holds_alternative<PlanSuite>(suite.body);
}

/// What makes times worth less; said before the run, so that it can be put off.
void warn(const Suite& suite, int jobs) {
  const auto say = [](const std::string& text) { std::cerr << "note: " << text << '\n'; };
  const double load = load_average();
  const unsigned cores = std::thread::hardware_concurrency();
  if (load > 0.5 * cores) {
    say("the machine is busy (load " + fixed_number(load, 1) + " on " + std::to_string(cores) +
        " cores): times will be long and unsteady; iterations and nodes are not touched");
  }
  if (std::string(LRRT_BENCH_BUILD) != "Release") {
    say("this is a build of type '" LRRT_BENCH_BUILD "': times say little; build with -DCMAKE_BUILD_TYPE=Release");
  }
  if (jobs > 1 && is_plan(suite)) say("--jobs above 1 shares caches and cores: compare iterations rather than times");
}

void say_notes(const Campaign& campaign) {
  for (const std::string& note : campaign.notes) std::cerr << "note: " << note << '\n';
}

/// The report first: the files may fail.
void deliver(const std::string& report, const Request& request, const Suite& suite, ResultFile& results,
             const Json& document) {
  std::cout << report << std::flush;
  results.finish(document);
  if (!request.csv.empty()) write_file(request.csv, is_plan(suite) ? plan_csv(document) : predict_csv(document));
  if (!request.ompl_log.empty()) write_file(request.ompl_log, ompl_log(document));
}

/// Whether the files asked for can be written, and none of them is `origin` or what the suite reads.
void check_files(const Request& request, const Suite& suite, const Input& origin) {
  if (!request.ompl_log.empty() && !is_plan(suite)) {
    throw SuiteError("--ompl-log: the suite predicts and plans nothing; expected a suite of kind 'plan'");
  }
  std::vector<Output> outputs;
  if (!request.json.empty()) outputs.push_back({"--json", request.json, true});
  if (!request.csv.empty()) outputs.push_back({"--csv", request.csv});
  if (!request.ompl_log.empty()) outputs.push_back({"--ompl-log", request.ompl_log});
  if (outputs.empty()) return;
  std::vector<Input> inputs{origin};
  for (const std::filesystem::path& file : files_of(suite)) inputs.push_back({"what the suite reads", file});
  check_outputs(outputs, inputs);
}

Outcome interrupted(const Request& request, const ResultFile& results, std::size_t jobs) {
  std::cerr << "interrupted after " << results.size() << " of " << jobs << " rows";
  if (request.json.empty()) {
    std::cerr << ", which are lost; with --json FILE they are kept and the same command goes on\n";
  } else {
    std::cerr << ", kept in " << request.json << ".part; give the same command to go on\n";
  }
  return Outcome::interrupted;
}

/// How a run is ended, and what is called when it begins.
struct Control {
  const CancelToken& cancel;
  const std::function<void()>& begins;
};

/// Runs what is missing; nothing when it was interrupted.
std::optional<Json> run(const Request& request, const Campaign& campaign, ResultFile& results, const Control& control,
                        int jobs) {
  if (results.size() > 0) std::cerr << "going on: " << results.size() << " rows are there already\n";
  if (control.begins) control.begins();
  if (!run_jobs(campaign.jobs, {jobs, true, control.cancel}, results)) {
    interrupted(request, results, campaign.jobs.size());
    return std::nullopt;
  }
  std::vector<std::string> ids;
  for (const Job& job : campaign.jobs) ids.push_back(job.id);
  return results.document(ids);
}

std::string heading(const Suite& suite, const Json& document) {
  const Json& versions = document.at("versions");
  std::string text = suite.title.empty() ? "" : suite.title + "\n";
  text += "lrrt " + versions.at("lrrt").get<std::string>() + ", OMPL " + versions.at("ompl").get<std::string>();
  if (versions.contains("onnxruntime")) text += ", ONNX Runtime " + versions.at("onnxruntime").get<std::string>();
  if (versions.contains("libtorch")) text += ", libtorch " + versions.at("libtorch").get<std::string>();
  const Json& machine = document.at("machine");
  return text + "; " + machine.at("processor").get<std::string>() + ", " +
         std::to_string(machine.at("cores").get<unsigned>()) + " cores\n\n";
}

Outcome run_suite(const Request& request, const Control& control) {
  const Shard shard = shard_from_string(request.shard);
  Suite suite = load_suite(request.suite);
  apply(request.overrides, suite);
  if (!request.problems.empty()) {
    std::cout << export_problems(suite, request.problems) << " queries in " << request.problems << "/problems.json\n";
    return Outcome::done;
  }
  check_files(request, suite, {"--suite", suite_file(request.suite)});
  const int jobs = is_plan(suite) ? request.jobs : 1;  // predictions side by side would measure each other
  warn(suite, jobs);
  Campaign campaign = is_plan(suite) ? plan_campaign(suite, control.cancel) : predict_campaign(suite, control.cancel);
  say_notes(campaign);
  Json header = header_of(suite, campaign);
  if (!shard.whole()) header["shard"] = {{"number", shard.number}, {"of", shard.of}};
  campaign.jobs = jobs_of(std::move(campaign.jobs), shard);
  ResultFile results(request.json, std::move(header));
  const std::optional<Json> document = run(request, campaign, results, control, jobs);
  if (!document) return Outcome::interrupted;
  const std::string report = is_plan(suite) ? plan_report(*document) : predict_report(*document);
  deliver(heading(suite, *document) + report, request, suite, results, *document);
  return Outcome::done;
}

Outcome run_replay(const Request& request, const Control& control) {
  const Json before = read_result(request.replay);
  const Suite suite = replayed_suite(before, request.replay);
  check_files(request, suite, {"--replay", request.replay == "-" ? "/dev/stdin" : request.replay});
  Campaign campaign = is_plan(suite) ? plan_campaign(suite, control.cancel, replay_limits(before))
                                     : predict_campaign(suite, control.cancel);
  say_notes(campaign);
  check_inputs(before, campaign.inputs, request.replay);
  keep_jobs_of(before, campaign.jobs);
  Json header = header_of(suite, campaign);
  header["replay_of"] = request.replay;
  ResultFile results(request.json, header);
  const std::optional<Json> document = run(request, campaign, results, control, is_plan(suite) ? request.jobs : 1);
  if (!document) return Outcome::interrupted;
  const Comparison comparison = compare_replay(before, *document);
  deliver(comparison.text, request, suite, results, *document);
  return comparison.same ? Outcome::done : Outcome::differs;
}

}  // namespace

std::string suite_list() {
  constexpr std::size_t width = 12;
  std::string text;
  for (const std::string& name : shipped_suites()) {
    const std::string padding(std::max(width, name.size() + 2) - name.size(), ' ');
    text += name + padding + load_suite(name).title + "\n";
  }
  return text;
}

Outcome execute(const Request& request, const CancelToken& cancel, const std::function<void()>& begins) {
  return request.replay.empty() ? run_suite(request, {cancel, begins}) : run_replay(request, {cancel, begins});
}

Outcome delivered(std::ostream& report, Outcome outcome) {
  if (report.flush()) return outcome;
  std::cerr << "error: standard output cannot be written: the report is lost\n";
  return Outcome::failed;
}

}  // namespace lrrt::bench
