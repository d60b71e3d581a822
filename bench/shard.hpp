// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "runner.hpp"

namespace lrrt::bench {

/// A part of a suite, so that several machines can share it: part `number` of `of`, from 1 on.
struct Shard {
  int number = 1;
  int of = 1;

  bool whole() const { return of == 1; }
};

/// Reads "2/5". @throws SuiteError for anything else.
Shard shard_from_string(const std::string& text);

/// The jobs of a part. Rows that are compared with one another stay together; parts differ by one pair at most.
std::vector<Job> jobs_of(std::vector<Job> jobs, const Shard& shard);

}  // namespace lrrt::bench
