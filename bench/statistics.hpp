// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace lrrt::bench {

/// What a set of measurements amounts to; every number is NaN where there are too few of them.
struct Summary {
  std::size_t count = 0;
  double median = 0.0;
  double lower = 0.0;  ///< first quartile
  double upper = 0.0;  ///< third quartile
  double mean = 0.0;
  double deviation = 0.0;  ///< sample standard deviation; needs two values
};

Summary summarize(std::vector<double> values);

/// Quantile of sorted values, interpolated linearly between neighbours (Hyndman and Fan 1996, type 7); NaN of none.
/// @param share from 0 to 1.
double quantile(const std::vector<double>& sorted, double share);

/// A confidence interval.
struct Interval {
  double low = 0.0;
  double high = 1.0;
};

/// Wilson's score interval of a success rate (Wilson 1927), 95 %. It stays within 0 and 1 and is honest at 0 and 100 %.
Interval wilson_interval(std::size_t successes, std::size_t trials);

}  // namespace lrrt::bench
