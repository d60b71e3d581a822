// SPDX-License-Identifier: BSD-3-Clause
// guide() on every OMPL planner that it supports, in a set-up as a user would make it; whether samples come
// from the region is read from the planners' own graphs, not from the library's counters alone.
#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/goals/GoalState.h>
#include <ompl/base/objectives/MaximizeMinClearanceObjective.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/est/BiEST.h>
#include <ompl/geometric/planners/est/EST.h>
#include <ompl/geometric/planners/fmt/BFMT.h>
#include <ompl/geometric/planners/fmt/FMT.h>
#include <ompl/geometric/planners/informedtrees/ABITstar.h>
#include <ompl/geometric/planners/informedtrees/AITstar.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/kpiece/KPIECE1.h>
#include <ompl/geometric/planners/prm/LazyPRM.h>
#include <ompl/geometric/planners/prm/LazyPRMstar.h>
#include <ompl/geometric/planners/prm/PRM.h>
#include <ompl/geometric/planners/prm/PRMstar.h>
#include <ompl/geometric/planners/rrt/BiTRRT.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/LBTRRT.h>
#include <ompl/geometric/planners/rrt/RRT.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTXstatic.h>
#include <ompl/geometric/planners/rrt/RRTsharp.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/geometric/planners/rrt/SORRTstar.h>
#include <ompl/geometric/planners/rrt/TRRT.h>
#include <ompl/geometric/planners/sst/SST.h>
#include <ompl/util/RandomNumbers.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include "lrrt/error.hpp"
#include "lrrt/map/shortest_path.hpp"
#include "lrrt/ompl/guide.hpp"
#include "lrrt/planner.hpp"
#include "ompl/kept_states.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

/// OMPL seeds its generators by the clock; a test that passes shall pass again. Before any of them is made.
[[maybe_unused]] const bool seeded = [] {
  ompl::RNG::setSeed(1);
  return true;
}();

using Maker = std::function<ob::PlannerPtr(const ob::SpaceInformationPtr&)>;

template <typename Planner>
ob::PlannerPtr made(const ob::SpaceInformationPtr& si) {
  return std::make_shared<Planner>(si);
}

const std::map<std::string, Maker>& makers() {
  static const std::map<std::string, Maker> table = {
      {"RRT", made<og::RRT>},
      {"RRTConnect", made<og::RRTConnect>},
      {"RRTstar", made<og::RRTstar>},
      {"RRTsharp", made<og::RRTsharp>},
      {"RRTXstatic", made<og::RRTXstatic>},
      {"LBTRRT", made<og::LBTRRT>},
      {"TRRT", made<og::TRRT>},
      {"BiTRRT", made<og::BiTRRT>},
      {"InformedRRTstar", made<og::InformedRRTstar>},
      {"SORRTstar", made<og::SORRTstar>},
      {"BITstar", made<og::BITstar>},
      {"ABITstar", made<og::ABITstar>},
      {"AITstar", made<og::AITstar>},
      {"FMT", made<og::FMT>},
      {"BFMT", made<og::BFMT>},
      {"PRM", [](const ob::SpaceInformationPtr& si) { return std::make_shared<og::PRM>(si); }},
      {"PRMstar", made<og::PRMstar>},
      {"LazyPRM", [](const ob::SpaceInformationPtr& si) { return std::make_shared<og::LazyPRM>(si); }},
      {"LazyPRMstar", made<og::LazyPRMstar>},
      {"EST", made<og::EST>},
      {"BiEST", made<og::BiEST>},
      {"SST", made<og::SST>},
  };
  return table;
}

constexpr int side = 120;

/// Three walls with gaps at alternating ends; the promising region is a band of some ten pixels that passes through
/// them.
const std::vector<std::string>& slalom_rows() {
  static const std::vector<std::string> rows = [] {
    std::vector<std::string> made(side, std::string(side, '.'));
    for (int wall = 1; wall <= 3; ++wall) {
      for (int r = 0; r < side; ++r) {
        const bool gap = wall % 2 == 1 ? r >= side - 12 : r < 12;
        if (!gap) made[static_cast<std::size_t>(r)].replace(static_cast<std::size_t>(30 * wall), 3, "###");
      }
    }
    return made;
  }();
  return rows;
}

