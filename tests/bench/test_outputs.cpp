// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <ostream>
#include <sstream>
#include <streambuf>
#include <string>
#include <thread>

#include "command_line.hpp"
#include "outputs.hpp"
#include "problem_export.hpp"
#include "result_file.hpp"

namespace lrrt::bench {
namespace {

namespace fs = std::filesystem;

constexpr const char* tiny = R"(
kind: plan
maps: [{kind: maze, level: 5, pixels: 16}]
queries: [{kind: farthest}]
planners: [{name: RRT, planner: RRT, strategy: uniform}]
runs: 2
)";

std::string text_in(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder of its own for every test, with a suite in it.
class Outputs : public testing::Test {
 protected:
  void SetUp() override {
    const std::string test = testing::UnitTest::GetInstance()->current_test_info()->name();
    folder_ = fs::temp_directory_path() / ("lrrt_outputs_" + test + "_" + std::to_string(getpid()));
    fs::create_directories(folder_ / "folder");
    put("suite.yaml", tiny);
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path in(const std::string& name) const { return folder_ / name; }
  void put(const std::string& name, const std::string& text) const { std::ofstream(in(name)) << text; }
  Request request() const {
    Request request;
    request.suite = in("suite.yaml").string();
    return request;
  }

  /// How often jobs began, and what the run came to: the report, or the error. Leaves no working files.
  std::string outcome(const Request& request, int& begun) const {
    testing::internal::CaptureStdout();
    testing::internal::CaptureStderr();
    std::string error;
    try {
      execute(request, {}, [&] { ++begun; });
    } catch (const Error& typed) {
      error = typed.what();
    }
    testing::internal::GetCapturedStderr();
    const std::string report = testing::internal::GetCapturedStdout();
    for (const auto& entry : fs::directory_iterator(folder_)) {
      EXPECT_NE(entry.path().extension(), ".new") << entry.path();
      EXPECT_NE(entry.path().extension(), ".part") << entry.path();
    }
    return error.empty() ? report : error;
  }

  void expect_refused(const Request& request, const std::string& part) const {
    int begun = 0;
    const std::string said = outcome(request, begun);
    EXPECT_EQ(begun, 0) << said;
    EXPECT_NE(said.find(part), std::string::npos) << said;
  }

 private:
  fs::path folder_;
};

TEST_F(Outputs, AreCheckedBeforeAnythingIsMeasured) {
  for (std::string Request::*option : {&Request::json, &Request::csv, &Request::ompl_log}) {
    for (const std::string& name : {std::string("folder"), std::string("folder/"), std::string("none/x"),
                                    std::string("suite.yaml/x"), std::string(300, 'x')}) {
      Request request = this->request();
      request.*option = in(name).string();
      expect_refused(request, in(name).string());
    }
  }
  EXPECT_TRUE(fs::is_empty(in("folder")));
}

TEST_F(Outputs, NeverTakeThePlaceOfAnInputOrOfEachOther) {
  const auto refused = [&](std::string Request::*a, const std::string& first, std::string Request::*b,
                           const std::string& second, const std::string& part) {
    Request request = this->request();
    request.*a = in(first).string();
    if (b != nullptr) request.*b = in(second).string();
    expect_refused(request, part);
  };
  fs::create_symlink("suite.yaml", in("link"));
  for (std::string Request::*option : {&Request::json, &Request::csv, &Request::ompl_log}) {
    for (const char* name : {"suite.yaml", "link", "folder/../suite.yaml"}) {
      refused(option, name, nullptr, "", "would overwrite --suite");
    }
  }
  fs::create_symlink("same", in("dangling"));
  for (const char* name : {"same", "same.part", "same.part.new", "same.new", "folder/../same", "dangling"}) {
    refused(&Request::json, "same", &Request::csv, name, "would overwrite what --json writes");
  }
  refused(&Request::csv, "same", &Request::ompl_log, "same", "would overwrite what --csv writes");
  EXPECT_EQ(text_in(in("suite.yaml")), tiny);

  Request begin = request();
  begin.json = in("result.json").string();
  int begun = 0;
  outcome(begin, begun);
  ASSERT_EQ(begun, 1);
  const std::string result = text_in(in("result.json"));
  Request again;
  again.replay = in("result.json").string();
  again.csv = in("result.json").string();
  expect_refused(again, "would overwrite --replay");
  EXPECT_EQ(text_in(in("result.json")), result);
}

TEST_F(Outputs, MapsOfTheSuiteAreNotOverwritten) {
  fs::create_directories(in("maps"));
  const fs::path map = in("maps") / "map_1.png";
  fs::copy_file(LRRT_BENCH_SUITES "/../maps/rooms/0.png", map);
  const std::string before = text_in(map);
  put("suite.yaml",
      "kind: plan\nmaps: [{kind: folder, path: maps}]\nqueries: [{kind: farthest}]\n"
      "planners: [{planner: RRT, strategy: uniform}]\n");
  Request request = this->request();
  request.csv = map.string();
  expect_refused(request, "would overwrite what the suite reads");
  request.csv.clear();
  request.problems = in("maps").string();
  expect_refused(request, "map_1.png, which the suite reads");
  EXPECT_EQ(text_in(map), before);
}

TEST_F(Outputs, LinksAreFollowedAndPipesStayPipes) {
  write_file(in("plain"), "old");
  fs::create_symlink("plain", in("link"));
  fs::create_symlink("folder/later", in("dangling"));
  write_file(in("link"), "new");
  write_file(in("dangling"), "first");
  EXPECT_TRUE(fs::is_symlink(in("link")));
  EXPECT_EQ(text_in(in("plain")), "new");
  EXPECT_TRUE(fs::is_symlink(in("dangling")));
  EXPECT_EQ(text_in(in("folder/later")), "first");

  ASSERT_EQ(mkfifo(in("pipe").c_str(), 0600), 0);
  Request request = this->request();
  request.json = in("pipe").string();
  expect_refused(request, "is no regular file");
  request.json.clear();
  request.csv = in("pipe").string();
  std::string read;
  std::thread reader([&] { read = text_in(in("pipe")); });
  int begun = 0;
  const std::string said = outcome(request, begun);
  reader.join();
  EXPECT_EQ(begun, 1) << said;
  EXPECT_EQ(std::count(read.begin(), read.end(), '\n'), 1 + 2);
  EXPECT_TRUE(fs::is_fifo(in("pipe")));
  request.csv = request.ompl_log = "/dev/null";
  outcome(request, begun);
  EXPECT_EQ(begun, 2);
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(Outputs, TheReportIsThereWhereAFileCannotBeWritten) {
  Request request = this->request();
  request.csv = in("folder/x.csv").string();
  testing::internal::CaptureStdout();
  EXPECT_THROW(execute(request, {}, [&] { fs::remove(in("folder")); }), ResultError);
  EXPECT_NE(testing::internal::GetCapturedStdout().find("first path, ms"), std::string::npos);
}

TEST_F(Outputs, AFileThatFailsLeavesNothingBehind) {
  fs::create_directories(in("taken/x"));
  EXPECT_THROW(write_file(in("taken"), "text"), ResultError);
  EXPECT_FALSE(fs::exists(in("taken.new")));
  fs::create_directories(in("run.json.part/x"));
  EXPECT_THROW(ResultFile(in("run.json"), {{"suite", 1}}), ResultError);
  EXPECT_FALSE(fs::exists(in("run.json.part.new")));
}

TEST_F(Outputs, JobsBeginOnlyWhenAllIsPrepared) {
  put("suite.yaml", std::string(tiny) + "radius: 1000\n");
  expect_refused(request(), "the robot fits nowhere");
}

/// A full disk.
class Full : public std::streambuf {
  int sync() override { return -1; }
};

TEST(Delivered, AReportThatIsLostIsAFailure) {
  Full full;
  std::ostream lost(&full);
  EXPECT_EQ(delivered(lost, Outcome::done), Outcome::failed);
  std::ostringstream kept;
  EXPECT_EQ(delivered(kept, Outcome::differs), Outcome::differs);
}

}  // namespace
}  // namespace lrrt::bench
