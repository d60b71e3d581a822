// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <iostream>
#include <regex>
#include <sstream>
#include <string>

#include "campaign.hpp"
#include "clearance.hpp"
#include "lrrt/io/read_map.hpp"
#include "lrrt/sampling/random.hpp"
#include "ompl_log.hpp"
#include "outputs.hpp"
#include "problem_export.hpp"
#include "problems.hpp"
#include "replay.hpp"
#include "result_file.hpp"
#include "runner.hpp"
#include "shard.hpp"

namespace lrrt::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* unguided = R"(
kind: plan
title: two words
maps:
  - {kind: maze, level: 7, pixels: 64, count: 2}
queries:
  - {kind: farthest}
planners:
  - {name: RRT*, planner: RRTstar, strategy: uniform}
  - {name: RRT-Connect, planner: RRTConnect, strategy: uniform}
runs: 3
)";

/// A folder of its own for every test.
class Results : public testing::Test {
 protected:
  void SetUp() override {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fs::temp_directory_path() / ("lrrt_bench_" + test + "_" + std::to_string(getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  fs::path file() const { return folder_ / "result.json"; }
  fs::path part() const { return folder_ / "result.json.part"; }

  static Json document_of(const Suite& suite, const IterationLimits& limits = {}) {
    return document_of(suite, plan_campaign(suite, {}, limits));
  }
  static Json predictions_of(const Suite& suite) { return document_of(suite, predict_campaign(suite, {})); }

 private:
  static Json document_of(const Suite& suite, const Campaign& campaign) {
    ResultFile results({}, header_of(suite, campaign));
    run_jobs(campaign.jobs, {2, false, {}}, results);
    std::vector<std::string> ids;
    for (const Job& job : campaign.jobs) ids.push_back(job.id);
    return results.document(ids);
  }

  fs::path folder_;
};

std::vector<Job> counting_jobs(int count, std::atomic<int>& runs, const std::function<void(int)>& before = nullptr) {
  std::vector<Job> jobs;
  for (int i = 0; i < count; ++i) {
    jobs.push_back({"job " + std::to_string(i), "", [&runs, before, i] {
                      if (before) before(i);
                      ++runs;
                      return Json{{"value", i}, {"iterations", 0}, {"nodes", 0}};
                    }});
  }
  return jobs;
}

TEST_F(Results, AnInterruptedRunGoesOnWhereItStopped) {
  std::atomic<int> runs{0};
  CancelToken cancel;
  {
    ResultFile results(file(), {{"suite", 1}, {"started", "then"}});
    const auto jobs = counting_jobs(10, runs, [&](int i) {
      if (i == 4) cancel.cancel();
    });
    EXPECT_FALSE(run_jobs(jobs, {1, false, cancel}, results));
  }
  EXPECT_TRUE(fs::exists(part()));
  EXPECT_FALSE(fs::exists(file()));
  std::ofstream(part(), std::ios::app) << "{\"id\": \"job 9\", \"val";  // killed while it wrote

  runs = 0;
  ResultFile results(file(), {{"suite", 1}, {"started", "now"}});
  EXPECT_EQ(results.size(), 4U);
  EXPECT_TRUE(run_jobs(counting_jobs(10, runs), {3, false, {}}, results));
  EXPECT_EQ(runs, 6);
  results.finish(results.document({"job 0", "job 9"}));
  EXPECT_FALSE(fs::exists(part()));
  const Json document = read_result(file());
  EXPECT_EQ(document.at("started"), "then");
  EXPECT_EQ(document.at("rows").at(1).at("value"), 9);
}

TEST_F(Results, AnotherRunsPartIsRefused) {
  { const ResultFile results(file(), {{"suite", 1}}); }
  EXPECT_THROW(ResultFile(file(), {{"suite", 2}}), ResultError);
  EXPECT_THROW(ResultFile("/nowhere/at/all.json", {{"suite", 2}}), ResultError);
}

TEST_F(Results, WhatIsNoResultIsRefused) {
  const Json good = {{"format", "lrrt_bench 1"},
                     {"suite", {{"kind", "predict"}}},
                     {"folder", "."},
                     {"inputs", {{"models", {{"default", "0"}}}}},
                     {"rows", {{{"id", "a"}, {"iterations", 1}, {"nodes", 1}}, {{"id", "b"}, {"area", 7}}}}};
  write_file(file(), good.dump());
  EXPECT_EQ(read_result(file()), good);
  std::vector<Json> bad = {Json(), Json::array(), Json::object()};
  const auto with = [&](const char* place, const Json& value) {
    Json changed = good;
    changed[Json::json_pointer(place)] = value;
    bad.push_back(changed);
  };
  with("/format", "lrrt_bench 0");
  with("/folder", 5);
  with("/inputs", "none");
  with("/inputs/models", "none");
  with("/rows", "none");
  for (const Json& row : {Json(), Json(5), Json{{"id", 5}}, Json{{"id", "a"}}, Json{{"id", "a"}, {"area", -1}},
                          Json{{"id", "a"}, {"iterations", 1}}, Json{{"id", "a"}, {"iterations", 1.5}, {"nodes", 1}},
                          Json{{"id", "a"}, {"iterations", 1}, {"nodes", 18446744073709551615ULL}},
                          Json{{"id", "a"}, {"area", 1}, {"ended_by_clock", 1}},
                          Json{{"id", "a"}, {"area", 1}, {"repeatable", Json::array()}}}) {
    with("/rows/0", row);
  }
  for (const Json& document : bad) {
    write_file(file(), document.dump());
    EXPECT_THROW(read_result(file()), ResultError) << document;
  }
  const std::string suite = good.at("suite").dump();
  std::string nested = good.dump();
  nested.replace(nested.find(suite), suite.size(), std::string(100000, '[') + std::string(100000, ']'));
  write_file(file(), nested);
  EXPECT_THROW(read_result(file()), ResultError);
  fs::remove(file());
  ASSERT_EQ(mkfifo(file().c_str(), 0600), 0);
  EXPECT_THROW(read_result(file()), ResultError);
}

TEST_F(Results, ABrokenRowOfAPartIsMadeAgain) {
  { const ResultFile results(file(), {{"suite", 1}}); }
  std::ofstream(part(), std::ios::app) << "{\"id\": 5}\n[]\n{\"id\": \"b\"}\n{\"id\": \"a\", \"area\": 1}\n"
                                       << std::string(100000, '[') << '\n';
  const ResultFile results(file(), {{"suite", 1}});
  EXPECT_EQ(results.size(), 1U);
  EXPECT_TRUE(results.has("a"));
}

TEST_F(Results, ARowOfAPartThatNoReportCouldReadIsMadeAgain) {
  const std::string predictions =
      "{kind: predict, models: models/sizes.onnx, sizes: 16, threads: 1, batch: 1, level: 5, runs: 2}";
  for (const Json& document :
       {document_of(parse_suite(unguided, "my.yaml", ".")),
        predictions_of(parse_suite(predictions, "my.yaml", LRRT_BENCH_SUITES "/../../tests/data"))}) {
    Json header = document;
    header.erase("format");
    header.erase("rows");
    const auto kept = [&](const Json& row) {
      std::ofstream(part()) << header.dump() << '\n' << row.dump() << '\n';
      return ResultFile(file(), header).size();
    };
    for (const Json& row : document.at("rows")) EXPECT_EQ(kept(row), 1U) << row;
    const bool plans = document.at("suite").at("kind") == "plan";
    const Json row = document.at("rows").at(0);
    Json one = document;
    one["rows"] = {row};
    for (const auto& [key, value] : row.items()) {
      for (const Json& damage : {Json("yes"), Json(-1.5), Json::array(), Json::object(), Json({{0}})}) {
        Json broken = one;
        broken["rows"][0][key] = damage;
        if (kept(broken.at("rows").at(0)) == 0U) continue;
        EXPECT_NO_THROW(plans ? plan_report(broken) + plan_csv(broken) + ompl_log(broken)
                              : predict_report(broken) + predict_csv(broken))
            << key << ' ' << damage;
      }
      Json without = one;
      without["rows"][0].erase(key);
      if (kept(without.at("rows").at(0)) == 0U) continue;
      EXPECT_NO_THROW(plans ? plan_report(without) + plan_csv(without) + ompl_log(without)
                            : predict_report(without) + predict_csv(without))
          << key;
    }
    if (!plans) continue;
    for (const char* key : {"group", "planner", "solved", "times_ms"}) {
      Json broken = row;
      broken.erase(key);
      EXPECT_EQ(kept(broken), 0U) << key;
    }
  }
}

TEST_F(Results, AResultIsReadFromAStream) {
  const Json document = document_of(parse_suite(unguided, "my.yaml", "."));
  std::stringstream pipe;
  pipe << document.dump();
  EXPECT_EQ(read_result(pipe, "standard input"), document);
  std::istringstream empty;
  EXPECT_THROW(read_result(empty, "standard input"), ResultError);
  std::istringstream given(document.dump());
  std::streambuf* const before = std::cin.rdbuf(given.rdbuf());
  EXPECT_EQ(read_result("-"), document);
  given.seekg(0);
  std::cin.clear();
  EXPECT_EQ(read_result("/dev/stdin"), document);
  std::cin.rdbuf(before);
  std::cin.clear();
}

TEST_F(Results, AJobsErrorComesThroughAndKeepsTheRest) {
  std::atomic<int> runs{0};
  ResultFile results(file(), {{"suite", 1}});
  const auto jobs = counting_jobs(5, runs, [](int i) {
    if (i == 2) throw MapError("broken");
  });
  EXPECT_THROW(run_jobs(jobs, {1, false, {}}, results), MapError);
  EXPECT_EQ(results.size(), 2U);
}

TEST_F(Results, AReplayIsTheSameAndNoticesWhatIsNot) {
  const Suite suite = parse_suite(unguided, "my.yaml", ".");
  const Json before = document_of(suite);
  const Suite again = replayed_suite(before, "result.json");
  Json after = document_of(again, replay_limits(before));
  EXPECT_TRUE(compare_replay(before, after).same) << compare_replay(before, after).text;
  after["rows"][0]["nodes"] = 1;
  EXPECT_FALSE(compare_replay(before, after).same);
  Json changed = before.at("inputs");
  changed["maps"].begin().value() = "0";
  EXPECT_THROW(check_inputs(before, changed, "result.json"), ResultError);
}

TEST_F(Results, ARunThatTheClockEndedIsReplayedByItsIterations) {
  Suite suite = parse_suite(unguided, "my.yaml", ".");
  auto& body = std::get<PlanSuite>(suite.body);
  body.rows.resize(1);
  body.rows[0].stop = "limit";
  body.rows[0].options.stop = Stop::limit;
  body.rows[0].options.time_limit = 0.05;
  body.runs = 1;
  const Json before = document_of(suite);
  EXPECT_EQ(replay_limits(before).size(), before.at("rows").size());
  const Json after = document_of(replayed_suite(before, "result.json"), replay_limits(before));
  EXPECT_TRUE(compare_replay(before, after).same) << compare_replay(before, after).text;
}

TEST_F(Results, PredictionsHoldWhatIsMeasuredAndAreReplayed) {
  const std::string text =
      "{kind: predict, models: models/sizes.onnx, sizes: [16, 64], threads: 1, batch: [1, 3], level: 5, runs: 4}";
  const Suite suite = parse_suite(text, "my.yaml", LRRT_BENCH_SUITES "/../../tests/data");
  const Json before = predictions_of(suite);
  ASSERT_EQ(before.at("rows").size(), 4U);
  for (const Json& row : before.at("rows")) {
    const bool single = row.at("batch") == 1;
    EXPECT_EQ(row.at("times").size(), single ? 4U : 6U);  // calls are whole
    EXPECT_EQ(row.at("id").get<std::string>().find(" batch=3") == std::string::npos, single);
    EXPECT_EQ(row.at("input_size"), 32);
    for (const Json& side : row.at("input_sides")) EXPECT_TRUE(side == 8 || side == 16 || side == 32);
    EXPECT_EQ(row.at("input_sides"), before.at("rows").at(row.at("size") == 16 ? 0 : 1).at("input_sides"));
    for (const Json& time : row.at("times")) EXPECT_GE(time.at(3), time.at(1));  // all of a call, and its network
  }
  EXPECT_NE(predict_report(before).find("batch"), std::string::npos);
  const std::string csv = predict_csv(before);
  EXPECT_EQ(csv.find("model,name,input_size,input_sides,size,threads,spinning,batch,predictions,"), 0U);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 4);
  const Json after = predictions_of(replayed_suite(before, "result.json"));
  EXPECT_TRUE(compare_replay(before, after).same) << compare_replay(before, after).text;
}

TEST_F(Results, RowsHoldWhatIsMeasured) {
  const Json document = document_of(parse_suite(unguided, "my.yaml", "."));
  for (const Json& row : document.at("rows")) {
    EXPECT_EQ(row.at("status"), "solved");
    EXPECT_GE(row.at("length").get<double>(), row.at("optimum").get<double>() - 1e-6);
    EXPECT_GE(row.at("first_ms").get<double>(), row.at("search_ms").get<double>());
    EXPECT_LE(row.at("search_ms").get<double>(), row.at("times_ms").at("plan").get<double>());
  }
  const std::string csv = plan_csv(document);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 12);
  EXPECT_NE(plan_report(document).find("gain over RRT*"), std::string::npos);
}

/// Reads a log as OMPL's script does: line by line, counts first.
class LogReader {
 public:
  explicit LogReader(const std::string& text) : text_(text) {}

