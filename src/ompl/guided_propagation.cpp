// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/guided_propagation.hpp"

#include <utility>

#include "lrrt/error.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

/// The step that was propagated last and whose result nobody has asked about yet.
struct LastStep {
  Eigen::Vector2d from = Eigen::Vector2d::Zero();  ///< pixel coordinates
  const ob::State* result = nullptr;
};

class ObservingPropagator final : public oc::StatePropagator {
 public:
  ObservingPropagator(oc::SpaceInformation* si, oc::StatePropagatorPtr inner, std::shared_ptr<GuidedSource> source,
                      std::shared_ptr<LastStep> last)
      : oc::StatePropagator(si), inner_(std::move(inner)), source_(std::move(source)), last_(std::move(last)) {}

  void propagate(const ob::State* state, const oc::Control* control, double duration,
                 ob::State* result) const override {
    *last_ = {source_->pixel_point(state), result};  // before: both states may be the same
    inner_->propagate(state, control, duration, result);
  }
  bool canPropagateBackward() const override { return inner_->canPropagateBackward(); }
  bool steer(const ob::State* from, const ob::State* to, oc::Control* control, double& duration) const override {
    return inner_->steer(from, to, control, duration);
  }
  bool canSteer() const override { return inner_->canSteer(); }

 private:
  oc::StatePropagatorPtr inner_;
  std::shared_ptr<GuidedSource> source_;
  std::shared_ptr<LastStep> last_;
};

class ObservingValidityChecker final : public ob::StateValidityChecker {
 public:
  ObservingValidityChecker(ob::SpaceInformation* si, ob::StateValidityCheckerPtr inner,
                           std::shared_ptr<GuidedSource> source, std::shared_ptr<LastStep> last)
      : ob::StateValidityChecker(si), inner_(std::move(inner)), source_(std::move(source)), last_(std::move(last)) {
    specs_ = inner_->getSpecs();
  }

  bool isValid(const ob::State* state) const override {
    const bool valid = inner_->isValid(state);
    const bool of_last_step = std::exchange(last_->result, nullptr) == state;
    if (valid && of_last_step) source_->connected(last_->from, state);
    return valid;
  }
  using ob::StateValidityChecker::isValid;
  double clearance(const ob::State* state) const override { return inner_->clearance(state); }
  double clearance(const ob::State* state, ob::State* valid, bool& available) const override {
    return inner_->clearance(state, valid, available);
  }

 private:
  ob::StateValidityCheckerPtr inner_;
  std::shared_ptr<GuidedSource> source_;
  std::shared_ptr<LastStep> last_;
};

}  // namespace

void observe_propagation(oc::SpaceInformation& si, const std::shared_ptr<GuidedSource>& source) {
  if (!si.getStatePropagator()) {
    throw RequestError("the planner's space information has no state propagator: set it, then guide the planner");
  }
  if (!si.getStateValidityChecker()) {
    si.setStateValidityChecker(std::make_shared<ob::AllValidStateValidityChecker>(&si));
  }
  const auto last = std::make_shared<LastStep>();
  si.setStatePropagator(std::make_shared<ObservingPropagator>(&si, si.getStatePropagator(), source, last));
  si.setStateValidityChecker(
      std::make_shared<ObservingValidityChecker>(&si, si.getStateValidityChecker(), source, last));
}

}  // namespace lrrt
