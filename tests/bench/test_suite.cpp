// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>

#include <unistd.h>

#include "arguments.hpp"
#include "campaign.hpp"
#include "grid_search.hpp"
#include "lrrt/ompl/map_validity.hpp"
#include "made_regions.hpp"
#include "models.hpp"
#include "problems.hpp"
#include "reference.hpp"
#include "suite.hpp"

namespace lrrt::bench {
namespace {

constexpr const char* small = R"(
kind: plan
maps:
  - {kind: maze, level: 9, pixels: 64, count: 2}
queries:
  - {kind: farthest}
  - {kind: random, count: 3, apart: 0.3}
planners:
  - {name: plain, planner: RRTstar, strategy: uniform}
  - {name: guided, planner: RRTstar, strategy: region, alpha: [0.5, 0.8]}
)";

std::string error_of(const std::string& text) {
  try {
    parse_suite(text, "my.yaml", ".");
  } catch (const SuiteError& error) {
    return error.what();
  }
  return "no error";
}

/// The small suite with one text in it replaced.
std::string with(const std::string& from, const std::string& to) {
  std::string text = small;
  return text.replace(text.find(from), from.size(), to);
}

TEST(Suite, ListsMakeRows) {
  const auto suite = std::get<PlanSuite>(parse_suite(small, "my.yaml", ".").body);
  ASSERT_EQ(suite.rows.size(), 3U);
  EXPECT_EQ(suite.rows[0].name, "plain");
  EXPECT_EQ(suite.rows[1].name, "guided, α 0.5");
  EXPECT_EQ(suite.rows[2].name, "guided, α 0.8");
  EXPECT_DOUBLE_EQ(suite.rows[2].options.alpha, 0.8);
  EXPECT_EQ(suite.baseline, "plain");
}

TEST(Suite, ErrorsNameFileLineKeyAndExpectation) {
  EXPECT_EQ(error_of(with("level: 9", "levle: 9")),
            "my.yaml:4: unknown key 'maps[0].levle': expected one of kind, name, level, algorithm, count, pixels, "
            "braid, seed, scale, queries");
  EXPECT_EQ(error_of(with("level: 9", "level: 8")),
            "my.yaml:4: maps[0].level is 8: expected an odd number of blocks from 5 on");
  EXPECT_EQ(error_of(with("0.5, 0.8", "0.5, 1.8")),
            "my.yaml:10: planners[1].alpha is [0.5, 1.8]: expected a share from 0 to 1");
  EXPECT_NE(error_of(with("RRTstar", "RRTsta")).find("unknown planner 'RRTsta'"), std::string::npos);
  EXPECT_NE(error_of(with("region", "regoin")).find("unknown strategy 'regoin'"), std::string::npos);
  EXPECT_NE(error_of(std::string(small) + "baseline: other\n").find("expected one of plain, guided"),
            std::string::npos);
  EXPECT_NE(error_of("kind: [").find("not YAML"), std::string::npos);
  EXPECT_NE(error_of("maps: 3").find("kind is missing"), std::string::npos);
  EXPECT_NE(error_of("- 1").find("expected lines 'key: value'"), std::string::npos);
}

TEST(Suite, AbsurdNumbersAreRefused) {
  for (const auto& [from, to, place] : {std::array{"count: 2", "count: 1e9", "maps[0].count"},
                                        {"pixels: 64", "pixels: 1e300", "maps[0].pixels"},
                                        {"pixels: 64, count: 2", "pixels: 16384, count: 1000", "maps[0].count"},
                                        {"level: 9", "level: .nan", "maps[0].level"},
                                        {"count: 3", "count: -1", "queries[1].count"},
                                        {"apart: 0.3", "apart: .inf", "queries[1].apart"},
                                        {"kind: farthest", "kind: scen, count: 1e12", "queries[0].count"},
                                        {"kind: plan", "kind: plan\nruns: 1e9", "runs"},
                                        {"kind: plan", "kind: plan\ntime_limit: 1e300", "time_limit"},
                                        {"kind: plan", "kind: plan\nradius: .nan", "radius"}}) {
    EXPECT_NE(error_of(with(from, to)).find(std::string(place) + " is "), std::string::npos)
        << error_of(with(from, to));
  }
  EXPECT_NE(error_of("kind: predict\nmazes: 1000\nsizes: [16384]\n").find("mazes is 1000"), std::string::npos);
  Suite suite = parse_suite(small, "my.yaml", ".");
  std::get<PlanSuite>(suite.body).runs = 1000000;
  EXPECT_THROW(plan_campaign(suite, {}), SuiteError);
  for (const double limit : {0.0, -1.0, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    Overrides changes;
    changes.time_limit = limit;
    EXPECT_THROW(apply(changes, suite), SuiteError) << limit;
  }
}

TEST(Arguments, AreReadOrAnswered) {
  const auto read = [](std::vector<const char*> words) {
    words.insert(words.begin(), "lrrt_bench");
    return read_arguments(static_cast<int>(words.size()), words.data());
  };
  const Arguments run = read({"--suite", "smoke", "--runs", "3", "--maps", "a", "b", "--shard=2/3"});
  EXPECT_FALSE(run.exit);
  EXPECT_EQ(run.request.suite, "smoke");
  EXPECT_EQ(run.request.overrides.runs, 3);
  EXPECT_EQ(run.request.overrides.maps, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(run.request.shard, "2/3");
  const Arguments zeros = read({"--suite", "smoke", "--runs", "010", "--jobs", "08", "--seed", "010"});
  EXPECT_EQ(zeros.request.overrides.runs, 10);
  EXPECT_EQ(zeros.request.overrides.seed, 10U);
  EXPECT_EQ(zeros.request.jobs, 8);
  EXPECT_EQ(read({"--suite", "smoke", "--seed", "18446744073709551615"}).request.overrides.seed,
            std::numeric_limits<std::uint64_t>::max());
  EXPECT_TRUE(read({"--list"}).list);
  EXPECT_EQ(read({"--help"}).exit, Outcome::done);
  EXPECT_NE(read({"--help"}).out.find("--suite"), std::string::npos);
  for (const std::vector<const char*>& wrong : {std::vector<const char*>{},
                                                {"--runs", "0"},
                                                {"--runs", "1e99"},
                                                {"--seed", "-1"},
                                                {"--seed", "x"},
                                                {"--jobs", "nan"},
                                                {"--suite", "a", "--replay", "b"},
                                                {"--suite", "a", "--seed", "18446744073709551616"},
                                                {"--suite", "a", "--seed", "99999999999999999999"},
                                                {"--suite", "a", "--seed", "0x10"},
                                                {"--suite", "a", "--seed", ""},
                                                {"--suite", ""},
                                                {"--replay", ""},
                                                {"--suite", "a", "--json", ""},
                                                {"--suite", "a", "--json="},
                                                {"--suite", "a", "--csv", ""},
                                                {"--suite", "a", "--ompl-log", ""},
                                                {"--suite", "a", "--problems", ""},
                                                {"--suite", "a", "--models", ""},
                                                {"--suite", "a", "--problems", "b", "--csv", "c"},
                                                {"--what"},
                                                {"a"}}) {
    const Arguments answer = read(wrong);
    EXPECT_EQ(answer.exit, Outcome::failed);
    EXPECT_FALSE(answer.out.empty() && answer.err.empty());
  }
}

TEST(Suite, JsonReadsBackTheSame) {
  for (const std::string& name : shipped_suites()) {
    const Suite suite = load_suite(name);
    const Json json = to_json(suite);
    EXPECT_EQ(to_json(parse_suite(dumped(json, 1), name, suite.folder)), json) << name;
  }
}

/// "[0.001, 0.002, …]" or "[1, 2, …]": so many different values.
std::string list_of(int count, const char* before) {
  std::string text = "[";
  for (int i = 0; i < count; ++i) text += (i == 0 ? "" : ", ") + std::string(before) + std::to_string(1000 + i);
  return text + "]";
}

TEST(Suite, ListsThatCombineToTooManyRowsAreRefused) {
  const std::string alphas = "alpha: " + list_of(200, "0.");
  const auto rows = [&](int ranges) { return with("alpha: [0.5, 0.8]", alphas + ", range: " + list_of(ranges, "")); };
  const std::string error = error_of(rows(200));
  EXPECT_NE(error.find("my.yaml:10: planners[1].alpha is [0.1000"), std::string::npos) << error;
  EXPECT_NE(error.find("40000 rows, at most 10000"), std::string::npos) << error;
  EXPECT_NE(error_of(rows(50) + "  - {name: more, planner: RRT, strategy: uniform}\n").find("10000 rows at most"),
            std::string::npos);
  EXPECT_EQ(error_of(with("alpha: [0.5, 0.8]", alphas + ", range: " + list_of(20, ""))), "no error");
  EXPECT_NE(
      error_of("{kind: predict, sizes: " + list_of(200, "") + ", batch: " + list_of(100, "") + "}").find("settings"),
      std::string::npos);
  const std::string batch = error_of("{kind: predict, sizes: [64, 4096], batch: [1, 4096], mazes: 1}");
  EXPECT_NE(batch.find("my.yaml:1: batch is [1, 4096]: expected calls of at most"), std::string::npos) << batch;
  EXPECT_EQ(error_of("{kind: predict, sizes: 256, batch: 4096}"), "no error");
}

TEST(Suite, SeedsAreDecimal) {
  const auto seed = [](const std::string& text) {
    return std::get<PlanSuite>(parse_suite(std::string(small) + "seed: " + text + "\n", "my.yaml", ".").body).seed;
  };
  EXPECT_EQ(seed("010"), 10U);
  EXPECT_EQ(seed("18446744073709551615"), std::numeric_limits<std::uint64_t>::max());
  for (const char* wrong : {"18446744073709551616", "0x10", "0o10", "-1", "1e3", "1.0", "[1]", "''"}) {
    EXPECT_NE(error_of(std::string(small) + "seed: " + wrong + "\n").find("seed is "), std::string::npos) << wrong;
  }
}

TEST(Suite, WhatWouldBeReadInPartIsRefused) {
  EXPECT_NE(error_of(std::string(small) + "runs: 3\nruns: 4\n").find("my.yaml:12: runs is there twice"),
            std::string::npos);
  EXPECT_NE(error_of(with("level: 9", "level: 9, level: 7")).find("maps[0].level is there twice"), std::string::npos);
  EXPECT_NE(error_of(std::string(small) + "---\nkind: predict\n").find("begins another document"), std::string::npos);
  EXPECT_EQ(error_of("# first\n--- # a mark before the only document\n" + std::string(small)), "no error");
  EXPECT_NE(error_of(": n"), "no error");  // YAML::LoadAll reads on for ever
  EXPECT_EQ(error_of("---" + std::string(small) + "...\n"), "no error");
  EXPECT_NE(error_of(std::string(small) + "reference: [true, false]\n").find("reference is [true, false]"),
            std::string::npos);
}

/// What make_problems() says of a suite of the maps in a folder.
std::string problems_error(const std::string& maps, const std::filesystem::path& folder) {
  try {
    make_problems(parse_suite(
        "{kind: plan, maps: " + maps + ", queries: [{kind: farthest}], planners: [{planner: RRT, strategy: uniform}]}",
        "my.yaml", folder));
  } catch (const SuiteError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Problems, MapsOfOneNameAndListsWithoutQueriesAreRefused) {
  const std::string maps = LRRT_BENCH_SUITES "/../maps";
  const std::string twice =
      problems_error("[{kind: folder, path: rooms, name: a}, {kind: file, path: city/0.png, name: a/0.png}]", maps);
  EXPECT_NE(twice.find("a second map is called 'a/0.png'"), std::string::npos) << twice;
  const std::filesystem::path empty =
      std::filesystem::temp_directory_path() / ("lrrt_" + std::to_string(getpid()) + ".scen");
  std::ofstream(empty) << "version 1\n";
  const std::string none =
      problems_error("[{kind: file, path: rooms/0.png, queries: [{kind: scen, path: " + empty.string() + "}]}]", maps);
  EXPECT_NE(none.find("holds no queries"), std::string::npos) << none;
  std::filesystem::remove(empty);
}

TEST(Suite, OverridesReachEveryRow) {
  Suite suite = parse_suite(small, "my.yaml", ".");
  apply({7, 99, 1.5, {}, {}}, suite);
  const auto& body = std::get<PlanSuite>(suite.body);
  EXPECT_EQ(body.runs, 7);
  EXPECT_EQ(body.seed, 99U);
  for (const PlanRow& row : body.rows) EXPECT_DOUBLE_EQ(row.options.time_limit, 1.5);
}

TEST(Suite, OwnMapsTakeThePlaceOfTheSuites) {
  Suite suite = load_suite("smoke");
  Overrides changes;
  changes.maps = {LRRT_BENCH_SUITES "/../maps/rooms", LRRT_BENCH_SUITES "/../maps/city/0.png"};
  apply(changes, suite);
  const std::vector<Problem> problems = make_problems(suite);
  EXPECT_EQ(problems.size(), 5U);  // five maps, one query each, as for the map that the suite is given
  for (const Problem& problem : problems)
    EXPECT_TRUE(problem.group == changes.maps[0] || problem.group == changes.maps[1]);
  for (const std::vector<std::string>& wrong :
       {std::vector<std::string>{"nowhere"}, {""}, {LRRT_BENCH_SUITES, LRRT_BENCH_SUITES}}) {
    changes.maps = wrong;
    EXPECT_THROW(apply(changes, suite), SuiteError);
  }
  Suite predictions = load_suite("predict");
  changes.maps = {LRRT_BENCH_SUITES};
  EXPECT_THROW(apply(changes, predictions), SuiteError);
}

TEST(Suite, BatchesAreCountsAndComeBackFromJson) {
  const auto batches = [](const Suite& suite) { return std::get<PredictSuite>(suite.body).batch; };
  EXPECT_EQ(batches(parse_suite("kind: predict", "my.yaml", ".")), std::vector<int>{1});
  const Suite suite = parse_suite("{kind: predict, batch: [1, 8, 3]}", "my.yaml", ".");
  EXPECT_EQ(batches(suite), (std::vector<int>{1, 8, 3}));
  EXPECT_EQ(batches(parse_suite(dumped(to_json(suite)), "my.yaml", ".")), (std::vector<int>{1, 8, 3}));
  for (const char* wrong : {"0", "1.5", "[1, -2]", "many", "5000", "[]"}) {
    EXPECT_NE(error_of(std::string("{kind: predict, batch: ") + wrong + "}").find("my.yaml:1: batch is"),
              std::string::npos)
        << wrong;
  }
}

TEST(Suite, OwnModelsTakeThePlaceOfTheSuites) {
  Suite suite = load_suite("predict");
  Overrides changes;
  changes.models = {LRRT_BENCH_SUITES "/../../tests/data/models/green.*", "default"};
  apply(changes, suite);
  const auto& models = std::get<PredictSuite>(suite.body).models;
  EXPECT_EQ(models, (std::vector<std::string>{"../../tests/data/models/green.*", "default"}));
  Suite plans = load_suite("smoke");
  EXPECT_THROW(apply(changes, plans), SuiteError);
  changes.models = {""};
  EXPECT_THROW(apply(changes, suite), SuiteError);
}

#ifdef LRRT_WITH_TORCH
constexpr bool with_torch = true;
#else
constexpr bool with_torch = false;
#endif

TEST(Models, PatternsTakeWhatCanBeRunAndSayWhatIsLeftOut) {
  Suite suite;
  suite.folder = LRRT_BENCH_SUITES "/../../tests/data";
  const MatchingModels models = matching_models(suite, "models/green.*");
  const std::vector<std::string> onnx{"models/green.onnx"};
  const std::vector<std::string> both{"models/green.onnx", "models/green.pt"};
  EXPECT_EQ(models.found, with_torch ? both : onnx);
  EXPECT_EQ(models.left_out, with_torch ? std::vector<std::string>{} : std::vector<std::string>{"models/green.pt"});
  EXPECT_EQ(matching_models(suite, "models/green.pt").found, std::vector<std::string>{"models/green.pt"});
  EXPECT_THROW(matching_models(suite, "models/nothing*"), SuiteError);
  EXPECT_THROW(matching_models(suite, "*"), SuiteError);  // a Python file and a map are no models
  if (with_torch) {
    EXPECT_EQ(load_model(suite.resolved("models/green.pt")).info.name, "green");
    return;
  }
  try {
    load_model(suite.resolved("models/green.pt"));
    FAIL() << "expected a SuiteError";
  } catch (const SuiteError& error) {
    EXPECT_NE(std::string(error.what()).find("-DLRRT_WITH_TORCH=ON"), std::string::npos) << error.what();
  }
}

TEST(Suite, OwnMapsAreTreatedAsTheSuiteTreatsItsOwn) {
  const std::string rooms = LRRT_BENCH_SUITES "/../maps/rooms";
  const auto treated = [&](const char* name) {
    Suite suite = load_suite(name);
    Overrides changes;
    changes.maps = {rooms};
    apply(changes, suite);
    return std::get<PlanSuite>(suite.body).maps;
  };
  const std::vector<MapSource> large = treated("large");
  ASSERT_EQ(large.size(), 2U);  // enlarged, and in a mosaic
  EXPECT_EQ(large[0].kind, MapSource::Kind::folder);
  EXPECT_EQ(large[0].pixels, 4096);
  EXPECT_EQ(large[1].kind, MapSource::Kind::mosaic);
  EXPECT_NE(large[0].name, large[1].name);
  const std::vector<MapSource> cars = treated("car");
  ASSERT_EQ(cars.size(), 1U);
  EXPECT_EQ(cars[0].name, rooms);
  EXPECT_DOUBLE_EQ(cars[0].scale, 1.0);
  EXPECT_GT(cars[0].queries[0].far, 0.0);
  const std::vector<MapSource> mazes = treated("paper");
  ASSERT_EQ(mazes.size(), 1U);
  EXPECT_EQ(mazes[0].queries[0].count, 5);
}

TEST(Suite, EveryShippedSuiteIsRead) {
  for (const std::string& name : shipped_suites()) EXPECT_FALSE(load_suite(name).title.empty()) << name;
}

TEST(Problems, QueriesAreFreeJoinedAndApart) {
  const Suite suite = parse_suite(small, "my.yaml", ".");
  const std::vector<Problem> problems = make_problems(suite);
  ASSERT_EQ(problems.size(), 8U);
  for (const Problem& p : problems) {
    EXPECT_TRUE(p.map->is_free(OccupancyMap::pixel_of(p.start)));
    EXPECT_TRUE(p.map->is_free(OccupancyMap::pixel_of(p.goal)));
    EXPECT_GT((p.goal - p.start).norm(), 10.0) << p.query;
  }
  const std::vector<Problem> again = make_problems(suite);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    EXPECT_EQ(problems[i].start, again[i].start);
    EXPECT_EQ(map_checksum(*problems[i].map), map_checksum(*again[i].map));
  }
}

TEST(GridSearch, ItsPathIsFreeAndAlmostTheShortest) {
  const Suite suite = parse_suite(with("name: plain, planner: RRTstar", "name: plain, planner: A*"), "my.yaml", ".");
  const auto& body = std::get<PlanSuite>(suite.body);
  EXPECT_EQ(body.rows[0].options.planner, grid_search_name);
  for (const Problem& p : make_problems(suite)) {
    const PlanResult result = grid_search(p, body);
    ASSERT_TRUE(result.solved());
    EXPECT_EQ(result.path.front(), p.start);
    EXPECT_EQ(result.path.back(), p.goal);
    const CollisionMap collision(*p.map);
    for (std::size_t i = 1; i < result.path.size(); ++i) {
      EXPECT_TRUE(collision.is_free(result.path[i - 1], result.path[i]));
    }
    const double shortest = shortest_length(*p.map, p.start, p.goal);
    EXPECT_GE(result.cost, shortest - 1e-9);
    EXPECT_LE(result.cost, 1.09 * shortest + 2.0);
  }
}

TEST(GridSearch, KnowsNeitherGuidanceNorBetterPaths) {
  EXPECT_NE(error_of(with("name: guided, planner: RRTstar", "name: guided, planner: A*")).find("A* searches the grid"),
            std::string::npos);
  EXPECT_NE(error_of(with("RRTstar, strategy: uniform", "A*, strategy: uniform, stop: limit")).find("A* searches"),
            std::string::npos);
}

TEST(MadeRegions, AreWhatTheirNamesSay) {
  const std::vector<Problem> problems = make_problems(parse_suite(small, "my.yaml", "."));
  int broken = 0;
  for (const Problem& p : problems) {
    const auto mask = [&](const char* name) { return made_region(name)->predict(*p.map, p.start, p.goal).region; };
    const PromisingRegion perfect = mask("astar");
    EXPECT_TRUE(perfect.connected());
    EXPECT_TRUE(mask("eroded").connected());
    EXPECT_LT(mask("eroded").area(), perfect.area());
    EXPECT_EQ(mask("empty").area(), 0U);
    EXPECT_EQ(mask("full").area(),
              static_cast<std::size_t>(std::count(p.map->cells().begin(), p.map->cells().end(), Cell::free)));
    EXPECT_EQ(mask("inverted").area(), mask("full").area() - perfect.area());
    broken += static_cast<int>(!mask("broken").connected());
    EXPECT_LT(mask("room").area(), mask("full").area());
    EXPECT_NE(mask("wrong").mask(), perfect.mask());
    EXPECT_NE(mask("shifted").mask(), perfect.mask());
    EXPECT_FALSE(mask("noise").connected());
  }
  EXPECT_GT(broken, 2);  // a short way has no third stretch
  for (const std::string& name : made_region_names()) EXPECT_NE(made_region(name), nullptr) << name;
  EXPECT_EQ(made_region("default"), nullptr);
}

}  // namespace
}  // namespace lrrt::bench
