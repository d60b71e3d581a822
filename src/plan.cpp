// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/plan.hpp"

#include <array>
#include <utility>

#include "lrrt/error.hpp"

namespace lrrt {
namespace {

template <typename Value, std::size_t N>
Value from_word(const std::string& what, const std::string& word,
                const std::array<std::pair<const char*, Value>, N>& table) {
  std::string known;
  for (const auto& [name, value] : table) {
    if (word == name) return value;
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  throw RequestError("unknown " + what + " '" + word + "': expected one of " + known);
}

}  // namespace

const char* to_string(PlanStatus status) {
  switch (status) {
    case PlanStatus::solved:
      return "solved";
    case PlanStatus::start_outside:
      return "start_outside";
    case PlanStatus::goal_outside:
      return "goal_outside";
    case PlanStatus::start_occupied:
      return "start_occupied";
    case PlanStatus::goal_occupied:
      return "goal_occupied";
    case PlanStatus::not_connected:
      return "not_connected";
    case PlanStatus::time_limit:
      return "time_limit";
    case PlanStatus::iteration_limit:
      return "iteration_limit";
    case PlanStatus::cancelled:
      return "cancelled";
  }
  return "unknown";
}

Strategy strategy_from_string(const std::string& word) {
  constexpr std::array<std::pair<const char*, Strategy>, 3> table = {
      {{"uniform", Strategy::uniform}, {"region", Strategy::region}, {"frontier", Strategy::frontier}}};
  return from_word("strategy", word, table);
}

Neighbors neighbors_from_string(const std::string& word) {
  constexpr std::array<std::pair<const char*, Neighbors>, 2> table = {
      {{"grid", Neighbors::grid}, {"ompl", Neighbors::ompl}}};
  return from_word("neighbors", word, table);
}

OnPredictError on_predict_error_from_string(const std::string& word) {
  constexpr std::array<std::pair<const char*, OnPredictError>, 2> table = {
      {{"raise", OnPredictError::raise}, {"unguided", OnPredictError::unguided}}};
  return from_word("on_predict_error", word, table);
}

Motion motion_from_string(const std::string& word) {
  constexpr std::array<std::pair<const char*, Motion>, 6> table = {{{"plane", Motion::plane},
                                                                    {"turning", Motion::turning},
                                                                    {"dubins", Motion::dubins},
                                                                    {"reeds_shepp", Motion::reeds_shepp},
                                                                    {"unicycle", Motion::unicycle},
                                                                    {"car", Motion::car}}};
  return from_word("motion", word, table);
}

Stop stop_from_string(const std::string& word) {
  constexpr std::array<std::pair<const char*, Stop>, 3> table = {
      {{"first", Stop::first}, {"factor", Stop::factor}, {"limit", Stop::limit}}};
  return from_word("stop", word, table);
}

}  // namespace lrrt
