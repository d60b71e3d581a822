// SPDX-License-Identifier: BSD-3-Clause
// Many threads plan on one planner and one model for a while: results must equal those of one thread, memory must stay
// flat, nothing may lock up. Then, one at a time, how soon searches and whole plans end that are cancelled or out of
// time.
#include <pthread.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "families.hpp"
#include "lrrt/planner.hpp"
#include "lrrt/predict/onnx_predictor.hpp"
#include "lrrt/stopwatch.hpp"
#include "support.hpp"

namespace lrrt::load {
namespace {

struct Settings {
  std::size_t threads = 32;
  double seconds = 300.0;
  int searches = 200;           ///< of each kind, to time cancelling and limits
  double most_growth = 0.02;    ///< of memory after the first third, as a share; asked of runs of a minute or more
  double most_delay_ms = 1e3;   ///< an end that comes later fails; the claim of 10 ms is for a quiet machine
  double stuck_seconds = 60.0;  ///< no result for so long is a deadlock
};

/// A query and what one thread alone answers to it.
struct Task {
  OccupancyMap map;
  Eigen::Vector2d start;
  Eigen::Vector2d goal;
  std::size_t planner;
  PlanResult expected{};
};

PlanOptions options_of(const char* name) {
  PlanOptions options;
  options.planner = name;
  options.iteration_limit = 1000;
  options.time_limit = 1e6;
  return options;
}

/// Planners that share one model, and the tasks that they are given.
class Work {
 public:
  explicit Work(const std::shared_ptr<const RegionPredictor>& model) {
    for (const char* name : {"RRT", "RRTConnect", "RRTstar", "SST"}) planners_.emplace_back(model, options_of(name));
    Random random(1);
    for (std::size_t i = 0; i < 48; ++i) {
      property::Cells cells = property::random_cells(i % 5, random);
      cells.cells.front() = Cell::free;
      OccupancyMap map(cells.width, cells.height, std::move(cells.cells));
      const Eigen::Vector2d start = test::random_free_point(map, random);
      const Eigen::Vector2d goal = test::random_free_point(map, random);
      tasks_.push_back({std::move(map), start, goal, i % planners_.size()});
      tasks_.back().expected = plan(tasks_.back());
    }
  }
  /// Plans one of the tasks. @return whether the result is as expected.
  bool try_one(std::size_t i) const {
    const Task& task = tasks_[i % tasks_.size()];
    const PlanResult result = plan(task);
    return result.status == task.expected.status && result.path == task.expected.path &&
           result.iterations == task.expected.iterations && result.nodes == task.expected.nodes;
  }

 private:
  PlanResult plan(const Task& task) const { return planners_[task.planner].plan({task.map, task.start, task.goal}); }

  std::vector<Planner> planners_;
  std::vector<Task> tasks_;
};

/// Memory of this process that is in use, MiB.
double resident_mib() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  file >> pages >> pages;
  return pages * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1 << 20U);
}

/// The most of some values, e.g. of memory.
double highest(const std::vector<double>& values, std::size_t from, std::size_t to) {
  return *std::max_element(values.begin() + static_cast<std::ptrdiff_t>(from),
                           values.begin() + static_cast<std::ptrdiff_t>(to));
}

/// Watches a load while it runs: memory, and whether there are results.
std::vector<double> watch(const Settings& settings, const std::atomic<std::size_t>& done) {
  std::vector<double> memory;
  const Stopwatch watch;
  std::size_t seen = 0;
  double last_result = 0.0;
  while (watch.total_ms() < 1e3 * settings.seconds || memory.size() < 3) {
    std::this_thread::sleep_for(std::chrono::milliseconds(250));
    memory.push_back(resident_mib());
    if (done != seen) last_result = watch.total_ms();
    seen = done;
    if (watch.total_ms() - last_result > 1e3 * settings.stuck_seconds) {
      std::fprintf(stderr, "no result for %.0f s: deadlock\n", settings.stuck_seconds);
      std::abort();
    }
  }
  return memory;
}

bool run_threads(const Settings& settings, const Work& work) {
  std::atomic<std::size_t> done{0};
  std::atomic<std::size_t> different{0};
  std::atomic<bool> over{false};
  std::vector<std::thread> threads;
  for (std::size_t k = 0; k < settings.threads; ++k) {
    threads.emplace_back([&, k] {
      for (std::size_t i = 7 * k; !over; ++i) {
        different += static_cast<std::size_t>(!work.try_one(i));
        ++done;
      }
    });
  }
  const std::vector<double> memory = watch(settings, done);
  over = true;
  for (std::thread& thread : threads) thread.join();
  const double before = highest(memory, 0, (memory.size() + 2) / 3);
  const double after = highest(memory, memory.size() / 3, memory.size());
  const double growth = after / before - 1.0;
  std::printf("%zu threads, %.0f s: %zu searches, %zu unlike those of one thread\n", settings.threads, settings.seconds,
              done.load(), different.load());
  std::printf("memory: at most %.1f MiB in the first third, %.1f MiB afterwards (%+.2f %%)\n", before, after,
              100.0 * growth);
  return different == 0 && (settings.seconds < 60.0 || growth <= settings.most_growth);
}

/// By how many milliseconds a search ended too late: on the clock, and of its own computing, which leaves out what
/// other programs took.
struct Delay {
  double wall = 0.0;
  double computing = 0.0;
};

