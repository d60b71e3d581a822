// SPDX-License-Identifier: BSD-3-Clause
#include "shard.hpp"

#include <algorithm>
#include <regex>
#include <utility>

#include "fields.hpp"

namespace lrrt::bench {

Shard shard_from_string(const std::string& text) {
  std::smatch parts;
  if (std::regex_match(text, parts, std::regex("([0-9]{1,6})/([0-9]{1,6})"))) {
    const Shard shard{std::stoi(parts[1]), std::stoi(parts[2])};
    if (shard.number >= 1 && shard.number <= shard.of) return shard;
  }
  throw SuiteError("--shard '" + text + "': expected K/N, part K of N, such as 2/5");
}

std::vector<Job> jobs_of(std::vector<Job> jobs, const Shard& shard) {
  const auto parts = static_cast<std::size_t>(shard.of);
  const auto elsewhere = [&](const Job& job) { return job.pair % parts + 1 != static_cast<std::size_t>(shard.number); };
  jobs.erase(std::remove_if(jobs.begin(), jobs.end(), elsewhere), jobs.end());
  return jobs;
}

}  // namespace lrrt::bench
