// SPDX-License-Identifier: BSD-3-Clause
#include "queries.hpp"

#include <algorithm>
#include <cmath>

#include "lrrt/map/components.hpp"
#include "lrrt/map/footprint.hpp"
#include "lrrt/map/moving_ai.hpp"
#include "lrrt/region/geodesic.hpp"
#include "maze.hpp"
#include "rival.hpp"
#include "robot.hpp"

namespace lrrt::bench {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int tries = 1000;  ///< draws before chance is said to find nothing

[[noreturn]] void refuse(const NamedMap& named, const std::string& what) {
  throw SuiteError("map '" + named.name + "': " + what);
}

[[noreturn]] void refuse_robot(const NamedMap& named) {
  refuse(named, "the robot fits nowhere: expected a smaller one, or a smaller 'scale'");
}

Pose2 at(const Eigen::Vector2d& place) {
  return {place.x(), place.y(), 0.0};
}

/// The farthest place by walking distance, or the next one where the robot fits.
Pose2 far_end(const NamedMap& named, const Ground& ground, Pixel from, Random& random) {
  const OccupancyMap& room = ground.room();
  const Geodesic ways(room.free_mask(), room.width(), room.height(), from);
  for (auto place = ways.reached().rbegin(); place != ways.reached().rend(); ++place) {
    if (const std::optional<Pose2> pose = ground.draw(*place, random)) return *pose;
  }
  refuse_robot(named);
}

std::vector<Query> farthest(const QuerySource& source, const NamedMap& named, const Ground& ground) {
  const OccupancyMap& room = ground.room();
  if (ground.has_headings()) {
    Random random(source.seed);
    const Pose2 start = far_end(named, ground, farthest_pixels(room).first, random);
    const Pixel from = OccupancyMap::pixel_of(room.to_pixel({start.x, start.y}));
    return {{"farthest", start, far_end(named, ground, from, random)}};
  }
  const bool given = named.ends && room.is_free(OccupancyMap::pixel_of(room.to_pixel(named.ends->first))) &&
                     room.is_free(OccupancyMap::pixel_of(room.to_pixel(named.ends->second)));
  if (given) return {{"farthest", at(named.ends->first), at(named.ends->second)}};
  const auto [start, goal] = farthest_pixels(room);
  return {{"farthest", at(room.center(start)), at(room.center(goal))}};
}

/// A pair at least so far apart as the crow flies; where chance finds none, the farthest one that it saw.
Query apart_pair(const NamedMap& named, const Ground& ground, const std::vector<Pixel>& pixels, double apart,
                 Random& random) {
  Query best;
  double farthest = -1.0;
  for (int k = 0; k < tries && farthest < apart; ++k) {
    const Pixel a = pixels[random.index(pixels.size())];
    const Pixel b = pixels[random.index(pixels.size())];
    const double distance = std::hypot(a.c - b.c, a.r - b.r);
    if (distance <= farthest) continue;
    const std::optional<Pose2> start = ground.draw(a, random);
    const std::optional<Pose2> goal = ground.draw(b, random);
    if (!start || !goal) continue;
    best = {"", *start, *goal};
    farthest = distance;
  }
  if (farthest < 0.0) refuse_robot(named);
  return best;
}

/// A pair at least so far apart on foot. @param least fifths of a pixel, see Geodesic.
Query far_pair(const NamedMap& named, const Ground& ground, const std::vector<Pixel>& pixels, double least,
               Random& random) {
  constexpr int starts = 50;  // each costs a flood of the map
  const OccupancyMap& room = ground.room();
  int floods = 0;
  for (int k = 0; k < tries && floods < starts; ++k) {
    const Pixel from = pixels[random.index(pixels.size())];
    const std::optional<Pose2> start = ground.draw(from, random);
    if (!start) continue;
    ++floods;
    const Geodesic ways(room.free_mask(), room.width(), room.height(), from);
    const auto first =
        std::partition_point(ways.reached().begin(), ways.reached().end(), [&](Pixel p) { return ways.at(p) < least; });
    const auto count = static_cast<std::size_t>(ways.reached().end() - first);
    for (int i = 0; i < tries && count > 0; ++i) {
      const Pixel to = first[static_cast<std::ptrdiff_t>(random.index(count))];
      if (const std::optional<Pose2> goal = ground.draw(to, random)) return {"", *start, *goal};
    }
  }
  refuse(named, "chance found no start and goal so far apart at which the robot fits: expected a smaller 'far'");
}

/// The first pair drawn, or the first between which a car can drive.
template <typename Draw>
Query drivable_pair(const NamedMap& named, const std::optional<HybridSearch>& car, const Draw& draw) {
  constexpr int pairs = 50;
  constexpr std::size_t most_poses = 200'000;  // a second or so
  for (int k = 0; k < pairs; ++k) {
    const Query query = draw();
    std::size_t tried = 0;
    const auto long_enough = [&] { return ++tried > most_poses; };
    if (!car || !car->find(query.start, query.goal, long_enough).poses.empty()) return query;
  }
  refuse(named,
         "chance found no start and goal between which the car can drive: expected a smaller robot or turning "
         "radius, a smaller 'far', or no 'drivable'");
}

std::vector<Query> random_pairs(const QuerySource& source, const NamedMap& named, const Ground& ground) {
  const OccupancyMap& room = ground.room();
  const Components components(room);
  const int label = largest_component(components);
  const std::vector<Pixel> pixels = pixels_of(components, label);
  double longest = 0.0;
  if (source.far > 0.0) {
    const Geodesic ways(room.free_mask(), room.width(), room.height(), farthest_pixels(room).first);
    longest = ways.at(ways.reached().back());
  }
  const double diagonal = std::hypot(components.box(label).width, components.box(label).height);
  Random random(source.seed);
  const auto draw = [&] {
    return source.far > 0.0 ? far_pair(named, ground, pixels, source.far * longest, random)
                            : apart_pair(named, ground, pixels, source.apart * diagonal, random);
  };
  std::optional<HybridSearch> car;
  if (!source.drivable.empty()) car.emplace(ground.car(source.drivable));
  std::vector<Query> queries;
  for (int i = 0; i < source.count; ++i) {
    queries.push_back(drivable_pair(named, car, draw));
    queries.back().name = "random #" + std::to_string(i);
  }
  return queries;
}

/// A given place with a random heading at which the robot fits, where there is one.
Pose2 with_heading(const Ground& ground, const Eigen::Vector2d& place, Random& random) {
  for (int k = 0; k < tries; ++k) {
    if (const std::optional<Pose2> pose = ground.draw(place, random)) return *pose;
  }
  return at(place);  // the planner will say that it is occupied
}

/// Problems of a scenario list, evenly spread over it: such lists are sorted by difficulty.
std::vector<Query> scenario_queries(const QuerySource& source, const NamedMap& named, const Ground& ground,
                                    const Suite& suite) {
  std::filesystem::path path = suite.resolved(source.path);
  if (source.path.empty()) path = named.file.string() + ".scen";
  const std::vector<Scenario> scenarios = read_scenarios(path);
  const std::size_t all = scenarios.size();
  if (all == 0)
    throw SuiteError(path.string() + ": holds no queries: expected at least one problem of '" + named.name + "'");
  const std::size_t wanted = source.count == 0 ? all : std::min(all, static_cast<std::size_t>(source.count));
  Random random(source.seed);
  std::vector<Query> queries;
  for (std::size_t i = 0; i < wanted; ++i) {
    const std::size_t line = wanted == 1 ? all - 1 : i * (all - 1) / (wanted - 1);
    const Scenario& s = scenarios[line];
    if (s.width != named.map->width() || s.height != named.map->height()) {
      throw SuiteError(path.string() + ": problem " + std::to_string(line) + " is for a map of " +
                       std::to_string(s.width) + "×" + std::to_string(s.height) + " pixels; expected one for " +
                       named.name + ", " + std::to_string(named.map->width()) + "×" +
                       std::to_string(named.map->height()));
    }
    queries.push_back({"scen #" + std::to_string(line), with_heading(ground, named.map->center(s.start), random),
                       with_heading(ground, named.map->center(s.goal), random)});
  }
  return queries;
}

}  // namespace

