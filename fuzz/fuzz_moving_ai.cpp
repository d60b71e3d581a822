// SPDX-License-Identifier: BSD-3-Clause
/// Input: a MovingAI map or scenario list; it is read as both.
#include "lrrt/map/moving_ai.hpp"
#include "support.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace lrrt;
  const std::string text = fuzz::text_of(data, size);
  fuzz::answer_or_typed_error([&] { parse_moving_ai_map(text, "fuzz.map"); });
  fuzz::answer_or_typed_error([&] {
    for (const Scenario& s : parse_scenarios(text, "fuzz.scen")) {
      const bool inside = s.start.c >= 0 && s.start.c < s.width && s.start.r >= 0 && s.start.r < s.height;
      fuzz::require(inside, "a start lies in its map");
    }
  });
  return 0;
}
