// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "suite.hpp"

namespace lrrt::bench {

/// The maps and lists of queries that a suite reads. @throws SuiteError where there are none.
std::vector<std::filesystem::path> files_of_maps(const Suite& suite);

/// The files that a run of a suite reads: maps, lists of queries, models. @throws SuiteError where there are none.
std::vector<std::filesystem::path> files_of(const Suite& suite);

}  // namespace lrrt::bench
