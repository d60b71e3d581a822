// SPDX-License-Identifier: BSD-3-Clause
#include <csignal>
#include <iostream>

#include "arguments.hpp"
#include "lrrt/error.hpp"
#include "lrrt/planner.hpp"

namespace {

using lrrt::bench::Arguments;
using lrrt::bench::Outcome;
using lrrt::bench::Request;

/// Raised by Ctrl-C; a second one ends the program at once.
lrrt::CancelToken& interruption() {
  static lrrt::CancelToken token;
  return token;
}

void on_signal(int signal) {
  interruption().cancel();
  std::signal(signal, SIG_DFL);
}

Outcome guarded(const Request& request) {
  try {
    return execute(request, interruption());
  } catch (const lrrt::Error& error) {
    std::cerr << "error: " << error.what() << '\n';
  } catch (const std::exception& error) {
    std::cerr << "error: unexpected: " << error.what() << '\n';
  }
  return Outcome::failed;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = lrrt::bench::read_arguments(argc, argv);
  std::cout << arguments.out;
  std::cerr << arguments.err;
  if (arguments.exit) return static_cast<int>(*arguments.exit);
  if (arguments.list) {
    std::cout << lrrt::bench::suite_list();
    return 0;
  }
  lrrt::silence_ompl();
  interruption();
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  return static_cast<int>(guarded(arguments.request));
}
