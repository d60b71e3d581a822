// SPDX-License-Identifier: BSD-3-Clause
/// Input: the words of lrrt_bench's command line, one a line.
#include <sstream>
#include <vector>

#include "arguments.hpp"
#include "shard.hpp"
#include "support.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lrrt;
  using namespace lrrt::bench;
  std::vector<std::string> words{"lrrt_bench"};
  std::istringstream lines(fuzz::text_of(data, size));
  for (std::string line; std::getline(lines, line);) words.push_back(line.c_str());  // up to the first zero byte
  std::vector<const char*> argv;
  for (const std::string& word : words) argv.push_back(word.c_str());
  static const Suite smoke = load_suite("smoke");
  fuzz::answer_or_typed_error([&] {
    const Arguments arguments = read_arguments(static_cast<int>(argv.size()), argv.data());
    if (arguments.exit) {
      fuzz::require(!arguments.out.empty() || !arguments.err.empty(), "an end without a run has a text");
      return;
    }
    const Shard shard = shard_from_string(arguments.request.shard);
    fuzz::require(shard.number >= 1 && shard.number <= shard.of, "a shard is one of its number");
    Suite suite = smoke;
    apply(arguments.request.overrides, suite);
    for (const PlanRow& row : std::get<PlanSuite>(suite.body).rows) {
      fuzz::require(row.options.time_limit > 0.0, "there is time");
    }
  });
  return 0;
}