double computed_ms(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

/// A search that goes on until it is told to end.
Delay delay_of_cancel(const Planner& planner, PlanRequest request, int pause_ms) {
  request.cancel = CancelToken();
  clockid_t own{};
  pthread_getcpuclockid(pthread_self(), &own);
  Stopwatch since;
  double computed = 0.0;
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(pause_ms));
    computed = computed_ms(own);
    since = Stopwatch();
    request.cancel.cancel();
  });
  planner.plan(request);
  const double computed_now = computed_ms(own);
  const Stopwatch now;
  other.join();
  return {since.total_ms() - now.total_ms(), computed_now - computed};
}

/// @return false where one came too late, or where a search was over before it was told to end.
bool report(const char* what, std::vector<double> delays, double most) {
  std::sort(delays.begin(), delays.end());
  const auto at = [&](double share) {
    return delays[static_cast<std::size_t>(share * (static_cast<double>(delays.size()) - 1.0))];
  };
  const auto within = std::count_if(delays.begin(), delays.end(), [](double delay) { return delay <= 10.0; });
  std::printf("%s: late by %.2f ms (median), %.2f (95 %%), %.2f (most); %td of %zu within 10 ms\n", what, at(0.5),
              at(0.95), delays.back(), within, delays.size());
  const bool all_told = delays.front() > -1.0;
  if (!all_told) std::printf("%s: over %.2f ms before it was told to end\n", what, -delays.front());
  return delays.back() <= most && all_told;
}

/// Pillars of eight pixels on a free square.
OccupancyMap pillars(std::size_t side) {
  const std::string free(side, '.');
  std::string pillar = free;
  for (std::size_t c = 12; c + 8 < side; c += 32) pillar.replace(c, 8, "########");
  std::vector<std::string> rows(side, free);
  for (std::size_t r = 0; r < side; ++r) {
    if (r % 32 >= 12 && r % 32 < 20) rows[r] = pillar;
  }
  return test::map_from_rows(rows);
}

/// How soon searches end that are cancelled or out of time.
bool time_ends(const Settings& settings) {
  Random random(2);
  bool fine = true;
  for (const char* name : {"RRTstar", "RRTConnect", "InformedRRTstar"}) {
    const OccupancyMap map = pillars(200);
    PlanOptions options;
    options.planner = name;
    options.strategy = Strategy::uniform;
    if (std::string(name) == "RRTConnect")
      options.range = 1e-3;  // as long as it takes
    else
      options.stop = Stop::limit;
    const PlanRequest request{map, {2.0, 2.0}, {197.0, 198.0}};
    std::vector<double> cancelled;
    std::vector<double> computed;
    std::vector<double> timed;
    options.time_limit = 600.0;
    const Planner endless(nullptr, options);
    for (int i = 0; i < settings.searches; ++i) {
      const int pause = 5 + static_cast<int>(random.index(30));
      const Delay delay = delay_of_cancel(endless, request, pause);
      cancelled.push_back(delay.wall);
      computed.push_back(delay.computing);
      options.time_limit = 1e-3 * pause;
      timed.push_back(Planner(nullptr, options).plan(request).timings.plan - pause);
    }
    fine = report((std::string(name) + " cancelled").c_str(), cancelled, settings.most_delay_ms) && fine;
    report((std::string(name) + " cancelled, own computing").c_str(), computed, settings.most_delay_ms);
    fine = report((std::string(name) + " out of time").c_str(), timed, settings.most_delay_ms) && fine;
  }
  return fine;
}

/// How soon whole plans end that are cancelled at any moment, what comes before the search included.
bool plans_end(const Settings& settings, const std::shared_ptr<const RegionPredictor>& model) {
  Random random(3);
  bool fine = true;
  PlanOptions options;
  options.stop = Stop::limit;
  options.time_limit = 600.0;
  const Planner endless(model, options);
  for (const std::size_t side : {256U, 1024U, 4096U}) {
    const OccupancyMap map = pillars(side);
    const auto far = static_cast<double>(side) - 2.5;
    std::vector<double> delays;
    for (int i = 0; i < settings.searches; ++i) {
      const auto pause = static_cast<int>(random.index(10 + side / 32));
      delays.push_back(delay_of_cancel(endless, {map, {2.5, 2.5}, {far, far}}, pause).wall);
    }
    const std::string what = "a plan on a map of " + std::to_string(side) + "², cancelled";
    fine = report(what.c_str(), delays, settings.most_delay_ms) && fine;
  }
  return fine;
}

}  // namespace
}  // namespace lrrt::load

int main(int argc, char** argv) {
  lrrt::load::Settings settings;
  CLI::App app("Loads one planner and one model with many threads, and times how soon searches end.");
  app.add_option("--threads", settings.threads, "threads that plan at once")->check(CLI::Range(1, 1024));
  app.add_option("--seconds", settings.seconds, "how long they plan")->check(CLI::PositiveNumber);
  app.add_option("--searches", settings.searches, "searches of each kind to end early")->check(CLI::Range(1, 100000));
  app.add_option("--most-delay", settings.most_delay_ms, "milliseconds; a later end fails")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  lrrt::silence_ompl();
  const auto model = std::make_shared<lrrt::OnnxPredictor>();
  const bool same = lrrt::load::run_threads(settings, lrrt::load::Work(model));
  const bool in_time = lrrt::load::time_ends(settings);
  return lrrt::load::plans_end(settings, model) && in_time && same ? 0 : 1;
}
