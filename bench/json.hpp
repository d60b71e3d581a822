// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace lrrt::bench {

/// JSON whose keys stay in the order in which they were written, so that result files read from the top.
using Json = nlohmann::ordered_json;

/// JSON knows no infinity and no NaN: they are null.
inline Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

/// JSON as text; bytes that are no UTF-8 (a file's name may hold any) are replaced. @param indent -1 for one line.
inline std::string dumped(const Json& json, int indent = -1) {
  return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace lrrt::bench
