// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <mutex>
#include <string>

#include "lrrt/stopwatch.hpp"

namespace lrrt::bench {

/// A progress bar on stderr; silent where stderr is no terminal. Safe to use from many threads.
class Progress {
 public:
  /// @param done how many of the steps are done already.
  Progress(std::size_t done, std::size_t total, bool wanted);
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;
  ~Progress();

  /// Counts one more step. @param label what was done.
  void step(const std::string& label);

 private:
  void draw(const std::string& label);

  std::size_t before_;
  std::size_t done_;
  std::size_t total_;
  bool shown_;
  Stopwatch watch_;
  double drawn_at_ = -1e9;
  std::mutex mutex_;
};

}  // namespace lrrt::bench
