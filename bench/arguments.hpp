// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>

#include "command_line.hpp"

namespace lrrt::bench {

/// The words of the command line, understood.
struct Arguments {
  Request request{};
  bool list = false;              ///< show the suites that ship
  std::optional<Outcome> exit{};  ///< there is nothing to run: print the texts and end so
  std::string out{};              ///< for standard output: the help, the version
  std::string err{};              ///< for standard error: what is wrong
};

/// Reads the words of the command line; touches no file.
/// @param argv as main() gets it, the program's name first.
Arguments read_arguments(int argc, const char* const* argv);

}  // namespace lrrt::bench
