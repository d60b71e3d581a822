// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <iosfwd>
#include <string>

#include "lrrt/plan.hpp"
#include "suite.hpp"

namespace lrrt::bench {

/// What the command line asks for.
struct Request {
  std::string suite;   ///< name or file; empty for --replay
  std::string replay;  ///< result file to run again, "-" for standard input; empty for --suite
  Overrides overrides{};
  int jobs = 1;               ///< runs at a time
  std::string shard = "1/1";  ///< the part of the suite to run
  std::string json;           ///< files to write; empty for none
  std::string csv;
  std::string ompl_log;
  std::string problems;  ///< folder for maps and queries; then nothing is run
};

/// How a run of the program ended, as its exit code.
enum class Outcome { done = 0, failed = 2, differs = 3, interrupted = 130 };

/// The suites that ship, one a line, with their titles.
std::string suite_list();

/// Runs a suite, prints its report and writes the files asked for; or runs a result file again and compares.
///
/// The report comes before the files, so that it is not lost where one of them cannot be written.
/// @param cancel ends the run; with Request::json it can be gone on with.
/// @param begins is called once everything is prepared, before the first job: from then on `cancel` is looked at.
/// @throws lrrt::Error for bad input.
Outcome execute(const Request& request, const CancelToken& cancel, const std::function<void()>& begins = nullptr);

/// What a run came to once its report is out: a report that is lost, as on a full disk, is a failure.
Outcome delivered(std::ostream& report, Outcome outcome);

}  // namespace lrrt::bench
