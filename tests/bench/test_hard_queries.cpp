// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "hard_queries.hpp"

namespace lrrt::bench {
namespace {

PlanRecord run(const char* query, double cost, double prediction = 0.0, bool solved = true) {
  PlanRecord record;
  record.query = query;
  record.cost = cost;
  record.prediction = prediction;
  record.solved = solved;
  return record;
}

const std::vector<PlanRecord> unguided = {run("hard", 400.0), run("limit", 100.0), run("failed", 50.0, 0.0, false),
                                          run("easy", 2.0), run("neither", 50.0, 0.0, false)};
const std::vector<PlanRecord> guided = {run("hard", 10.0, 4.0),  run("limit", 6.0, 3.0),
                                        run("failed", 5.0, 4.0), run("easy", 7.0, 4.0),
                                        run("alone", 1.0),       run("neither", 60.0, 4.0, false)};

TEST(HardQueries, AreThoseThatCostTheBaselineMoreOrCameToNothing) {
  const HardAndEasy split = split_by_hardness(unguided, guided);
  EXPECT_EQ(split.gains, (std::vector<double>{40.0, 10.0}));
  EXPECT_EQ(split.easy, (std::vector<double>{6.0, 7.0}));
  EXPECT_EQ(split.neither, 1U);
  EXPECT_EQ(split.allowed, (std::vector<double>{103.0, 6.0}));
}

TEST(HardQueries, TheTableComparesGuidedRowsWithUnguidedBaselines) {
  const RowRecords base{"maps", "RRT", "RRT", false, unguided};
  const RowRecords row{"maps", "guided RRT", "RRT", true, guided};
  const RowRecords other{"maps", "other", "RRT", false, unguided};
  const std::string text = hard_table({&base, &row, &other});
  EXPECT_NE(text.find("guided RRT"), std::string::npos);
  EXPECT_NE(text.find("25.0×"), std::string::npos) << text;
  EXPECT_EQ(text.find("other"), std::string::npos);
  EXPECT_EQ(hard_table({&base, &other}), "");
  const RowRecords only{"maps", "guided", "guided RRT", true, guided};
  EXPECT_EQ(hard_table({&row, &only}), "");
}

}  // namespace
}  // namespace lrrt::bench
