// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/search_space.hpp"

#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/control/PathControl.h>
#include <ompl/control/SimpleDirectedControlSampler.h>
#include <ompl/geometric/PathGeometric.h>

#include <algorithm>
#include <cmath>

#include "kept_states.hpp"

namespace lrrt {
namespace {

namespace ob = ompl::base;
namespace oc = ompl::control;
namespace og = ompl::geometric;

/// A control takes this many steps at least, and each step turns the robot by a radian at most: the durations among
/// which controls choose, and how often OMPL's planners ask whether they may go on.
constexpr double least_steps = 8.0;
/// No control turns the robot farther than twice around.
constexpr double most_turn = 12.566370614359172;
/// Controls of which planners that want to get somewhere (RRT, EST) take the one that ends nearest.
constexpr unsigned int directed_tries = 8;

ob::RealVectorBounds bounds_of(const OccupancyMap& map) {
  const Bounds box = map.bounds();
  // A hair wider, so that a point on the map's edge is not lost to the rounding of its conversion.
  const double slack = 1e-9 * map.resolution();
  ob::RealVectorBounds bounds(2);
  for (unsigned int axis = 0; axis < 2; ++axis) {
    bounds.setLow(axis, box.low[axis] - slack);
    bounds.setHigh(axis, box.high[axis] + slack);
  }
  return bounds;
}

std::shared_ptr<ob::SE2StateSpace> poses(Motion motion, double turning_radius, double reach) {
  if (motion == Motion::dubins) return std::make_shared<KeptStates<ForwardSpace>>(turning_radius);
  if (motion == Motion::reeds_shepp) return std::make_shared<KeptStates<ob::ReedsSheppStateSpace>>(turning_radius);
  auto space = std::make_shared<KeptStates<ob::SE2StateSpace>>();
  space->setSubspaceWeight(1, reach);  // OMPL's own is half a unit of length to a radian, whatever the unit
  return space;
}

/// Appends a motion to a trace, all of it but its first pose.
void append(const PoseMotion& motion, const std::vector<double>& moments, Trace& trace) {
  for (const double t : moments) {
    const Pose2 pose = motion.at(t);
    trace.points.emplace_back(pose.x, pose.y);
    trace.headings.push_back(wrapped_angle(pose.yaw));
  }
}

/// Tells paths motion by motion.
/// @param follow appends a motion to a trace, all of it but its first pose, or returns false where it is not free.
template <typename Follow>
auto teller(const std::shared_ptr<const MapProjection>& projection, const ob::OptimizationObjectivePtr& objective,
            const Follow& follow) {
  return [projection, objective, follow](const ob::Path& path) -> std::optional<Trace> {
    const auto& motions = *path.as<og::PathGeometric>();
    Trace trace;
    trace.cost = motions.cost(objective).value();
    trace.points.push_back(projection->read(motions.getState(0)));
    if (projection->has_heading()) trace.headings.push_back(projection->read_heading(motions.getState(0)));
    for (unsigned int i = 1; i < motions.getStateCount(); ++i) {
      if (!follow(motions.getState(i - 1), motions.getState(i), trace)) return std::nullopt;
    }
    return trace;
  };
}

/// Tells the motions of a pose space to a trace.
class PoseFollower {
 public:
  PoseFollower(ob::StateSpacePtr space, std::shared_ptr<const CollisionBody> body, double reach)
      : space_(std::move(space)),
        body_(std::move(body)),
        check_(*space_, body_->outline().circumscribed_radius()),
        steering_(*space_, reach) {}

  bool operator()(const ob::State* from, const ob::State* to, Trace& trace) const {
    if (body_->is_free(check_.between(from, to))) {
      tell(steering_.between(from, to), false, trace);
      return true;
    }
    // Planners that take a motion for the same both ways may have checked the way back, which may be another curve of
    // the same length.
    if (!space_->hasSymmetricInterpolate() || !body_->is_free(check_.between(to, from))) return false;
    tell(steering_.between(to, from), true, trace);
    return true;
  }

 private:
  void tell(const PoseMotion& motion, bool backwards, Trace& trace) const {
    std::vector<double> moments = motion.moments(body_->map()->map().resolution());
    if (backwards) {
      moments.pop_back();
      std::reverse(moments.begin(), moments.end());
      moments.push_back(0.0);
    }
    append(motion, moments, trace);
  }

  ob::StateSpacePtr space_;
  std::shared_ptr<const CollisionBody> body_;
  Steering check_;
  Steering steering_;
};

/// Tells the paths of a driven robot, step by step as they were planned: then its arithmetic is the same.
class ControlTeller {
 public:
  ControlTeller(std::shared_ptr<const CollisionBody> body, double reach, double step)
      : body_(std::move(body)), reach_(reach), step_(step) {}

  std::optional<Trace> operator()(const ob::Path& path) const {
    const auto& controls = *path.as<oc::PathControl>();
    Trace trace;
    Pose2 at = pose_of(controls.getState(0));
    trace.points.emplace_back(at.x, at.y);
    trace.headings.push_back(at.yaw);
    for (unsigned int i = 0; i < controls.getControlCount(); ++i) {
      const auto steps = static_cast<int>(std::lround(controls.getControlDuration(i) / step_));
      Control control = DriveControlSpace::read(controls.getControl(i), step_);
      for (int step = 0; step < steps; ++step) {
        if (!take(control, at, trace)) return std::nullopt;
      }
      control.duration = steps * step_;
      trace.controls.push_back(control);
      trace.cost += control.duration;
    }
    return trace;
  }

