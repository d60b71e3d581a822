// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/control_planners.hpp"

#include <ompl/base/ProblemDefinition.h>
#include <ompl/control/planners/est/EST.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/planners/sst/SST.h>

#include <limits>
#include <map>
#include <memory>
#include <type_traits>

#include "lrrt/error.hpp"
#include "seeded_pivots.hpp"

namespace lrrt {
namespace {

namespace oc = ompl::control;

/// As for the planners without controls: a subclass gives each planner its own seed.
template <typename Planner>
class Seeded final : public Planner {
 public:
  Seeded(const oc::SpaceInformationPtr& si, const PlannerSettings& settings) : Planner(si) {
    this->rng_.setLocalSeed(settings.seed);
    this->setGoalBias(settings.goal_bias);
    if constexpr (std::is_same_v<Planner, oc::EST>) this->setRange(settings.range);
    if constexpr (std::is_same_v<Planner, oc::SST>) {  // OMPL's own radii are fixed lengths, whatever the map's unit
      this->setSelectionRadius(0.5 * settings.range);
      this->setPruningRadius(0.25 * settings.range);
      seed_pivots(this->witnesses_, *si, settings.seed);
    }
    if constexpr (!std::is_same_v<Planner, oc::EST>) seed_pivots(this->nn_, *si, settings.seed);
  }

  std::size_t nodes() const {
    if constexpr (std::is_same_v<Planner, oc::EST>) {
      return this->tree_.size;
    } else {
      return this->nn_ ? this->nn_->size() : 0;
    }
  }

  /// SST of OMPL 1.5 tells nobody of the paths that it finds on the way.
  void announce() {
    if constexpr (std::is_same_v<Planner, oc::SST>) {
      if (!(this->prevSolutionCost_.value() < announced_)) return;
      announced_ = this->prevSolutionCost_.value();
      const auto& tell = this->pdef_->getIntermediateSolutionCallback();
      if (tell) tell(this, {this->prevSolution_.begin(), this->prevSolution_.end()}, this->prevSolutionCost_);
    }
  }

 private:
  double announced_ = std::numeric_limits<double>::infinity();
};

template <typename Planner>
MapPlanner make(const oc::SpaceInformationPtr& si, const PlannerSettings& settings) {
  const auto planner = std::make_shared<Seeded<Planner>>(si, settings);
  return {planner, [raw = planner.get()] { return raw->nodes(); }, [raw = planner.get()] { raw->announce(); }};
}

using Maker = MapPlanner (*)(const oc::SpaceInformationPtr&, const PlannerSettings&);

const std::map<std::string, Maker>& table() {
  static const std::map<std::string, Maker> makers = {
      {"EST", &make<oc::EST>}, {"RRT", &make<oc::RRT>}, {"SST", &make<oc::SST>}};
  return makers;
}

}  // namespace

const std::vector<std::string>& control_planner_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const auto& each : table()) result.push_back(each.first);
    return result;
  }();
  return names;
}

void check_control_planner_name(const std::string& name) {
  if (table().count(name) != 0) return;
  std::string known;
  for (const std::string& each : control_planner_names()) known += (known.empty() ? "" : ", ") + each;
  throw RequestError("planner " + name + " cannot plan by controls, as a driven robot needs it (Motion::unicycle, " +
                     "Motion::car): expected one of " + known);
}

MapPlanner make_control_planner(const std::string& name, const oc::SpaceInformationPtr& si,
                                const PlannerSettings& settings) {
  check_control_planner_name(name);
  return table().at(name)(si, settings);
}

}  // namespace lrrt
