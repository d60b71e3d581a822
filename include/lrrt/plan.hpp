// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <atomic>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lrrt/map/occupancy_map.hpp"
#include "lrrt/map/polygon.hpp"
#include "lrrt/region/promising_region.hpp"
#include "lrrt/sampling/mixed_sampler.hpp"

namespace lrrt {

/// How a call of Planner::plan ended.
enum class PlanStatus {
  solved,           ///< a free path was found
  start_outside,    ///< the start lies outside the map
  goal_outside,     ///< the goal lies outside the map
  start_occupied,   ///< the robot does not fit at the start
  goal_occupied,    ///< the robot does not fit at the goal
  not_connected,    ///< no free path exists: start and goal lie in different free components
  time_limit,       ///< time ran out before a path was found
  iteration_limit,  ///< iterations ran out before a path was found
  cancelled,        ///< the caller's cancel token was set before a path was found
};

/// The status as a word, e.g. "not_connected".
const char* to_string(PlanStatus status);

/// Where the guided share of the samples comes from.
enum class Strategy {
  uniform,   ///< no guidance: conventional planning
  region,    ///< uniformly from the promising region (the paper's sampler)
  frontier,  ///< from the part of the region just ahead of the tree
};

/// @throws RequestError for an unknown word; the text lists the known ones.
Strategy strategy_from_string(const std::string& word);

/// When to stop. A time or iteration limit always ends the search too.
enum class Stop {
  first,  ///< at the first path
  /// When the cost is within PlanOptions::cost_factor of the reference, see there. For planners such as RRT*.
  factor,
  /// Only at a limit: use all of the time or the iterations to shorten the path; or once it is as short as any can be,
  /// such as a straight line (not for driven robots). For planners such as RRT*.
  limit,
};

/// @throws RequestError for an unknown word; the text lists the known ones.
Stop stop_from_string(const std::string& word);

/// What finds the nodes of a tree that are near.
enum class Neighbors {
  /// GridNeighbors for RRT, RRT-Connect, RRT* and its kin in the plane: a share of OMPL's time, and the same nodes. For
  /// RRT-Connect with Motion::dubins a second tree that grows along curves that lead to the goal, where OMPL's takes
  /// curves that lead away from it.
  grid,
  ompl,  ///< what OMPL itself takes: for comparisons with OMPL as it ships
};

/// @throws RequestError for an unknown word; the text lists the known ones.
Neighbors neighbors_from_string(const std::string& word);

/// What becomes of a plan whose prediction fails.
enum class OnPredictError {
  raise,     ///< it fails too
  unguided,  ///< it is made as with Strategy::uniform, and PlanResult::predict_error says why
};

/// @throws RequestError for an unknown word; the text lists the known ones.
OnPredictError on_predict_error_from_string(const std::string& word);

/// How the robot moves.
enum class Motion {
  plane,        ///< a point or a disc on straight lines, without a heading
  turning,      ///< straight lines on which it turns evenly, also on the spot: OMPL's SE(2)
  dubins,       ///< forwards only, on arcs of the turning radius and straight lines
  reeds_shepp,  ///< the same, forwards and backwards
  unicycle,     ///< driven by a speed and a turn rate; turns on the spot, too
  car,          ///< driven by a speed and a steering angle, which bounds the curvature
};

/// True for a robot that is planned for by its controls (Motion::unicycle and Motion::car) and not by the poses between
/// which it can move.
inline bool is_driven(Motion motion) {
  return motion == Motion::unicycle || motion == Motion::car;
}

/// @throws RequestError for an unknown word; the text lists the known ones.
Motion motion_from_string(const std::string& word);

/// What a driven robot is told to do for a while: it moves along an arc, a straight line, or turns on the spot.
struct Control {
  double speed = 0.0;      ///< map units per second; negative backwards
  double turn_rate = 0.0;  ///< radians per second, from the map's x axis towards its y axis
  double duration = 0.0;   ///< seconds
};

/// Lets another thread end a search. Copies share one flag, and a flag that was raised stays up: one token, one search.
class CancelToken {
 public:
  /// Raises the flag: the search ends within milliseconds, what comes before it within the step that it is at: a
  /// prediction, or some passes over all pixels of the map.
  void cancel() { flag_->store(true, std::memory_order_relaxed); }
  /// True once the flag was raised.
  bool cancelled() const { return flag_->load(std::memory_order_relaxed); }

