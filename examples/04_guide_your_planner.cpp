// SPDX-License-Identifier: BSD-3-Clause
// Guide a planner of OMPL in a set-up of your own: state space, validity checks, planner and objective stay yours.
//
//     example_04_guide_your_planner [map.png]

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>

#include <cstdio>
#include <exception>
#include <memory>

#include "lrrt/io/read_map.hpp"
#include "lrrt/map/footprint.hpp"
#include "lrrt/ompl/guide.hpp"
#include "lrrt/planner.hpp"
#include "lrrt/predict/onnx_predictor.hpp"

namespace ob = ompl::base;
namespace og = ompl::geometric;

namespace {

/// The plane of a map as OMPL's state space.
std::shared_ptr<ob::RealVectorStateSpace> plane_of(const lrrt::OccupancyMap& map) {
  ob::RealVectorBounds bounds(2);
  for (unsigned int axis = 0; axis < 2; ++axis) {
    bounds.setLow(axis, map.bounds().low[axis]);
    bounds.setHigh(axis, map.bounds().high[axis]);
  }
  auto space = std::make_shared<ob::RealVectorStateSpace>(2);
  space->setBounds(bounds);
  return space;
}

void set_ends(og::SimpleSetup& setup, const Eigen::Vector2d& start, const Eigen::Vector2d& goal) {
  ob::ScopedState<ob::RealVectorStateSpace> from(setup.getStateSpace());
  ob::ScopedState<ob::RealVectorStateSpace> to(setup.getStateSpace());
  for (unsigned int axis = 0; axis < 2; ++axis) {
    from[axis] = start[axis];
    to[axis] = goal[axis];
  }
  setup.setStartAndGoalStates(from, to);
}

}  // namespace

int main(int argc, char** argv) try {
  lrrt::silence_ompl();
  const lrrt::OccupancyMap grid = lrrt::read_map(argc > 1 ? argv[1] : "python/lrrt/data/maze35.png");
  const Eigen::Vector2d start(10.5, 10.5);
  const Eigen::Vector2d goal(234.5, 234.5);
  const double robot_radius = 1.5;

  // The set-up, as ever. The library's checks are exact; your own will do.
  auto map = std::make_shared<lrrt::CollisionMap>(lrrt::inflated(grid, robot_radius));
  auto projection = std::make_shared<lrrt::PlaneProjection>();
  og::SimpleSetup setup(plane_of(grid));
  const ob::SpaceInformationPtr& si = setup.getSpaceInformation();
  setup.setStateValidityChecker(std::make_shared<lrrt::MapValidityChecker>(si, map, projection));
  si->setMotionValidator(std::make_shared<lrrt::MapMotionValidator>(si, map, projection));
  set_ends(setup, start, goal);

  auto planner = std::make_shared<og::RRTConnect>(si);
  planner->setRange(6.0);
  setup.setPlanner(planner);
  planner->setProblemDefinition(setup.getProblemDefinition());

  // The guidance: after the problem is known, before anything is set up.
  const auto region = lrrt::OnnxPredictor().predict(map->map(), start, goal).region;
  lrrt::GuideOptions options;
  options.range = 6.0;
  const auto source = lrrt::guide(*planner, map, region, options);

  const bool solved = setup.solve(ob::timedPlannerTerminationCondition(10.0)) == ob::PlannerStatus::EXACT_SOLUTION;
  const lrrt::DrawCounts draws = source->counts();
  std::printf("%s: %.1f pixels, %zu samples from the region, %zu from the whole map\n", solved ? "solved" : "no path",
              solved ? setup.getSolutionPath().length() : 0.0, draws.guided, draws.uniform);
  return solved ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "error: %s\n", error.what());
  return 2;
}
