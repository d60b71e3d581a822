// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "lrrt/plan.hpp"
#include "lrrt/stopwatch.hpp"

namespace lrrt {

/// Decides when a search has to end, and remembers why. Belongs to one search; PRM asks from two threads.
class SearchLimits {
 public:
  /// Starts the clock. @param cancel ends the search from another thread.
  SearchLimits(double seconds, std::size_t iterations, CancelToken cancel)
      : limit_ms_(seconds * 1e3), iteration_limit_(iterations), cancel_(std::move(cancel)) {}

  /// Starts the clock.
  void restart() { watch_ = Stopwatch(); }

  /// Asked by OMPL's planners once an iteration. @return true when the search must end; otherwise counts the iteration.
  bool next_iteration() {
    if (iterations_ >= iteration_limit_ || interrupted()) return true;
    ++iterations_;
    return false;
  }

  /// Asked at every motion and every draw: one iteration of RRT-Connect may hold any number of motions, one of AIT* any
  /// number of draws. Looks at the clock now and then.
  /// @return true when time is over or the caller gave up.
  bool interrupted_at_motion() {
    constexpr std::uint32_t asked_between_looks = 64;
    const std::uint32_t asked = asked_.load(std::memory_order_relaxed) + 1;  // a count that is lost does no harm
    asked_.store(asked, std::memory_order_relaxed);
    if (!interrupted_ && asked % asked_between_looks == 0) interrupted();
    return interrupted_;
  }

  /// True once time is over or the caller gave up; looks at the clock.
  bool interrupted() {
    if (!interrupted_ && (cancel_.cancelled() || watch_.total_ms() >= limit_ms_)) interrupted_ = true;
    return interrupted_;
  }

  /// Iterations that were counted.
  std::size_t iterations() const { return iterations_; }
  /// Milliseconds since the clock was started.
  double elapsed_ms() const { return watch_.total_ms(); }

  /// Why a search without a solution ended.
  PlanStatus reason() const {
    if (cancel_.cancelled()) return PlanStatus::cancelled;
    return interrupted_ ? PlanStatus::time_limit : PlanStatus::iteration_limit;
  }

 private:
  Stopwatch watch_;
  double limit_ms_;
  std::size_t iteration_limit_;
  CancelToken cancel_;
  std::atomic<std::size_t> iterations_{0};
  std::atomic<std::uint32_t> asked_{0};
  std::atomic<bool> interrupted_{false};
};

}  // namespace lrrt
