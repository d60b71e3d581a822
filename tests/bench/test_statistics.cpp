// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "plan_records.hpp"
#include "statistics.hpp"
#include "table.hpp"

namespace lrrt::bench {
namespace {

TEST(Statistics, SummaryOfKnownValues) {
  const Summary s = summarize({4.0, 1.0, 3.0, 2.0, 10.0});
  EXPECT_EQ(s.count, 5U);
  EXPECT_DOUBLE_EQ(s.median, 3.0);
  EXPECT_DOUBLE_EQ(s.lower, 2.0);
  EXPECT_DOUBLE_EQ(s.upper, 4.0);
  EXPECT_DOUBLE_EQ(s.mean, 4.0);
  EXPECT_DOUBLE_EQ(s.deviation, std::sqrt(12.5));
}

TEST(Statistics, TooFewValuesAreNaN) {
  EXPECT_TRUE(std::isnan(summarize({}).median));
  EXPECT_DOUBLE_EQ(summarize({7.0}).median, 7.0);
  EXPECT_TRUE(std::isnan(summarize({7.0}).deviation));
}

TEST(Statistics, WilsonIntervalAsPublished) {
  // Newcombe 1998, "Two-sided confidence intervals for the single proportion", table I, method 3.
  const Interval some = wilson_interval(81, 263);
  EXPECT_NEAR(some.low, 0.2553, 5e-5);
  EXPECT_NEAR(some.high, 0.3662, 5e-5);
  const Interval none = wilson_interval(0, 20);
  EXPECT_NEAR(none.low, 0.0, 1e-12);
  EXPECT_NEAR(none.high, 0.1611, 5e-5);
}

TEST(Statistics, RatiosPairRunsOfTheSameQueryThatBothSolved) {
  const auto run = [](const char* query, bool solved, double first) {
    PlanRecord record;
    record.query = query;
    record.solved = solved;
    record.first = first;
    return record;
  };
  const std::vector<PlanRecord> baseline = {run("a", true, 10), run("b", true, 20), run("c", false, 99)};
  const std::vector<PlanRecord> rows = {run("b", true, 5), run("a", true, 20), run("c", true, 1), run("d", true, 1)};
  EXPECT_EQ(paired_ratios(baseline, rows, &PlanRecord::first), (std::vector<double>{4.0, 0.5}));
}

TEST(Table, AlignsByCharactersNotBytes) {
  Table table({"name", "value"});
  table.add({"α", "1"});
  table.add({"long name", "12"});
  EXPECT_EQ(table.text(), "name       value\nα              1\nlong name     12\n");
}

TEST(Table, NumbersAreShort) {
  EXPECT_EQ(short_number(63508.4), "63 508");
  EXPECT_EQ(short_number(1234.4), "1234");
  EXPECT_EQ(short_number(12.34), "12.3");
  EXPECT_EQ(short_number(0.0123), "0.012");
  EXPECT_EQ(short_number(0.000571), "0.00057");
  EXPECT_EQ(short_number(0.0), "0");
  EXPECT_EQ(short_number(std::nan("")), "-");
}

}  // namespace
}  // namespace lrrt::bench