PromisingRegion band(const OccupancyMap& map) {
  const std::vector<std::uint8_t> mask = widened(map,
                                                 {{15.5, 60.5},
                                                  {25.5, 114.5},
                                                  {38.5, 114.5},
                                                  {55.5, 6.5},
                                                  {68.5, 6.5},
                                                  {85.5, 114.5},
                                                  {98.5, 114.5},
                                                  {105.5, 60.5}},
                                                 4.0);
  return {map, {mask.begin(), mask.end()}, {15, 60}, {105, 60}};
}

/// Ends a search after so many looks. PRM looks from two threads.
ob::PlannerTerminationCondition after(int looks) {
  const auto left = std::make_shared<std::atomic<int>>(looks);
  return ob::PlannerTerminationCondition([left] { return (*left)-- <= 0; });
}

/// How many looks show enough of a planner's draws. BFMT of OMPL 1.5 breaks when it is ended before it is done;
/// LazyPRM* looks seldom.
int enough(const std::string& planner) {
  if (planner == "BFMT") return 1000000;
  return planner == "LazyPRMstar" ? 600 : 1500;
}

/// How many looks suffice for a path. LBTRRT takes long for each; SST tries many ways before one reaches the goal.
int enough_for_a_path(const std::string& planner) {
  if (planner == "LBTRRT") return 3000;
  return planner == "SST" ? 1000000 : 12 * enough(planner);
}

/// A set-up as a user of OMPL makes it, but for what OMPL's planners would lose of it.
struct Scene {
  Scene() : collision(std::make_shared<CollisionMap>(test::map_from_rows(slalom_rows()))) {
    const auto space = std::make_shared<KeptStates<ob::RealVectorStateSpace>>(2U);
    space->setBounds(0.0, side);
    setup = std::make_shared<og::SimpleSetup>(space);
    const auto si = setup->getSpaceInformation();
    const auto projection = std::make_shared<PlaneProjection>();
    setup->setStateValidityChecker(std::make_shared<MapValidityChecker>(si, collision, projection));
    si->setMotionValidator(std::make_shared<MapMotionValidator>(si, collision, projection));
    ob::ScopedState<> start(space);
    ob::ScopedState<> goal(space);
    start[0] = 15.5;
    start[1] = 60.5;
    goal[0] = 105.5;
    goal[1] = 60.5;
    setup->setStartAndGoalStates(start, goal);
  }

  static ob::PlannerStatus solve(const ob::PlannerPtr& planner, int checks) {
    planner->setup();
    return planner->solve(after(checks));
  }

  std::shared_ptr<CollisionMap> collision;
  std::shared_ptr<og::SimpleSetup> setup;
};

class Guide : public testing::TestWithParam<std::string> {};

TEST_P(Guide, TheShareOfDrawsFromTheRegionIsAlpha) {
  Scene scene;
  const PromisingRegion region = band(scene.collision->map());
  const ob::PlannerPtr planner = makers().at(GetParam())(scene.setup->getSpaceInformation());
  planner->setProblemDefinition(scene.setup->getProblemDefinition());
  GuideOptions options;
  options.strategy = Strategy::region;
  options.alpha = 0.7;
  const std::shared_ptr<GuidedSource> source = guide(*planner, scene.collision, region, options);
  scene.solve(planner, enough(GetParam()));
  const DrawCounts counts = source->counts();
  const auto draws = static_cast<double>(counts.guided + counts.uniform);
  ASSERT_GT(draws, 50.0) << "the planner never asked the guided samplers";
  const double share = static_cast<double>(counts.guided) / draws;
  const bool samples_near = GetParam() == "EST" || GetParam() == "BiEST";
  if (samples_near) {
    EXPECT_GT(share, 0.3);  // where nothing promising lies near a state, any state near it has to do
    EXPECT_LT(share, 0.7 + 5.0 * std::sqrt(0.21 / draws));
  } else {
    EXPECT_NEAR(share, 0.7, 5.0 * std::sqrt(0.21 / draws));
  }
}

