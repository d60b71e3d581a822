// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/planners.hpp"

#include <ompl/base/PlannerData.h>
#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/prm/LazyPRMstar.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/rrt/BiTRRT.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTXstatic.h>
#include <ompl/geometric/planners/rrt/RRTsharp.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/rrt/SORRTstar.h>
#include <ompl/geometric/planners/rrt/TRRT.h>
#include <ompl/geometric/planners/sst/SST.h>

#include <map>
#include <memory>
#include <string>
#include <type_traits>

#include "directed_tree.hpp"
#include "lrrt/error.hpp"
#include "lrrt/ompl/grid_neighbors.hpp"
#include "seeded_pivots.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

template <typename Planner, typename... Bases>
constexpr bool is_a = (std::is_base_of_v<Bases, Planner> || ...);

template <typename Planner>
constexpr bool has_random_numbers =
    is_a<Planner, og::RRT, og::RRTConnect, og::RRTstar, og::RRTXstatic, og::TRRT, og::PRM, og::EST, og::BiEST, og::SST>;
template <typename Planner>
constexpr bool has_one_tree = is_a<Planner, og::RRT, og::RRTstar, og::RRTXstatic>;
template <typename Planner>
constexpr bool has_two_trees = is_a<Planner, og::RRTConnect, og::BiTRRT>;
template <typename Planner>
constexpr bool has_range = !is_a<Planner, og::BITstar, og::AITstar, og::FMT, og::PRM, og::LazyPRM>;
/// BIT* and its kin keep directions, but may draw samples without end where the least cost, a Dubins distance, is far
/// more than the straight line by which OMPL's informed sampler judges them. Informed RRT* prunes by a metric.
template <typename Planner>
constexpr bool has_directed_edges =
    !is_a<Planner, og::PRM, og::LazyPRM, og::BiEST, og::RRTXstatic, og::BITstar, og::AITstar, og::InformedRRTstar>;
template <typename Planner>
constexpr bool has_goal_bias = is_a<Planner, og::RRT, og::RRTstar, og::RRTXstatic, og::TRRT, og::EST, og::SST>;
/// AIT* takes samples that satisfy the goal for goals, and then trips over them.
template <typename Planner>
constexpr bool has_goal_regions = !is_a<Planner, og::AITstar>;

/// Leaves a space as its users expect it, however a search ends.
struct Forwards {
  ForwardSpace* space;  ///< may be null

  ~Forwards() {
    if (space != nullptr) space->set_backwards(false);
  }
};

/// OMPL seeds the generators of a process one after the other, so a planner's numbers depend on how many were made
/// before it. The generator is protected: a subclass gives each planner its own seed.
template <typename Planner>
class Seeded final : public Planner {
 public:
  Seeded(const ob::SpaceInformationPtr& si, const PlannerSettings& settings) : Planner(si) {
    if constexpr (has_random_numbers<Planner>) this->rng_.setLocalSeed(settings.seed);
    if (settings.grid) {
      use_grid(settings.range);
      use_directions();
    }
    use_seed(settings.seed);
    // OMPL 1.5 warns of its own default: the plain name is for the version that connects within a radius
    if constexpr (is_a<Planner, og::BITstar>) {
      if (this->getName().front() != 'k') this->setName("k" + this->getName());
    }
  }

  ob::PlannerStatus solve(const ob::PlannerTerminationCondition& ptc) override {
    const Forwards forwards{forward_};
    return Planner::solve(ptc);
  }

  std::size_t nodes() const {
    if constexpr (has_two_trees<Planner>) {
      return (this->tStart_ ? this->tStart_->size() : 0) + (this->tGoal_ ? this->tGoal_->size() : 0);
    } else if constexpr (has_one_tree<Planner>) {
      return this->nn_ ? this->nn_->size() : 0;
    } else if constexpr (is_a<Planner, og::BITstar>) {
      // Both of these would keep every vertex that they tell PlannerData, and with it the map, for the life of the
      // process, in one set for all threads.
      return std::stoul(this->getPlannerProgressProperties().at("current free states INTEGER")());
    } else if constexpr (is_a<Planner, og::AITstar>) {
      return this->getVerticesInReverseSearchTree().size();
    } else {
      ob::PlannerData data(this->si_);
      this->getPlannerData(data);
      return data.numVertices();
    }
  }

 private:
  /// Lets one tree of a robot that drives forwards only grow from the start, and the other one to the goal.
  void use_directions() {
    if constexpr (is_a<Planner, og::RRTConnect>) {
      forward_ = dynamic_cast<ForwardSpace*>(this->si_->getStateSpace().get());
      if (forward_ == nullptr) return;
      this->tStart_ = std::make_shared<DirectedTree<typename Planner::Motion*>>(*forward_, false);
      this->tGoal_ = std::make_shared<DirectedTree<typename Planner::Motion*>>(*forward_, true);
    }
  }

  /// Gives trees in the plane our own nearest neighbours; setup() keeps what is there.
  void use_grid(double range) {
    const auto* plane = dynamic_cast<const ob::RealVectorStateSpace*>(this->si_->getStateSpace().get());
    if (plane == nullptr || plane->getDimension() != 2) return;
    if constexpr (is_a<Planner, og::RRTConnect>) {
      this->tStart_ = std::make_shared<GridNeighbors<typename Planner::Motion*>>(plane->getBounds(), range);
      this->tGoal_ = std::make_shared<GridNeighbors<typename Planner::Motion*>>(plane->getBounds(), range);
    } else if constexpr (has_one_tree<Planner>) {
      this->nn_ = std::make_shared<GridNeighbors<typename Planner::Motion*>>(plane->getBounds(), range);
    }
  }

