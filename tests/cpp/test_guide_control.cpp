// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <ompl/base/ScopedState.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/SE2StateSpace.h>
#include <ompl/control/PathControl.h>
#include <ompl/control/SimpleSetup.h>
#include <ompl/control/planners/kpiece/KPIECE1.h>
#include <ompl/control/planners/pdst/PDST.h>
#include <ompl/control/planners/rrt/RRT.h>
#include <ompl/control/planners/sst/SST.h>
#include <ompl/control/spaces/RealVectorControlSpace.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>

#include "lrrt/error.hpp"
#include "lrrt/map/shortest_path.hpp"
#include "lrrt/ompl/guide.hpp"
#include "lrrt/ompl/map_validity.hpp"
#include "ompl/kept_states.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;

constexpr int side = 90;

/// Two walls with gaps at alternating ends.
OccupancyMap slalom() {
  std::vector<std::string> rows(side, std::string(side, '.'));
  for (std::size_t r = 0; r < side; ++r) {
    if (r < side - 14) rows[r].replace(28, 3, "###");
    if (r >= 14) rows[r].replace(58, 3, "###");
  }
  return test::map_from_rows(rows);
}

PromisingRegion band(const OccupancyMap& map) {
  const std::vector<std::uint8_t> mask =
      widened(map, {{10.5, 40.5}, {22.5, 83.5}, {36.5, 83.5}, {52.5, 7.5}, {66.5, 7.5}, {79.5, 45.5}}, 5.0);
  return {map, {mask.begin(), mask.end()}, {10, 40}, {79, 45}};
}

/// Poses, or poses and a speed: a state space of a user's own, of which the library knows nothing.
using SpeedState = ob::CompoundStateSpace::StateType;

const ob::SE2StateSpace::StateType* pose_in(const ob::State* state) {
  return state->as<SpeedState>()->as<ob::SE2StateSpace::StateType>(0);
}

class SpeedProjection final : public MapProjection {
 public:
  Eigen::Vector2d read(const ob::State* state) const override {
    return {pose_in(state)->getX(), pose_in(state)->getY()};
  }
  void write(const Eigen::Vector2d& position, ob::State* state) const override {
    state->as<SpeedState>()->as<ob::SE2StateSpace::StateType>(0)->setXY(position.x(), position.y());
  }
  bool has_heading() const override { return true; }
  double read_heading(const ob::State* state) const override { return pose_in(state)->getYaw(); }
  void write_heading(double angle, ob::State* state) const override {
    state->as<SpeedState>()->as<ob::SE2StateSpace::StateType>(0)->setYaw(wrapped_angle(angle));
  }
  bool can_reverse() const override { return false; }
};

void move(double speed, double turn_rate, double time, const ob::SE2StateSpace::StateType* from,
          ob::SE2StateSpace::StateType* to) {
  const double yaw = from->getYaw() + 0.5 * turn_rate * time;
  to->setXY(from->getX() + speed * time * std::cos(yaw), from->getY() + speed * time * std::sin(yaw));
  to->setYaw(wrapped_angle(from->getYaw() + turn_rate * time));
}

/// A set-up as a user of OMPL makes it, but for what SST would lose of it: a car by its speed and turn rate, or, with
/// dynamics, by its acceleration.
struct Scene {
  explicit Scene(bool dynamic = false) : collision(std::make_shared<CollisionMap>(slalom())) {
    const auto poses = std::make_shared<KeptStates<ob::SE2StateSpace>>();
    ob::RealVectorBounds bounds(2);
    bounds.setLow(0.0);
    bounds.setHigh(side);
    poses->setBounds(bounds);
    ob::StateSpacePtr space = poses;
    projection = std::make_shared<PoseProjection>(false);
    if (dynamic) {
      const auto speeds = std::make_shared<ob::RealVectorStateSpace>(1);
      speeds->setBounds(0.0, 4.0);
      const auto both = std::make_shared<KeptStates<ob::CompoundStateSpace>>();
      both->addSubspace(poses, 1.0);
      both->addSubspace(speeds, 0.1);
      space = both;
      projection = std::make_shared<SpeedProjection>();
    }
    const auto controls = std::make_shared<KeptControls<oc::RealVectorControlSpace>>(space, 2);
    ob::RealVectorBounds limits(2);
    limits.setLow(0, dynamic ? -1.0 : 1.0);
    limits.setHigh(0, dynamic ? 1.0 : 4.0);
    limits.setLow(1, -0.5);
    limits.setHigh(1, 0.5);
    controls->setBounds(limits);
    setup = std::make_shared<oc::SimpleSetup>(controls);
    const auto si = setup->getSpaceInformation();
    setup->setStateValidityChecker([this, dynamic](const ob::State* state) {
      const double speed =
          dynamic ? state->as<SpeedState>()->as<ob::RealVectorStateSpace::StateType>(1)->values[0] : 0.0;
      return collision->is_free(projection->read(state)) && speed >= 0.0 && speed <= 4.0;
    });
    setup->setStatePropagator(
        [dynamic](const ob::State* state, const oc::Control* control, double time, ob::State* result) {
          const double* values = control->as<oc::RealVectorControlSpace::ControlType>()->values;
          if (!dynamic) {
            move(values[0], values[1], time, state->as<ob::SE2StateSpace::StateType>(),
                 result->as<ob::SE2StateSpace::StateType>());
            return;
          }
          const double speed = state->as<SpeedState>()->as<ob::RealVectorStateSpace::StateType>(1)->values[0];
          move(speed, values[1], time, pose_in(state), result->as<SpeedState>()->as<ob::SE2StateSpace::StateType>(0));
          result->as<SpeedState>()->as<ob::RealVectorStateSpace::StateType>(1)->values[0] = speed + values[0] * time;
        });
    si->setPropagationStepSize(0.25);
    si->setMinMaxControlDuration(1, 10);
    ob::ScopedState<> start(space);
    ob::ScopedState<> goal(space);
    for (unsigned int i = 0; i < (dynamic ? 4U : 3U); ++i) start[i] = goal[i] = 0.0;
    start[0] = 10.5;
    start[1] = 40.5;
    goal[0] = 79.5;
    goal[1] = 45.5;
    setup->setStartAndGoalStates(start, goal, 6.0);
  }

