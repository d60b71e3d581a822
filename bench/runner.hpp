// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "json.hpp"
#include "lrrt/plan.hpp"
#include "result_file.hpp"

namespace lrrt::bench {

/// One measurement to make.
struct Job {
  std::string id;             ///< tells it from the others, also in the next run of the program
  std::string label;          ///< for the progress bar
  std::function<Json()> run;  ///< the row's fields but for its id; called from any thread, once
  std::size_t pair = 0;       ///< the same for rows on one problem with one seed: they are compared with one another
};

/// How to run jobs.
struct RunOptions {
  int threads = 1;       ///< jobs at a time
  bool progress = true;  ///< draw a progress bar where stderr is a terminal
  CancelToken cancel{};  ///< ends the run; what was under way is dropped
};

/// Runs the jobs whose rows are not there yet and adds them. @return false when it was cancelled before the end.
/// @throws what a job throws, after the others have stopped.
bool run_jobs(const std::vector<Job>& jobs, const RunOptions& options, ResultFile& results);

}  // namespace lrrt::bench