 private:
  std::shared_ptr<std::atomic<bool>> flag_ = std::make_shared<std::atomic<bool>>(false);
};

/// What to plan. The map is only looked at: it must outlive the call.
struct PlanRequest {
  std::reference_wrapper<const OccupancyMap> map;  ///< where to plan
  Eigen::Vector2d start;                           ///< map units
  Eigen::Vector2d goal;                            ///< map units
  double radius = 0.0;  ///< of a disc-shaped robot, map units; 0 for a point. With an outline: a margin around it
  UnknownIs unknown = UnknownIs::occupied;  ///< whether the robot may enter unknown pixels
  CancelToken cancel{};                     ///< ends the search from another thread
  /// The robot's outline in its own frame, map units; its reference point, the origin, must lie inside or on it.
  std::optional<Polygon> outline{};
  Motion motion = Motion::plane;  ///< how the robot moves
  double turning_radius = 0.0;    ///< tightest one, map units; for Motion::dubins, Motion::reeds_shepp and Motion::car
  double start_heading = 0.0;     ///< radians from the map's x axis towards its y axis; not for Motion::plane
  double goal_heading = 0.0;      ///< the same
  double speed = 0.0;             ///< greatest one forwards, map units per second; for Motion::unicycle and Motion::car
  double reverse_speed = 0.0;     ///< greatest one backwards; 0 for a robot that only drives forwards
  double turn_rate = 0.0;         ///< greatest one, radians per second; for Motion::unicycle
};

/// How to plan.
struct PlanOptions {
  std::string planner = "RRTstar";         ///< one of planner_names()
  Strategy strategy = Strategy::frontier;  ///< where guided samples come from
  double alpha = 0.8;                      ///< share of guided samples, 0 to 1; 1 gives up completeness
  double range = 0.0;           ///< longest extension of the tree, map units; 0 chooses by the map's clearance
  double goal_bias = 0.05;      ///< share of iterations that aim at the goal (RRT and RRT*)
  double goal_tolerance = 0.0;  ///< the path may end this far from the goal, map units; 0 ends exactly there
  /// Radians: the path of a driven robot may end with its heading this far off goal_heading; π for any heading. Such a
  /// robot ends nowhere exactly: it needs a goal_tolerance too.
  double heading_tolerance = 0.25;
  /// The distance to obstacles that the path shall keep where it can, map units, measured from the robot's reference
  /// point as far as it can be from them at least: from a disc's edge, or the edge of the disc that an outline holds. 0
  /// for no wish. Planners that shorten their path follow it; see clearance_weight and PlanResult::cost.
  double clearance = 0.0;
  double clearance_weight = 3.0;  ///< how many times its own length a way right along an obstacle costs in addition
  Stop stop = Stop::first;        ///< when to stop
  /// For Stop::factor. The reference is the shortest grid path of the reference point, straightened by line of sight;
  /// with a clearance the cheapest one.
  double cost_factor = 1.05;
  double time_limit = 5.0;  ///< seconds of planning, prediction not counted
  /// Most iterations of the planner; no limit by default.
  std::size_t iteration_limit = std::numeric_limits<std::size_t>::max();
  std::uint64_t seed = 1;                 ///< same seed, same result on one thread (unless time ends the search)
  bool keep_tree = false;                 ///< return the tree's edges
  Neighbors neighbors = Neighbors::grid;  ///< in the plane a matter of time only
  bool simplify = false;                  ///< spend what is left of the time limit on shortening the path at the end
  /// A failure is every std::exception of the predictor, and a region of another size than the map's. A RequestError is
  /// none: then the request is at fault, and it is raised either way.
  OnPredictError on_predict_error = OnPredictError::raise;
};

/// Wall-clock time of each stage, milliseconds.
struct PlanTimings {
  /// Inflation, reachability, distance field; choosing a range, the reference cost, setting up OMPL.
  double prepare = 0.0;
  double encode = 0.0;  ///< see PredictTimings
  double infer = 0.0;   ///< see PredictTimings
  double region = 0.0;  ///< see PredictTimings
  double plan = 0.0;    ///< the sampling-based search
  double total = 0.0;   ///< the whole call
};

/// A shorter path found on the way.
struct CostStep {
  double time = 0.0;          ///< milliseconds since the search began
  std::size_t iteration = 0;  ///< iterations of the planner up to then
  double cost = 0.0;          ///< as PlanResult::cost
};

/// One edge of the tree, map units.
struct TreeEdge {
  Eigen::Vector2d from;  ///< one end
  Eigen::Vector2d to;    ///< the other end
};

/// What came out.
struct PlanResult {
  PlanStatus status = PlanStatus::time_limit;  ///< how the call ended
  /// Map units, from start to goal; empty unless solved. In the plane the corners of the path; else poses along the
  /// true curve, between which no point of the robot moves farther than about a pixel.
  std::vector<Eigen::Vector2d> path;
  std::vector<double> headings;  ///< radians in [-π, π), one for each point of the path; empty in the plane
  /// What drives a driven robot along the path, one after the other from the start; empty for the others.
  std::vector<Control> controls;
  /// From the path's end to the goal, map units; 0 where the path ends exactly there.
  double goal_distance = std::numeric_limits<double>::infinity();
  /// From the heading at the path's end to goal_heading, radians; 0 where the path ends exactly so.
  double goal_turn = std::numeric_limits<double>::infinity();
  /// Length of the path, map units: of its straight lines and arcs. For Motion::turning plus the angle that the robot
  /// turns times the distance from its reference point to its farthest one (at least a pixel). With
  /// PlanOptions::clearance d plus ∫ clearance_weight · max(0, 1 − c/d)² ds, where c is the clearance, see unit_cost().
  /// For a driven robot the seconds that its controls take.
  double cost = std::numeric_limits<double>::infinity();
  std::size_t iterations = 0;                     ///< iterations of the planner
  std::size_t nodes = 0;                          ///< nodes in its tree
  std::size_t motion_checks = 0;                  ///< motions that were checked for collisions
  DrawCounts draws{};                             ///< samples drawn from the region and uniformly
  std::vector<CostStep> cost_history;             ///< strictly falling costs (RRT*, SST)
  std::vector<TreeEdge> tree;                     ///< only with PlanOptions::keep_tree; straight, also for arcs
  std::shared_ptr<const PromisingRegion> region;  ///< the region that was used; on large maps in larger pixels
  std::string predict_error;  ///< why the plan was made unguided, see OnPredictError; empty when nothing failed
  double reused = 0.0;        ///< share of the path's cost that Session::replan() took over from the path before
  PlanTimings timings{};      ///< what each stage took

  /// True when a path was found.
  bool solved() const { return status == PlanStatus::solved; }
};

}  // namespace lrrt