  std::string line() {
    std::string result;
    EXPECT_TRUE(std::getline(text_, result));
    return result;
  }
  void expect(const std::string& pattern) {
    const std::string found = line();
    EXPECT_TRUE(std::regex_match(found, std::regex(pattern))) << found << " is no " << pattern;
  }
  /// A line "N word …".
  int count(const std::string& words) {
    const std::string found = line();
    EXPECT_TRUE(std::regex_match(found, std::regex("\\d+ " + words))) << found;
    return std::stoi(found);
  }
  void block() {
    EXPECT_EQ(line(), "<<<|");
    while (line() != "|>>>") {
    }
  }
  bool at_end() { return text_.peek() == std::istringstream::traits_type::eof(); }

 private:
  std::istringstream text_;
};

void read_planner(LogReader& log, int expected_runs) {
  log.line();  // name
  const int settings = log.count("common properties");
  for (int i = 0; i < settings; ++i) log.expect("\\w+ = .*");
  const int properties = log.count("properties for each run");
  for (int i = 0; i < properties; ++i) log.expect("[a-z ]+ (BOOLEAN|ENUM|INTEGER|REAL)");
  EXPECT_EQ(log.count("runs"), expected_runs);
  const std::string value = "(-?[0-9.]+(e[+-]?\\d+)?)?";
  for (int i = 0; i < expected_runs; ++i) log.expect("(" + value + "; ){" + std::to_string(properties) + "}");
  const int progress = log.count("progress properties for each run");
  for (int i = 0; i < progress; ++i) log.expect("[a-z ]+ (INTEGER|REAL)");
  EXPECT_EQ(log.count("runs"), expected_runs);
  for (int i = 0; i < expected_runs; ++i) log.expect("((" + value + ",){" + std::to_string(progress) + "};)*");
  EXPECT_EQ(log.line(), ".");
}

TEST(Shards, TogetherAreTheWholeAndKeepPairsTogether) {
  const Campaign campaign = plan_campaign(parse_suite(unguided, "my.yaml", "."), {});
  std::vector<std::string> ids;
  for (int number = 1; number <= 4; ++number) {
    const std::vector<Job> part = jobs_of(campaign.jobs, {number, 4});
    ASSERT_EQ(part.size() % 2, 0U);
    EXPECT_GE(part.size(), 2U);
    EXPECT_LE(part.size(), 4U);
    for (std::size_t i = 0; i < part.size(); i += 2) EXPECT_EQ(part[i].pair, part[i + 1].pair);
    for (const Job& job : part) ids.push_back(job.id);
  }
  std::vector<std::string> all;
  for (const Job& job : campaign.jobs) all.push_back(job.id);
  std::sort(ids.begin(), ids.end());
  std::sort(all.begin(), all.end());
  EXPECT_EQ(ids, all);
}

TEST_F(Results, AShardIsReplayedByItself) {
  const Suite suite = parse_suite(unguided, "my.yaml", ".");
  Json shard = document_of(suite);
  std::vector<Job> jobs = plan_campaign(suite, {}).jobs;
  const std::vector<Job> part = jobs_of(jobs, {2, 3});
  Json rows = Json::array();
  for (const Json& row : shard.at("rows")) {
    const auto has = [&](const Job& job) { return job.id == row.at("id"); };
    if (std::any_of(part.begin(), part.end(), has)) rows.push_back(row);
  }
  shard["rows"] = rows;
  keep_jobs_of(shard, jobs);
  ASSERT_EQ(jobs.size(), part.size());
  for (std::size_t i = 0; i < jobs.size(); ++i) EXPECT_EQ(jobs[i].id, rows.at(i).at("id"));
  shard["rows"].push_back({{"id", "of another suite"}});
  EXPECT_THROW(keep_jobs_of(shard, jobs), ResultError);
}

TEST(Clearance, OfAFreePathIsNeverZero) {
  const OccupancyMap map(4, 9, [] {
    std::vector<Cell> cells(36, Cell::free);
    for (int r = 0; r < 9; ++r) cells[static_cast<std::size_t>(4 * r)] = Cell::occupied;
    return cells;
  }());
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const Clearance along = clearance_of(map, {{2.9, random.uniform(0.0, 9.0)}, {1.0, 7.0}, {1.0, 7.0}});
    EXPECT_EQ(along.least, 1.0);
    EXPECT_GE(along.mean, 1.0);
    EXPECT_LE(along.mean, 2.0);
  }
  EXPECT_EQ(clearance_of(map, {{2.5, 4.5}}).mean, 2.0);
  EXPECT_EQ(clearance_of(map, {}).mean, 0.0);
}

