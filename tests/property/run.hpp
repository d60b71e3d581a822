// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace lrrt::property {

/// What came of one case.
struct Verdict {
  std::string complaint;  ///< what was broken; empty when all held
  std::string kind;       ///< what kind of case it was; the kinds are counted
};

/// Tries a property on many cases, each made from its number alone. A failure names the case and how to run it alone;
/// so does a crash.
///
/// The environment says how many: LRRT_PROPERTY_RUNS cases from LRRT_PROPERTY_FIRST (0) on, LRRT_PROPERTY_JOBS (1) at a
/// time; LRRT_PROPERTY_CASE is one case alone.
/// @param runs cases where the environment says nothing: a slice of a few seconds.
void for_all(std::uint64_t runs, const std::function<Verdict(std::uint64_t)>& check);

/// True where LRRT_PROPERTY_CASE names one case: then it is worth telling what it is before it is tried.
bool alone();

}  // namespace lrrt::property