 private:
  bool take(const Control& control, Pose2& at, Trace& trace) const {
    if (!body_->is_free(motion_of(at, control, body_->outline().circumscribed_radius()))) return false;
    const PoseMotion motion = motion_of(at, control, reach_);
    append(motion, motion.moments(body_->map()->map().resolution()), trace);
    at = motion.at(1.0);
    at.yaw = wrapped_angle(at.yaw);
    return true;
  }

  std::shared_ptr<const CollisionBody> body_;
  double reach_;
  double step_;
};

ob::OptimizationObjectivePtr objective_for(const ob::SpaceInformationPtr& si,
                                           const std::shared_ptr<const CollisionMap>& map,
                                           const std::shared_ptr<const MapProjection>& projection,
                                           const ClearanceCost& clearance) {
  if (clearance.distance <= 0.0) return std::make_shared<ob::PathLengthOptimizationObjective>(si);
  return std::make_shared<ClearanceObjective>(si, map, projection, clearance);
}

/// How long controls last. @param range map units.
void set_durations(const Drive& drive, double range, oc::SpaceInformation& si) {
  const double longest = std::min(range / drive.speed(), most_turn / drive.top_turn_rate());
  const double steps = std::max(least_steps, std::ceil(longest * drive.top_turn_rate()));
  si.setPropagationStepSize(longest / steps);
  si.setMinMaxControlDuration(1, static_cast<unsigned int>(steps));
}

}  // namespace

SearchSpace plane_space(const std::shared_ptr<const CollisionMap>& map, const ClearanceCost& clearance,
                        const std::shared_ptr<SearchLimits>& limits) {
  const auto projection = std::make_shared<const PlaneProjection>();
  auto space = std::make_shared<KeptStates<ob::RealVectorStateSpace>>(2U);
  space->setBounds(bounds_of(map->map()));
  const auto si = std::make_shared<ob::SpaceInformation>(space);
  si->setStateValidityChecker(std::make_shared<MapValidityChecker>(si, map, projection));
  si->setMotionValidator(std::make_shared<MapMotionValidator>(si, map, projection, limits));
  si->setup();
  const auto follow = [map, projection](const ob::State* from, const ob::State* to, Trace& trace) {
    const Eigen::Vector2d first = projection->read(from);
    const Eigen::Vector2d last = projection->read(to);
    if (!map->is_free(first, last) && !map->is_free(last, first)) return false;
    trace.points.push_back(last);
    return true;
  };
  const ob::OptimizationObjectivePtr objective = objective_for(si, map, projection, clearance);
  return {map, projection, si, objective, teller(projection, objective, follow)};
}

SearchSpace pose_space(const std::shared_ptr<const CollisionMap>& map, const std::shared_ptr<const CollisionBody>& body,
                       Motion motion, double turning_radius, double reach, const ClearanceCost& clearance,
                       const std::shared_ptr<SearchLimits>& limits) {
  const std::shared_ptr<ob::SE2StateSpace> space = poses(motion, turning_radius, reach);
  space->setBounds(bounds_of(map->map()));
  const auto si = std::make_shared<ob::SpaceInformation>(space);
  si->setStateValidityChecker(std::make_shared<PoseValidityChecker>(si, body));
  si->setMotionValidator(std::make_shared<PoseMotionValidator>(si, body, limits));
  si->setup();
  const std::shared_ptr<const MapProjection> projection = projection_of(*space);
  const ob::OptimizationObjectivePtr objective = objective_for(si, map, projection, clearance);
  return {map, projection, si, objective, teller(projection, objective, PoseFollower(space, body, reach))};
}

SearchSpace drive_space(const std::shared_ptr<const CollisionMap>& map,
                        const std::shared_ptr<const CollisionBody>& body, const Drive& drive, double range,
                        double reach, std::uint32_t seed, const std::shared_ptr<SearchLimits>& limits) {
  // a radian counts as far as the robot gets while it turns that far at its best
  const auto space = std::make_shared<KeptStates<DriveSpace>>(drive.top_speed() / drive.top_turn_rate());
  space->setBounds(bounds_of(map->map()));
  const auto si = std::make_shared<oc::SpaceInformation>(
      space, std::make_shared<KeptControls<DriveControlSpace>>(space, drive, seed));
  const auto propagator = std::make_shared<DrivePropagator>(si, body, limits);
  si->setStateValidityChecker(std::make_shared<PoseValidityChecker>(si, body));
  si->setStatePropagator(propagator);
  si->setDirectedControlSamplerAllocator([](const oc::SpaceInformation* information) {
    return std::make_shared<oc::SimpleDirectedControlSampler>(information, directed_tries);
  });
  set_durations(drive, range, *si);
  si->setup();
  const double step = si->getPropagationStepSize();
  return {map,
          std::make_shared<PoseProjection>(drive.can_reverse()),
          si,
          std::make_shared<DurationObjective>(si, drive.top_speed()),
          ControlTeller(body, reach, step),
          Driver{drive, propagator}};
}

}  // namespace lrrt
