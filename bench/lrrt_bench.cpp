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

/// Only jobs look at the token, and only they have rows to keep: while a suite is prepared, a signal ends the program.
void catch_signals() {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

Outcome guarded(const Request& request) {
  try {
    return execute(request, interruption(), catch_signals);
  } catch (const lrrt::Error& error) {
    std::cerr << "error: " << error.what() << '\n';
  } catch (const std::exception& error) {
    std::cerr << "error: unexpected: " << error.what() << '\n';
  }
  return Outcome::failed;
}

Outcome answered(const Arguments& arguments) {
  std::cout << arguments.out;
  std::cerr << arguments.err;
  if (arguments.exit) return *arguments.exit;
  if (!arguments.list) return guarded(arguments.request);
  std::cout << lrrt::bench::suite_list();
  return Outcome::done;
}

}  // namespace

int main(int argc, char** argv) {
  const Arguments arguments = lrrt::bench::read_arguments(argc, argv);
  lrrt::silence_ompl();
  interruption();
  std::signal(SIGPIPE, SIG_IGN);  // who reads the report may leave early: the files are written all the same
  return static_cast<int>(lrrt::bench::delivered(std::cout, answered(arguments)));
}
