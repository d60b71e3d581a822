// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <limits>

#include "fields.hpp"

namespace lrrt::bench {

inline constexpr double endless = std::numeric_limits<double>::max();
inline constexpr NumberRule counts{1, 1e6, "a whole number from 1 to 1000000"};
inline constexpr NumberRule levels{5, 2047, "an odd number of blocks from 5 on"};
inline constexpr NumberRule shares{0, 1, "a share from 0 to 1"};
inline constexpr NumberRule lengths{0, endless, "0 or a positive length in map units"};
/// Of one search.
inline constexpr NumberRule time_limits{1e-6, 1e9, "a number of seconds from 1e-06 to 1e+09"};

}  // namespace lrrt::bench