TEST_P(Guide, TheSamplesReallyLieInTheRegion) {
  const auto share_in_band = [](double alpha) {
    Scene scene;
    const PromisingRegion region = band(scene.collision->map());
    const ob::PlannerPtr planner = makers().at(GetParam())(scene.setup->getSpaceInformation());
    planner->setProblemDefinition(scene.setup->getProblemDefinition());
    GuideOptions options;
    options.strategy = Strategy::region;
    options.alpha = alpha;
    guide(*planner, scene.collision, region, options);
    scene.solve(planner, enough(GetParam()));
    ob::PlannerData data(scene.setup->getSpaceInformation());
    planner->getPlannerData(data);
    std::size_t inside = 0;
    for (unsigned int i = 0; i < data.numVertices(); ++i) {
      const auto* state = data.getVertex(i).getState()->as<ob::RealVectorStateSpace::StateType>();
      const Pixel p = OccupancyMap::pixel_of({state->values[0], state->values[1]});
      inside += region.mask()[scene.collision->map().index(p)];
    }
    return static_cast<double>(inside) / std::max(1U, data.numVertices());
  };
  EXPECT_GT(share_in_band(0.95), share_in_band(0.0) + 0.1);
}

TEST_P(Guide, TheFrontierSolvesTheSlalom) {
  Scene scene;
  const ob::PlannerPtr planner = makers().at(GetParam())(scene.setup->getSpaceInformation());
  planner->setProblemDefinition(scene.setup->getProblemDefinition());
  const auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(scene.setup->getSpaceInformation());
  objective->setCostThreshold(objective->infiniteCost());  // the first path will do
  scene.setup->setOptimizationObjective(objective);
  guide(*planner, scene.collision, band(scene.collision->map()));
  // AIT* of OMPL 1.5 gives up in narrow passages, EST and BiEST hardly use where samples lie: they only have to run
  const bool hopeful = GetParam() != "AITstar" && GetParam() != "EST" && GetParam() != "BiEST";
  const bool solved = static_cast<bool>(scene.solve(planner, enough_for_a_path(GetParam())));
  if (hopeful) {
    EXPECT_TRUE(solved && scene.setup->getProblemDefinition()->hasExactSolution());
  }
}

INSTANTIATE_TEST_SUITE_P(EveryPlanner, Guide, testing::ValuesIn(guidable_planners()),
                         [](const auto& info) { return info.param; });

TEST(GuideCheck, EveryPlannerOfTheListIsTested) {
  for (const std::string& name : guidable_planners()) EXPECT_EQ(makers().count(name), 1U) << name;
  EXPECT_EQ(makers().size(), guidable_planners().size());
}

