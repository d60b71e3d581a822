// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "suite.hpp"

namespace lrrt::bench {

/// Writes the problems of a suite for planners outside this program: every map as it is planned on by a point (unknown
/// pixels resolved, grown by the robot's radius; white is free, black is not) as a PNG picture, and `problems.json`
/// with seeds, limits and, for every query, group, map, picture, start and goal in pixels (x right, y down) and map
/// units, their headings where there are any, the scale of the robot, and the exact optimum in map units. An outline is
/// not grown into the pictures; the suite in the list tells it. Finished pictures are written before the list, the list
/// at last.
/// @return the number of queries. @throws SuiteError for a suite without problems. @throws MapError when it cannot
/// write.
std::size_t export_problems(const Suite& suite, const std::filesystem::path& folder);

}  // namespace lrrt::bench
