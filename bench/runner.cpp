// SPDX-License-Identifier: BSD-3-Clause
#include "runner.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>

#include "progress.hpp"

namespace lrrt::bench {
namespace {

/// Takes jobs one after the other until there are none, one fails, or the run is cancelled.
class Worker {
 public:
  Worker(const std::vector<const Job*>& jobs, const CancelToken& cancel, ResultFile& results, Progress& progress)
      : jobs_(jobs), cancel_(cancel), results_(results), progress_(progress) {}

  void work() {
    for (std::size_t i = next_++; i < jobs_.size() && !cancel_.cancelled() && !failed_; i = next_++) {
      try {
        finish(*jobs_[i]);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (!failed_) error_ = std::current_exception();
        failed_ = true;
      }
    }
  }

  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  void finish(const Job& job) {
    Json row = {{"id", job.id}};
    row.update(job.run());
    if (cancel_.cancelled()) return;  // it may have been cut short
    results_.add(row);
    progress_.step(job.label);
  }

  const std::vector<const Job*>& jobs_;
  const CancelToken& cancel_;
  ResultFile& results_;
  Progress& progress_;
  std::atomic<std::size_t> next_{0};
  std::atomic<bool> failed_{false};
  std::exception_ptr error_;
  std::mutex mutex_;
};

}  // namespace

bool run_jobs(const std::vector<Job>& jobs, const RunOptions& options, ResultFile& results) {
  std::vector<const Job*> missing;
  for (const Job& job : jobs) {
    if (!results.has(job.id)) missing.push_back(&job);
  }
  Progress progress(jobs.size() - missing.size(), jobs.size(), options.progress);
  Worker worker(missing, options.cancel, results, progress);
  std::vector<std::thread> helpers;
  const std::size_t threads = std::min(static_cast<std::size_t>(options.threads), missing.size());
  for (std::size_t i = 1; i < threads; ++i) helpers.emplace_back([&] { worker.work(); });
  worker.work();
  for (std::thread& helper : helpers) helper.join();
  worker.rethrow();
  return !options.cancel.cancelled();
}

}  // namespace lrrt::bench
