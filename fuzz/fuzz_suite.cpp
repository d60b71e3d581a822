// SPDX-License-Identifier: BSD-3-Clause
/// Input: a suite of lrrt_bench. What is read must be read again from what is written of it.
#include "suite.hpp"
#include "support.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lrrt;
  using namespace lrrt::bench;
  fuzz::answer_or_typed_error([&] {
    const Json said = to_json(parse_suite(fuzz::text_of(data, size), "fuzz.yaml", "."));
    try {
      const Json again = to_json(parse_suite(dumped(said), "again.yaml", "."));
      fuzz::require(dumped(said) == dumped(again), "a suite that is written and read stays what it is");
    } catch (const Error& error) {
      fuzz::require(false, error.what());
    }
  });
  return 0;
}
