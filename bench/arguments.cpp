// SPDX-License-Identifier: BSD-3-Clause
#include "arguments.hpp"

#include <CLI/CLI.hpp>
#include <sstream>

#include "lrrt/version.hpp"

namespace lrrt::bench {
namespace {

constexpr const char* description =
    "Measures what guidance gains on your maps, against what you would use instead.\n\n"
    "A suite is a YAML file: maps, queries on them, planners, how often to run. Suites of kind 'plan' run every "
    "planner\n"
    "on the same queries with the same seeds and compare them run by run with a baseline; suites of kind 'predict'\n"
    "measure how fast models predict.";

constexpr const char* footer =
    "Start here:\n"
    "  lrrt_bench --list                                 which suites ship\n"
    "  lrrt_bench --suite smoke                          seconds; does it work?\n"
    "  lrrt_bench --suite paper --json paper.json        the paper's comparison; Ctrl-C, and the same command goes on\n"
    "  lrrt_bench --suite my.yaml --runs 30 --csv my.csv your own suite: copy bench/suites/smoke.yaml and edit it\n"
    "  lrrt_bench --suite peers --maps my_maps/          the planners of a suite on your own maps\n"
    "  lrrt_bench --suite predict --models my.onnx       how fast your own models predict\n"
    "  lrrt_bench --replay paper.json                    runs it again: must give the same iterations and nodes\n\n"
    "What the report says:\n"
    "  first path    milliseconds from the call to the first path, prediction and all else included\n"
    "  search        the planner's share of it\n"
    "  length        of the last path, divided by the exact shortest path\n"
    "  clearance     mean distance from the last path of the reference point to the nearest obstacle (grown by the\n"
    "                radius), map units\n"
    "  gain          the baseline's number divided by the row's, run by run; above 1 the row is better\n"
    "  hard, easy    guided rows against unguided baselines: queries that cost the baseline more than 100 ms, and\n"
    "                others; a failure costs the time it took, and queries that neither solved are left out\n\n"
    "Exit codes: 0 done, 2 bad input, 3 a replay differs, 130 interrupted.";

/// An empty word is most often a variable of the shell that is not set: it must not read as an option left out.
const CLI::Validator& named() {
  static const CLI::Validator validator(
      [](std::string& text) {
        return std::string(text.empty() ? "is empty; is a variable of the shell not set?" : "");
      },
      "");
  return validator;
}

/// Whole numbers are decimal: without this, zeros at the front would make them octal.
const CLI::Validator& decimal() {
  static const CLI::Validator validator(
      [](std::string& text) {
        const std::size_t first = text.find_first_not_of('0');
        if (first != std::string::npos && text[first] >= '1' && text[first] <= '9') text.erase(0, first);
        return std::string();
      },
      "");
  return validator;
}

void read_seed(const std::string& text, Overrides& changes) {
  changes.seed = seed_from_string(text);
  if (!changes.seed) {
    throw CLI::ValidationError("--seed", "'" + text + "': expected a whole number from 0 to 2^64 - 1");
  }
}

void add_outputs(CLI::App& app, Request& request, CLI::Option* replay) {
  auto* problems =
      app.add_option(
             "--problems", request.problems,
             "Write the suite's maps and queries into a folder, for planners outside this program; runs nothing")
          ->check(named())
          ->type_name("FOLDER")
          ->excludes(replay);
  const auto add = [&](const char* name, std::string& file, const char* what) {
    app.add_option(name, file, what)->check(named())->type_name("FILE")->excludes(problems);
  };
  add("--json", request.json, "Write configuration and every run; makes the run resumable");
  add("--csv", request.csv, "Write one line for every run");
  add("--ompl-log", request.ompl_log, "Write a log for OMPL's ompl_benchmark_statistics.py and Planner Arena");
}

void add_options(CLI::App& app, Request& request, bool& list) {
  auto* suite = app.add_option("--suite", request.suite, "Suite to run: a name of --list, or a file")
                    ->check(named())
                    ->type_name("NAME|FILE.yaml");
  auto* replay = app.add_option("--replay", request.replay, "Run a result of --json again and compare; - reads a pipe")
                     ->check(named())
                     ->type_name("FILE");
  replay->excludes(suite);
  app.add_flag("--list", list, "Show the suites that ship");
  auto& changes = request.overrides;
  app.add_option("--runs", changes.runs, "Seeds a query, or predictions a setting")
      ->transform(decimal())
      ->check(CLI::Range(1, 1000000))
      ->type_name("N")
      ->excludes(replay);
  app.add_option_function<std::string>(
         "--seed", [&changes](const std::string& text) { read_seed(text, changes); },
         "Seed of the first run; the next run takes the next number")
      ->type_name("S")
      ->excludes(replay);
  app.add_option(
         "--maps", changes.maps,
         "Your own map files or folders in place of the suite's, with what it says of the maps that it is given")
      ->type_name("PATH...")
      ->excludes(replay);
  app.add_option("--models", changes.models,
                 "Your own model files or patterns (ONNX; TorchScript where built with libtorch) in place of the "
                 "suite's, for suites that predict")
      ->check(named())
      ->type_name("FILE...")
      ->excludes(replay);
  app.add_option("--time-limit", changes.time_limit, "Longest search")
      ->check(CLI::PositiveNumber)
      ->type_name("SECONDS")
      ->excludes(replay);
  app.add_option("--jobs", request.jobs, "Runs at a time; times are only sound with 1")
      ->transform(decimal())
      ->check(CLI::Range(1, 1024))
      ->type_name("N")
      ->capture_default_str();
  app.add_option("--shard", request.shard,
                 "Run part K of N only, so that machines can share a suite; 'lrrt sweep' does it for you")
      ->type_name("K/N")
      ->excludes(replay);
  add_outputs(app, request, replay);
  app.set_version_flag("--version", std::string("lrrt_bench ") + version);
}

/// What CLI11 has to say of the words: help, version, or what is wrong with them.
void answer(const CLI::App& app, const CLI::Error& error, Arguments& arguments) {
  std::ostringstream out;
  std::ostringstream err;
  arguments.exit = app.exit(error, out, err) == 0 ? Outcome::done : Outcome::failed;
  arguments.out = out.str();
  arguments.err = err.str();
}

}  // namespace

Arguments read_arguments(int argc, const char* const* argv) {
  CLI::App app(description, "lrrt_bench");
  app.footer(footer);
  app.get_formatter()->column_width(36);
  Arguments arguments;
  Request& request = arguments.request;
  add_options(app, request, arguments.list);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    answer(app, error, arguments);
    return arguments;
  }
  if (!arguments.list && request.suite.empty() && request.replay.empty()) {
    arguments.exit = Outcome::failed;
    arguments.out = app.help();
  }
  return arguments;
}

}  // namespace lrrt::bench