  ob::PlannerStatus solve(const ob::PlannerPtr& planner, int looks) const {
    planner->setup();
    const auto left = std::make_shared<int>(looks);
    return planner->solve(ob::PlannerTerminationCondition([left] { return (*left)-- <= 0; }));
  }

  std::shared_ptr<CollisionMap> collision;
  std::shared_ptr<const MapProjection> projection;
  std::shared_ptr<oc::SimpleSetup> setup;
};

using Maker = std::function<ob::PlannerPtr(const oc::SpaceInformationPtr&)>;

/// OMPL's radii are for spaces of side 1 or so.
ob::PlannerPtr make_sst(const oc::SpaceInformationPtr& si) {
  const auto planner = std::make_shared<oc::SST>(si);
  planner->setSelectionRadius(3.0);
  planner->setPruningRadius(1.5);
  return planner;
}

const std::map<std::string, Maker>& makers() {
  static const std::map<std::string, Maker> table = {
      {"SST", make_sst}, {"RRT", [](const oc::SpaceInformationPtr& si) { return std::make_shared<oc::RRT>(si); }}};
  return table;
}

class GuideControl : public testing::TestWithParam<std::string> {};

TEST_P(GuideControl, TheShareOfDrawsFromTheRegionIsAlpha) {
  const Scene scene;
  const ob::PlannerPtr planner = makers().at(GetParam())(scene.setup->getSpaceInformation());
  planner->setProblemDefinition(scene.setup->getProblemDefinition());
  const std::shared_ptr<GuidedSource> source =
      guide(*planner, scene.collision, band(scene.collision->map()), {Strategy::region, 0.7});
  scene.solve(planner, 1000);
  const auto draws = static_cast<double>(source->counts().guided + source->counts().uniform);
  ASSERT_GT(draws, 100.0);
  EXPECT_NEAR(static_cast<double>(source->counts().guided) / draws, 0.7, 5.0 * std::sqrt(0.21 / draws));
}

TEST_P(GuideControl, TheSamplesReallyLieInTheRegion) {
  const Scene scene;
  const PromisingRegion region = band(scene.collision->map());
  const ob::PlannerPtr planner = makers().at(GetParam())(scene.setup->getSpaceInformation());
  planner->setProblemDefinition(scene.setup->getProblemDefinition());
  guide(*planner, scene.collision, region, {Strategy::region, 1.0});
  planner->setup();
  const ob::StateSamplerPtr sampler = scene.setup->getSpaceInformation()->allocStateSampler();
  ob::ScopedState<> state(scene.setup->getStateSpace());
  for (int i = 0; i < 500; ++i) {
    sampler->sampleUniform(state.get());
    const Pixel pixel = OccupancyMap::pixel_of(scene.projection->read(state.get()));
    EXPECT_EQ(region.mask()[scene.collision->map().index(pixel)], 1);
  }
}

