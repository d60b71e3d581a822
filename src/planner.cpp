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
  FreeSpace space = make_free_space(request, predictor_.get(), result);
  if (const std::optional<Prepared> prepared = look(space, request, options_, result)) {
    if (predictor_) {
      result.predict_error = failure_of(options_, [&] {
        take_region(predictor_->predict(*prepared->guidance, request.start, request.goal), *prepared, request, result);
      });
    }
    search(*prepared, request, options_, result);
  }
  result.timings.total = watch.total_ms();
  return result;
}

void silence_ompl() {
  ompl::msg::setLogLevel(ompl::msg::LOG_WARN);
}

}  // namespace lrrt
