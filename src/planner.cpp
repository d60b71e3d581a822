// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/planner.hpp"

#include <ompl/util/Console.h>

#include <optional>
#include <utility>

#include "check_request.hpp"
#include "lrrt/error.hpp"
#include "lrrt/stopwatch.hpp"
#include "steps.hpp"

namespace lrrt {
namespace {

/// One step after the other, until one of them says how the plan ends.
void take_steps(const PlanRequest& request, const RegionPredictor* predictor, const PlanOptions& options,
                PlanResult& result) {
  if (given_up(request, result)) return;
  FreeSpace space = make_free_space(request, predictor, result);
  const std::optional<Prepared> prepared = look(space, request, options, result);
  if (!prepared) return;
  if (predictor != nullptr) {
    result.predict_error = failure_of(options, [&] {
      take_region(predictor->predict(*prepared->guidance, request.start, request.goal), *prepared, request, result);
    });
  }
  search(*prepared, request, options, result);
}

}  // namespace

Planner::Planner(std::shared_ptr<const RegionPredictor> predictor, PlanOptions options)
    : predictor_(std::move(predictor)), options_(std::move(options)) {
  check(options_);
  if (options_.strategy == Strategy::uniform) predictor_ = nullptr;
  if (options_.strategy != Strategy::uniform && !predictor_) {
    throw RequestError(
        "this strategy draws from a promising region and needs a predictor: give one, or choose Strategy::uniform");
  }
}

PlanResult Planner::plan(const PlanRequest& request) const {
  check(request, options_);
  PlanResult result;
  const Stopwatch watch;
  take_steps(request, predictor_.get(), options_, result);
  result.timings.total = watch.total_ms();
  return result;
}

void silence_ompl() {
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
}

}  // namespace lrrt
