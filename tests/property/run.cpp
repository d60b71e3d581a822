// SPDX-License-Identifier: BSD-3-Clause
#include "run.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace lrrt::property {
namespace {

constexpr std::size_t most_jobs = 64;
constexpr std::uint64_t idle = ~std::uint64_t{0};
/// After so many complaints a property is broken for good.
constexpr std::size_t most_complaints = 20;
/// Cases between two signs of life.
constexpr std::size_t between_signs = 5000;

/// The cases that are being tried: what a crash has to tell.
std::array<std::atomic<std::uint64_t>, most_jobs>& running() {
  static std::array<std::atomic<std::uint64_t>, most_jobs> cases;
  return cases;
}

void name_running_cases(int signal) {
  for (const std::atomic<std::uint64_t>& each : running()) {
    std::array<char, 80> line{};
    const auto number = static_cast<unsigned long long>(each.load());
    if (number == idle) continue;
    const int length = std::snprintf(line.data(), line.size(), "crashed in LRRT_PROPERTY_CASE=%llu\n", number);
    if (write(STDERR_FILENO, line.data(), static_cast<std::size_t>(length)) < 0) break;
  }
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// Sanitizers have handlers of their own, which tell more.
void watch_for_crashes() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE}) std::signal(signal, name_running_cases);
#endif
  for (std::atomic<std::uint64_t>& each : running()) each = idle;
}

std::uint64_t number_from(const char* name, std::uint64_t fallback) {
  const char* text = std::getenv(name);
  return text == nullptr || *text == '\0' ? fallback : std::strtoull(text, nullptr, 10);
}

std::string this_test() {
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  return std::string(test.test_suite_name()) + "." + test.name();
}

/// What the cases came to, whichever thread tried them.
class Tally {
 public:
  explicit Tally(std::string test) : test_(std::move(test)) {}

  void add(std::uint64_t number, const Verdict& verdict) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++kinds_[verdict.kind];
    if (++cases_ % between_signs == 0) std::cout << test_ << ": " << cases_ << " cases" << std::endl;
    if (verdict.complaint.empty()) return;
    ++complaints_;
    ADD_FAILURE() << "case " << number << ": " << verdict.complaint << "\nalone: LRRT_PROPERTY_CASE=" << number
                  << " lrrt_property_tests --gtest_filter=" << test_;
  }
  bool broken() const { return complaints_ >= most_complaints; }
  void print() const {
    std::cout << test_ << ": " << cases_ << " cases, " << complaints_ << " violations\n";
    for (const auto& [kind, count] : kinds_) std::cout << "  " << count << ' ' << kind << '\n';
    std::cout.flush();
  }

 private:
  std::string test_;
  std::mutex mutex_;
  std::map<std::string, std::size_t> kinds_;
  std::size_t cases_ = 0;
  std::atomic<std::size_t> complaints_{0};
};

Verdict guarded(const std::function<Verdict(std::uint64_t)>& check, std::uint64_t number) {
  try {
    return check(number);
  } catch (const std::exception& error) {
    return {std::string("threw ") + error.what(), "thrown"};
  }
}

}  // namespace

bool alone() {
  return number_from("LRRT_PROPERTY_CASE", idle) != idle;
}

void for_all(std::uint64_t runs, const std::function<Verdict(std::uint64_t)>& check) {
  watch_for_crashes();
  const std::uint64_t only = number_from("LRRT_PROPERTY_CASE", idle);
  const std::uint64_t first = only != idle ? only : number_from("LRRT_PROPERTY_FIRST", 0);
  const std::uint64_t end = only != idle ? only + 1 : first + number_from("LRRT_PROPERTY_RUNS", runs);
  Tally tally(this_test());
  std::atomic<std::uint64_t> next{first};
  const auto work = [&](std::size_t job) {
    for (std::uint64_t number = next++; number < end && !tally.broken(); number = next++) {
      running()[job] = number;
      tally.add(number, guarded(check, number));
    }
    running()[job] = idle;
  };
  const std::uint64_t jobs = std::clamp<std::uint64_t>(number_from("LRRT_PROPERTY_JOBS", 1), 1, most_jobs);
  std::vector<std::thread> threads;
  for (std::size_t job = 1; job < jobs; ++job) threads.emplace_back(work, job);
  work(0);
  for (std::thread& thread : threads) thread.join();
  tally.print();
}

}  // namespace lrrt::property
