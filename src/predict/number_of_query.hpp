// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>

#include "lrrt/error.hpp"

namespace lrrt {

/// Does something for one query of many. @param number of the query, from 0 on.
/// @throws RequestError where `act` does; its text begins with the query.
template <typename Act>
void naming_query(std::size_t number, const Act& act) {
  try {
    act();
  } catch (const RequestError& error) {
    throw RequestError("queries[" + std::to_string(number) + "]: " + error.what());
  }
}

}  // namespace lrrt
