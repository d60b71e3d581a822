// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/planners.hpp"

#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>

#include <map>
#include <memory>

#include "lrrt/error.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

/// OMPL seeds the generators of a process one after the other, so a planner's numbers depend on how many were made
/// before it. The generator is protected: a subclass gives each planner its own seed.
template <typename Planner>
class Seeded final : public Planner {
 public:
  Seeded(const ob::SpaceInformationPtr& si, std::uint32_t seed) : Planner(si) { this->rng_.setLocalSeed(seed); }

  std::size_t nodes() const {
    if constexpr (std::is_same_v<Planner, og::RRTConnect>) {
      return (this->tStart_ ? this->tStart_->size() : 0) + (this->tGoal_ ? this->tGoal_->size() : 0);
    } else {
      return this->nn_ ? this->nn_->size() : 0;
    }
  }
};

template <typename Planner>
MapPlanner make(const ob::SpaceInformationPtr& si, const PlannerSettings& settings) {
  const auto planner = std::make_shared<Seeded<Planner>>(si, settings.seed);
  planner->setRange(settings.range);
  if constexpr (!std::is_same_v<Planner, og::RRTConnect>) planner->setGoalBias(settings.goal_bias);
  if constexpr (std::is_same_v<Planner, og::RRTstar>) planner->setKNearest(false);
  return {planner, [raw = planner.get()] { return raw->nodes(); }};
}

using Maker = MapPlanner (*)(const ob::SpaceInformationPtr&, const PlannerSettings&);

const std::map<std::string, Maker>& makers() {
  static const std::map<std::string, Maker> table = {
      {"RRT", &make<og::RRT>},
      {"RRTConnect", &make<og::RRTConnect>},
      {"RRTstar", &make<og::RRTstar>},
  };
  return table;
}

}  // namespace

const std::vector<std::string>& planner_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const auto& entry : makers()) result.push_back(entry.first);
    return result;
  }();
  return names;
}

void check_planner_name(const std::string& name) {
  if (makers().count(name) != 0) return;
  std::string known;
  for (const std::string& entry : planner_names()) known += (known.empty() ? "" : ", ") + entry;
  throw RequestError("unknown planner '" + name + "': expected one of " + known);
}

MapPlanner make_planner(const std::string& name, const ob::SpaceInformationPtr& si, const PlannerSettings& settings) {
  check_planner_name(name);
  return makers().at(name)(si, settings);
}

}  // namespace lrrt