TEST(Shards, WhatIsNoPartIsRefused) {
  EXPECT_EQ(shard_from_string("3/3").number, 3);
  for (const char* text : {"", "1", "0/3", "4/3", "-1/3", "1/3x", "a/b", "1/99999999999"}) {
    EXPECT_THROW(shard_from_string(text), SuiteError) << text;
  }
}

TEST_F(Results, ExportedProblemsAreThoseThatAreRun) {
  const Suite suite = parse_suite(unguided, "my.yaml", ".");
  const fs::path folder = file().parent_path() / "problems";
  EXPECT_EQ(export_problems(suite, folder), 2U);
  const Json list = Json::parse(std::ifstream(folder / "problems.json"));
  const Json rows = document_of(suite).at("rows");
  const std::vector<Problem> problems = make_problems(suite);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    const Json& entry = list.at("problems").at(i);
    EXPECT_EQ(entry.at("map"), problems[i].map_name);
    for (const int axis : {0, 1}) {
      EXPECT_EQ(entry.at("start").at(axis), problems[i].start[axis]);
      EXPECT_EQ(entry.at("goal_pixel").at(axis), problems[i].map->to_pixel(problems[i].goal)[axis]);
    }
    EXPECT_EQ(entry.at("optimum"), rows.at(6 * i).at("optimum"));
    const OccupancyMap map = read_map(folder / entry.at("picture").get<std::string>());
    EXPECT_EQ(map_checksum(map), map_checksum(*problems[i].map));
  }
}

TEST_F(Results, TheOmplLogHasOmplsGrammar) {
  LogReader log(ompl_log(document_of(parse_suite(unguided, "my.yaml", "."))));
  log.expect("OMPL version \\d+\\.\\d+\\.\\d+");
  log.expect("Experiment two_words");
  log.expect("Running on \\S+");
  log.expect("Starting at \\d{4}-\\d\\d-\\d\\d \\d\\d:\\d\\d:\\d\\d");
  log.block();
  log.block();
  log.expect("\\d+ is the random seed");
  log.expect("[0-9.]+ seconds per run");
  log.expect("[0-9.]+ MB per run");
  log.expect("6 runs per planner");
  log.expect("[0-9.e-]+ seconds spent to collect the data");
  EXPECT_EQ(log.count("enum type"), 1);
  log.expect("status(\\|[a-z_]+)+");
  const int planners = log.count("planners");
  EXPECT_EQ(planners, 2);
  for (int i = 0; i < planners; ++i) read_planner(log, 6);
  EXPECT_TRUE(log.at_end());
}

}  // namespace
}  // namespace lrrt::bench
