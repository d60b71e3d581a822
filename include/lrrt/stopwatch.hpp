// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace lrrt {

/// Wall-clock time since it was made or last read.
class Stopwatch {
 public:
  /// A clock that is never set back.
  using Clock = std::chrono::steady_clock;

  /// Milliseconds since the start or the last lap; begins a new lap.
  double lap_ms() {
    const Clock::time_point now = Clock::now();
    const double elapsed = milliseconds(now - lap_);
    lap_ = now;
    return elapsed;
  }
  /// Milliseconds since the start.
  double total_ms() const { return milliseconds(Clock::now() - start_); }

 private:
  static double milliseconds(Clock::duration duration) {
    return std::chrono::duration<double, std::milli>(duration).count();
  }

  Clock::time_point start_ = Clock::now();
  Clock::time_point lap_ = start_;
};

}  // namespace lrrt