TEST(GuideCheck, APlannerThatCannotBeGuidedIsRefusedByName) {
  Scene scene;
  og::KPIECE1 planner(scene.setup->getSpaceInformation());
  planner.setProblemDefinition(scene.setup->getProblemDefinition());
  try {
    guide(planner, scene.collision, band(scene.collision->map()));
    FAIL() << "KPIECE1 was guided";
  } catch (const RequestError& error) {
    EXPECT_NE(std::string(error.what()).find("KPIECE1"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("RRTstar"), std::string::npos);
  }
}

TEST(GuideCheck, TooLateOrTooEarlyIsRefused) {
  Scene scene;
  const PromisingRegion region = band(scene.collision->map());
  og::RRTstar early(scene.setup->getSpaceInformation());
  EXPECT_THROW(guide(early, scene.collision, region), RequestError);
  og::RRTstar late(scene.setup->getSpaceInformation());
  late.setProblemDefinition(scene.setup->getProblemDefinition());
  late.setup();
  EXPECT_THROW(guide(late, scene.collision, region), RequestError);
  const auto small = std::make_shared<CollisionMap>(test::map_from_rows({"..", ".."}));
  og::RRTstar wrong(scene.setup->getSpaceInformation());
  wrong.setProblemDefinition(scene.setup->getProblemDefinition());
  EXPECT_THROW(guide(wrong, small, region), RequestError);
}

TEST(GuideCheck, TheUsersObjectiveAndCallbackStay) {
  Scene scene;
  const auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(scene.setup->getSpaceInformation());
  objective->setCostThreshold(ob::Cost(1e6));
  scene.setup->setOptimizationObjective(objective);
  int calls = 0;
  scene.setup->getProblemDefinition()->setIntermediateSolutionCallback(
      [&](const ob::Planner*, const std::vector<const ob::State*>&, const ob::Cost) { ++calls; });
  const auto planner = std::make_shared<og::RRTstar>(scene.setup->getSpaceInformation());
  planner->setProblemDefinition(scene.setup->getProblemDefinition());
  guide(*planner, scene.collision, band(scene.collision->map()));
  const auto wrapped = scene.setup->getProblemDefinition()->getOptimizationObjective();
  EXPECT_DOUBLE_EQ(wrapped->getCostThreshold().value(), 1e6);
  EXPECT_EQ(wrapped->getDescription(), objective->getDescription());
  scene.solve(planner, 20000);
  EXPECT_GT(calls, 0);
}

/// An informed sampler as planners get it, with the source behind it.
struct Informed {
  explicit Informed(double goal_tolerance = 0.0) {
    scene.setup->getStateSpace()->setup();  // as planners do it, before OMPL's samplers can read states
    scene.setup->getGoal()->as<ob::GoalState>()->setThreshold(goal_tolerance);
    planner->setProblemDefinition(problem);
    GuideOptions uniform;
    uniform.alpha = 0.0;
    source = guide(*planner, scene.collision, band(scene.collision->map()), uniform);
    sampler = objective()->allocInformedStateSampler(problem, 1000);
  }
  ob::OptimizationObjectivePtr objective() const { return problem->getOptimizationObjective(); }
  /// How far it is over a drawn state, from the start to the goal.
  double detour(ob::Cost most) const {
    ob::ScopedState<> state(scene.setup->getStateSpace());
    EXPECT_TRUE(sampler->sampleUniform(state.get(), most));
    return over(state);
  }
  double detour(ob::Cost least, ob::Cost most) const {
    ob::ScopedState<> state(scene.setup->getStateSpace());
    EXPECT_TRUE(sampler->sampleUniform(state.get(), least, most));
    return over(state);
  }
  static double over(const ob::ScopedState<>& state) {
    return std::hypot(state[0] - 15.5, state[1] - 60.5) + std::hypot(state[0] - 105.5, state[1] - 60.5);
  }

  Scene scene;
  ob::ProblemDefinitionPtr problem = scene.setup->getProblemDefinition();
  ob::PlannerPtr planner = std::make_shared<og::InformedRRTstar>(scene.setup->getSpaceInformation());
  std::shared_ptr<GuidedSource> source;
  ob::InformedSamplerPtr sampler;
};

TEST(GuideCheck, InformedSamplesCoverWhatAnExtendedGoalLeaves) {
  // The way to the goal's edge is 80 long: over all states whose way to its centre is below 105 a path of 95 could go.
  Informed informed(10.0);
  double most = 0.0;
  for (int i = 0; i < 1000; ++i) most = std::max(most, informed.detour(ob::Cost(95.0)));
  EXPECT_LT(most, 105.0);
  EXPECT_GT(most, 100.0);
}

TEST(GuideCheck, LeastCostsCountFromTheGoalItself) {
  // BIT* asks so for every state: from its own bound to the goal, which knows no extent, up to any cost.
  const Informed informed(10.0);
  const ob::Cost least((1.0 - 1e-5) * 90.0);
  for (const double most : {200.0, std::numeric_limits<double>::infinity()}) {
    double nearest = most;
    for (int i = 0; i < 1000; ++i) nearest = std::min(nearest, informed.detour(least, ob::Cost(most)));
    EXPECT_LT(nearest, 95.0);
  }
  EXPECT_GT(informed.sampler->getInformedMeasure(ob::Cost(85.0)), 0.0);
}

TEST(GuideCheck, TheStraightLineEndsNoSearchForSomethingElse) {
  Scene scene;
  const auto problem = scene.setup->getProblemDefinition();
  problem->setOptimizationObjective(
      std::make_shared<ob::MaximizeMinClearanceObjective>(scene.setup->getSpaceInformation()));
  const auto planner = std::make_shared<og::RRTstar>(scene.setup->getSpaceInformation());
  planner->setProblemDefinition(problem);
  guide(*planner, scene.collision, band(scene.collision->map()));
  for (const double clearance : {0.0, 3.0, 1e3}) {
    EXPECT_FALSE(problem->getOptimizationObjective()->isSatisfied(ob::Cost(clearance)));
  }
}

TEST(GuideCheck, TheStraightLineIsTheShortestPath) {
  EXPECT_TRUE(Informed().objective()->isSatisfied(ob::Cost(90.0)));
  EXPECT_FALSE(Informed().objective()->isSatisfied(ob::Cost(90.001)));
  EXPECT_FALSE(Informed(10.0).objective()->isSatisfied(ob::Cost(90.0)));
  EXPECT_TRUE(Informed(10.0).objective()->isSatisfied(ob::Cost(80.0)));
}

TEST(GuideCheck, DrawsEndWithTheSearch) {
  // OMPL's ordered sampler draws until a state could shorten the path, and where none can it looks at no clock.
  Informed informed;
  bool over = false;
  informed.source->end_with([&] { return over; }, informed.problem->getStartState(0));
  EXPECT_GT(informed.detour(ob::Cost(200.0)), 90.0);
  over = true;
  EXPECT_EQ(informed.detour(ob::Cost(80.0)), 90.0);
  const ob::State* start = informed.problem->getStartState(0);
  const auto* goal = informed.problem->getGoal()->as<ob::GoalState>();
  EXPECT_EQ(informed.objective()->motionCostHeuristic(start, goal->getState()).value(), 0.0);
  EXPECT_EQ(informed.objective()->costToGo(start, goal).value(), 0.0);
}

TEST(GuideCheck, OtherSpacesNeedOnlyAProjection) {
  class Se2Projection final : public MapProjection {
   public:
    Eigen::Vector2d read(const ob::State* state) const override {
      const auto* s = state->as<ob::SE2StateSpace::StateType>();
      return {s->getX(), s->getY()};
    }
    void write(const Eigen::Vector2d& position, ob::State* state) const override {
      state->as<ob::SE2StateSpace::StateType>()->setXY(position.x(), position.y());
    }
  };
  const auto collision = std::make_shared<CollisionMap>(test::map_from_rows(slalom_rows()));
  const auto space = std::make_shared<ob::SE2StateSpace>();
  ob::RealVectorBounds bounds(2);
  bounds.setLow(0.0);
  bounds.setHigh(side);
  space->setBounds(bounds);
  og::SimpleSetup setup(space);
  const auto projection = std::make_shared<Se2Projection>();
  setup.setStateValidityChecker(
      std::make_shared<MapValidityChecker>(setup.getSpaceInformation(), collision, projection));
  ob::ScopedState<ob::SE2StateSpace> start(space);
  ob::ScopedState<ob::SE2StateSpace> goal(space);
  start->setXY(15.5, 60.5);
  start->setYaw(0.0);
  goal->setXY(105.5, 60.5);
  goal->setYaw(0.0);
  setup.setStartAndGoalStates(start, goal);
  const auto planner = std::make_shared<og::RRTConnect>(setup.getSpaceInformation());
  planner->setProblemDefinition(setup.getProblemDefinition());
  const auto source = guide(*planner, collision, band(collision->map()), {}, projection);
  EXPECT_TRUE(planner->solve(after(20000)));
  EXPECT_GT(source->counts().guided, 0U);
}

}  // namespace
}  // namespace lrrt