Ground::Ground(const OccupancyMap& map, const PlanSuite& suite, double scale)
    : suite_(suite), scale_(scale), room_(planning_map(map, suite, scale)) {
  const std::optional<Polygon> outline = outline_at(suite, scale);
  if (!outline) return;
  body_ = body_on(room_, *outline);
  room_ = inflated(room_, outline->inscribed_radius());
}

std::optional<Pose2> Ground::draw(const Eigen::Vector2d& place, Random& random) const {
  const Pose2 pose{place.x(), place.y(), has_headings() ? random.uniform(-pi, pi) : 0.0};
  if (body_ && !body_->is_free(pose)) return std::nullopt;
  return pose;
}

HybridSearch Ground::car(const std::string& motion) const {
  const auto drives = [&](const PlanRow& row) { return row.motion == motion; };
  const auto row = std::find_if(suite_.rows.begin(), suite_.rows.end(), drives);
  return {body_, motion_from_string(motion), row->turning_radius * scale_};
}

std::vector<Query> queries_of(const QuerySource& source, const NamedMap& named, const Ground& ground,
                              const Suite& suite) {
  const std::vector<Cell>& cells = ground.room().cells();
  const bool drawn = source.kind == QuerySource::Kind::random || source.kind == QuerySource::Kind::farthest;
  if (drawn && std::find(cells.begin(), cells.end(), Cell::free) == cells.end()) refuse_robot(named);
  switch (source.kind) {
    case QuerySource::Kind::farthest:
      break;
    case QuerySource::Kind::random:
      return random_pairs(source, named, ground);
    case QuerySource::Kind::points:
      return {{"points", source.start, source.goal}};
    case QuerySource::Kind::scen:
      return scenario_queries(source, named, ground, suite);
  }
  return farthest(source, named, ground);
}

}  // namespace lrrt::bench
