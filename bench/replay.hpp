// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "campaign.hpp"
#include "json.hpp"
#include "suite.hpp"

namespace lrrt::bench {

/// The suite that a result file was made with. @throws SuiteError when it no longer makes sense.
Suite replayed_suite(const Json& document, const std::filesystem::path& file);

/// Runs that ended by the clock, and after how many iterations: only so can they be repeated.
IterationLimits replay_limits(const Json& document);

/// @throws ResultError when a map or model is not what it was.
void check_inputs(const Json& document, const Json& inputs, const std::filesystem::path& file);

/// Keeps the jobs whose rows a document has: all of a whole run, some of a shard's.
/// @throws ResultError when a row of the document has no job any more.
void keep_jobs_of(const Json& document, std::vector<Job>& jobs);

/// What came of a replay.
struct Comparison {
  bool same = true;
  std::string text;  ///< for the terminal: what differs
};

/// Compares iterations and nodes (plan) or the areas of the regions (predict), row by row.
///
/// A run that the clock ended may have been cut inside its last iteration: there, one node more or less is the same.
Comparison compare_replay(const Json& before, const Json& after);

}  // namespace lrrt::bench