TEST_P(GuideControl, TheFrontierSolvesTheSlalom) {
  for (const bool dynamic : {false, true}) {
    const Scene scene(dynamic);
    const ob::PlannerPtr planner = makers().at(GetParam())(scene.setup->getSpaceInformation());
    planner->setProblemDefinition(scene.setup->getProblemDefinition());
    const ob::ProblemDefinitionPtr problem = scene.setup->getProblemDefinition();
    const auto objective = std::make_shared<ob::PathLengthOptimizationObjective>(scene.setup->getSpaceInformation());
    objective->setCostThreshold(objective->infiniteCost());  // the first path will do
    problem->setOptimizationObjective(objective);
    guide(*planner, scene.collision, band(scene.collision->map()), {}, scene.projection);
    EXPECT_TRUE(scene.solve(planner, dynamic ? 60000 : 20000) && problem->hasExactSolution()) << dynamic;
    EXPECT_TRUE(problem->getSolutionPath()->as<oc::PathControl>()->check());
  }
}

INSTANTIATE_TEST_SUITE_P(ControlPlanners, GuideControl, testing::Values("SST", "RRT"),
                         [](const auto& info) { return info.param; });

/// Mean column of guided draws.
double mean_column(const Scene& scene) {
  const ob::StateSamplerPtr sampler = scene.setup->getStateSpace()->allocStateSampler();
  ob::ScopedState<> state(scene.setup->getStateSpace());
  double sum = 0.0;
  for (int i = 0; i < 40; ++i) {
    sampler->sampleUniform(state.get());
    sum += scene.projection->read(state.get()).x();
  }
  return sum / 40.0;
}

TEST(GuideControlCheck, TheFrontierFollowsWhatIsPropagated) {
  const Scene scene;
  const oc::SpaceInformationPtr si = scene.setup->getSpaceInformation();
  const ob::PlannerPtr planner = make_sst(si);
  planner->setProblemDefinition(scene.setup->getProblemDefinition());
  guide(*planner, scene.collision, band(scene.collision->map()), {Strategy::frontier, 1.0, 6.0});
  planner->setup();
  EXPECT_LT(mean_column(scene), 25.0);
  // along row 83 through the first gap, beginning where the tree does not know the way: nothing is followed
  ob::ScopedState<ob::SE2StateSpace> state(scene.setup->getStateSpace());
  oc::Control* control = si->allocControl();
  auto* values = control->as<oc::RealVectorControlSpace::ControlType>()->values;
  values[0] = 4.0;
  values[1] = 0.0;
  const auto drive = [&](double x, double y, double yaw, int steps) {
    state->setXY(x, y);
    state->setYaw(yaw);
    return si->propagateWhileValid(state.get(), control, steps, state.get());
  };
  EXPECT_EQ(drive(20.5, 83.5, 0.0, 20), 20U);
  EXPECT_LT(mean_column(scene), 25.0);
  // from the start into the wall: the steps before it count, the one that ends in it does not
  EXPECT_LT(drive(10.5, 40.5, 0.0, 40), 18U);
  EXPECT_LT(mean_column(scene), 28.0);
  // from the start down the room and then through the gap: pixel after pixel that the tree knows
  drive(10.5, 40.5, 1.5707963267948966, 43);
  EXPECT_EQ(drive(state->getX(), state->getY(), 0.0, 30), 30U);
  EXPECT_GT(mean_column(scene), 33.0);
  si->freeControl(control);
}

TEST(GuideControlCheck, PlannersWithoutSamplesAreRefusedByName) {
  const Scene scene;
  for (const ob::PlannerPtr& planner :
       {ob::PlannerPtr(std::make_shared<oc::KPIECE1>(scene.setup->getSpaceInformation())),
        ob::PlannerPtr(std::make_shared<oc::PDST>(scene.setup->getSpaceInformation()))}) {
    planner->setProblemDefinition(scene.setup->getProblemDefinition());
    try {
      guide(*planner, scene.collision, band(scene.collision->map()));
      FAIL() << planner->getName() << " was guided";
    } catch (const RequestError& error) {
      EXPECT_NE(std::string(error.what()).find(planner->getName()), std::string::npos);
      EXPECT_NE(std::string(error.what()).find("SST"), std::string::npos);
    }
  }
}

TEST(GuideControlCheck, APropagatorIsNeeded) {
  const Scene scene;
  const auto space = scene.setup->getStateSpace();
  const auto si = std::make_shared<oc::SpaceInformation>(space, scene.setup->getControlSpace());
  const auto problem = std::make_shared<ob::ProblemDefinition>(si);
  problem->addStartState(scene.setup->getProblemDefinition()->getStartState(0));
  problem->setGoal(scene.setup->getProblemDefinition()->getGoal());
  oc::RRT planner(si);
  planner.setProblemDefinition(problem);
  EXPECT_THROW(guide(planner, scene.collision, band(scene.collision->map())), RequestError);
}

}  // namespace
}  // namespace lrrt
