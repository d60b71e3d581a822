// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "json.hpp"
#include "runner.hpp"
#include "suite.hpp"

namespace lrrt::bench {

/// A suite made ready to run: its maps, queries and models are there.
struct Campaign {
  Json inputs;              ///< what was read or generated, with checksums
  std::string onnxruntime;  ///< version of the runtime that was loaded; empty when none was
  std::string libtorch;     ///< the same
  std::vector<Job> jobs;
  std::vector<std::string> notes;  ///< what the user should know before anything is run
};

/// Runs, by id, that end after so many iterations, whatever the clock says.
using IterationLimits = std::map<std::string, std::size_t>;

/// How near to the optimum a path has to come for its time to be told, percent.
inline constexpr std::array<int, 4> within_percents = {10, 5, 2, 1};

/// @param cancel ends a plan that is under way. @throws SuiteError, MapError, ModelError.
Campaign plan_campaign(const Suite& suite, const CancelToken& cancel, const IterationLimits& limits = {});
Campaign predict_campaign(const Suite& suite, const CancelToken& cancel);

/// What all rows of a run share: suite, folder, inputs, versions, machine.
Json header_of(const Suite& suite, const Campaign& campaign);

/// The report on a finished document, for the terminal.
std::string plan_report(const Json& document);
std::string predict_report(const Json& document);

/// One line for every row of a finished document.
std::string plan_csv(const Json& document);
std::string predict_csv(const Json& document);

}  // namespace lrrt::bench