  /// Lets the seed decide all that is left to chance. Those of BIT* and its kin are out of reach; PRM's are for
  /// threads.
  void use_seed(std::uint64_t seed) {
    const ob::SpaceInformation& si = *this->si_;
    if constexpr (has_two_trees<Planner>) {
      seed_pivots(this->tStart_, si, seed);
      seed_pivots(this->tGoal_, si, seed);
    } else if constexpr (is_a<Planner, og::BiEST>) {
      seed_pivots(this->nnStart_, si, seed);
      seed_pivots(this->nnGoal_, si, seed);
    } else if constexpr (is_a<Planner, og::TRRT>) {
      seed_pivots(this->nearestNeighbors_, si, seed);
    } else if constexpr (is_a<Planner, og::LazyPRM>) {
      seed_pivots(this->nn_, si, seed);
      if (!this->nn_) return;  // setup() gives distances only to a structure that it has made itself
      this->nn_->setDistanceFunction([this](auto a, auto b) { return this->distanceFunction(a, b); });
    } else if constexpr (has_one_tree<Planner> || is_a<Planner, og::EST, og::FMT, og::SST>) {
      seed_pivots(this->nn_, si, seed);
    }
    if constexpr (is_a<Planner, og::SST>) seed_pivots(this->witnesses_, si, seed);
  }

  ForwardSpace* forward_ = nullptr;  ///< where use_directions() has set up two trees
};

template <typename Planner>
MapPlanner make(const ob::SpaceInformationPtr& si, const PlannerSettings& settings) {
  const auto planner = std::make_shared<Seeded<Planner>>(si, settings);
  if constexpr (has_range<Planner>) planner->setRange(settings.range);
  if constexpr (has_goal_bias<Planner>) planner->setGoalBias(settings.goal_bias);
  if constexpr (is_a<Planner, og::RRTstar, og::RRTXstatic>) planner->setKNearest(false);
  if constexpr (is_a<Planner, og::SST>) {  // OMPL's own radii are fixed lengths, whatever the unit of the map
    planner->setSelectionRadius(0.5 * settings.range);
    planner->setPruningRadius(0.25 * settings.range);
  }
  return {planner, [raw = planner.get()] { return raw->nodes(); }};
}

struct Entry {
  MapPlanner (*maker)(const ob::SpaceInformationPtr&, const PlannerSettings&);
  bool shortens;         ///< goes on after its first path to shorten it
  bool keeps_direction;  ///< checks every motion in the direction in which it is used
  bool goal_tolerance;   ///< copes with a goal that has an extent
  bool aims_at_goal;     ///< reaches the goal only because some iterations aim at it
};

template <typename Planner>
constexpr Entry describe(bool shortens) {
  return {&make<Planner>, shortens, has_directed_edges<Planner>, has_goal_regions<Planner>, has_goal_bias<Planner>};
}

const std::map<std::string, Entry>& table() {
  static const std::map<std::string, Entry> entries = {
      {"ABITstar", describe<og::ABITstar>(true)},
      {"AITstar", describe<og::AITstar>(true)},
      {"BITstar", describe<og::BITstar>(true)},
      {"BiEST", describe<og::BiEST>(false)},
      {"BiTRRT", describe<og::BiTRRT>(false)},
      {"EST", describe<og::EST>(false)},
      {"FMT", describe<og::FMT>(false)},
      {"InformedRRTstar", describe<og::InformedRRTstar>(true)},
      {"LazyPRM", describe<og::LazyPRM>(false)},
      {"LazyPRMstar", describe<og::LazyPRMstar>(true)},
      {"PRM", describe<og::PRM>(true)},
      {"PRMstar", describe<og::PRMstar>(true)},
      {"RRT", describe<og::RRT>(false)},
      {"RRTConnect", describe<og::RRTConnect>(false)},
      {"RRTXstatic", describe<og::RRTXstatic>(true)},
      {"RRTsharp", describe<og::RRTsharp>(true)},
      {"RRTstar", describe<og::RRTstar>(true)},
      {"SORRTstar", describe<og::SORRTstar>(true)},
      {"SST", describe<og::SST>(true)},
      {"TRRT", describe<og::TRRT>(false)},
  };
  return entries;
}

const Entry& entry(const std::string& name) {
  const auto found = table().find(name);
  if (found != table().end()) return found->second;
  std::string known;
  for (const std::string& each : planner_names()) known += (known.empty() ? "" : ", ") + each;
  throw RequestError("unknown planner '" + name + "': expected one of " + known);
}

}  // namespace

const std::vector<std::string>& planner_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const auto& each : table()) result.push_back(each.first);
    return result;
  }();
  return names;
}

void check_planner_name(const std::string& name) {
  entry(name);
}

bool shortens_its_path(const std::string& name) {
  return entry(name).shortens;
}

bool needs_goal_bias(const std::string& name) {
  return entry(name).aims_at_goal;
}

bool keeps_direction(const std::string& name) {
  return entry(name).keeps_direction;
}

bool takes_goal_tolerance(const std::string& name) {
  return entry(name).goal_tolerance;
}

MapPlanner make_planner(const std::string& name, const ob::SpaceInformationPtr& si, const PlannerSettings& settings) {
  return entry(name).maker(si, settings);
}

}  // namespace lrrt
