// SPDX-License-Identifier: BSD-3-Clause
#include "query.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>
#include <utility>

#include "families.hpp"
#include "footprint_oracle.hpp"
#include "lrrt/ompl/planners.hpp"

namespace lrrt::property {
namespace {

constexpr double pi = 3.14159265358979323846;

bool with_chance(double chance, Random& random) {
  return random.uniform() < chance;
}

/// The three planners that the library vouches for, half of the time; else any that may take the motion.
std::string random_planner(Motion motion, Random& random) {
  static const std::vector<std::string> main_planners = {"RRT", "RRTConnect", "RRTstar"};
  if (with_chance(0.5, random)) return main_planners[random.index(3)];
  for (;;) {
    const std::string& name = planner_names()[random.index(planner_names().size())];
    if (motion != Motion::dubins || keeps_direction(name)) return name;
  }
}

/// Marks what it is told to: GivenRegion would refuse what is no probability, but a user's own predictor may return it.
class Marked final : public RegionPredictor {
 public:
  explicit Marked(std::vector<float> probability) : probability_(std::move(probability)) {}

  Prediction predict(const OccupancyMap& map, const Eigen::Vector2d& start,
                     const Eigen::Vector2d& goal) const override {
    const auto pixel = [&](const Eigen::Vector2d& point) { return OccupancyMap::pixel_of(map.to_pixel(point)); };
    return {PromisingRegion(map, probability_, pixel(start), pixel(goal)), {}};
  }

 private:
  std::vector<float> probability_;
};

/// An outline that holds its reference point: convex or concave.
Polygon random_outline(double size, Random& random) {
  if (with_chance(0.3, random)) {
    const double length = size * random.uniform(0.5, 2.0);
    return Polygon::rectangle(length, size * random.uniform(0.3, 1.0), length * random.uniform());
  }
  for (int i = 0; i < 50; ++i) {
    const Polygon polygon(test::random_vertices(random, size));
    if (polygon.contains({0.0, 0.0})) return polygon;
  }
  return Polygon::rectangle(size, size, 0.5 * size);
}

}  // namespace

const char* word(Motion motion) {
  return std::array{"plane", "turning", "dubins", "reeds_shepp"}.at(static_cast<std::size_t>(motion));
}

Query::Query(std::uint64_t number) {
  Random random(number);
  random.bits();  // seeds that follow one another begin alike
  // all free and all occupied, the last two, teach little
  const std::size_t most = family_names().size() - 2;
  const std::size_t kind = with_chance(0.04, random) ? most + random.index(2) : random.index(most);
  family_ = family_names()[kind];
  Cells cells = random_cells(kind, random);
  if (with_chance(0.3, random)) sprinkle_unknown(cells, random.uniform(0.0, 0.2), random);
  map_ = std::make_unique<OccupancyMap>(framed(std::move(cells), random));
  request_ = std::make_unique<PlanRequest>(PlanRequest{*map_, {0.0, 0.0}, {0.0, 0.0}});
  if (with_chance(0.5, random)) request_->unknown = UnknownIs::free;
  choose_robot(random);
  ground_ = std::make_unique<Ground>(*request_);
  choose_ends(random);
  choose_options(random);
  if (options_.strategy != Strategy::uniform) make_region(random);
}

void Query::choose_robot(Random& random) {
  const double pixel = map_->resolution();
  const bool poses = with_chance(0.5, random);
  if (poses) request_->motion = std::array{Motion::turning, Motion::dubins, Motion::reeds_shepp}.at(random.index(3));
  if (with_chance(poses ? 0.2 : 0.4, random)) request_->radius = pixel * random.uniform(0.0, 3.0);
  if (with_chance(0.05, random)) request_->radius = pixel * static_cast<double>(random.index(3));
  if (!poses) return;
  if (with_chance(0.85, random))
    request_->outline = random_outline(pixel * std::exp2(random.uniform(-2.0, 2.5)), random);
  if (request_->motion != Motion::turning) request_->turning_radius = pixel * random.uniform(0.3, 8.0);
  request_->start_heading = random.uniform(-pi, pi);
  request_->goal_heading = random.uniform(-pi, pi);
}

bool Query::fits(const Pose2& pose) const {
  const Eigen::Vector2d pixel = ground_->to_pixel({pose.x, pose.y});
  if (!ground_->grown().is_free({static_cast<int>(std::floor(pixel.x())), static_cast<int>(std::floor(pixel.y()))})) {
    return false;
  }
  return !request_->outline || test::FootprintOracle(ground_->framed(), request_->outline->vertices()).is_free(pose);
}

Eigen::Vector2d Query::random_pixel_point(Random& random) const {
  if (open_.empty() || with_chance(0.02, random)) {
    return {random.uniform(-2.0, map_->width() + 2.0), random.uniform(-2.0, map_->height() + 2.0)};
  }
  const Pixel pixel = open_[random.index(open_.size())];
  const double x = pixel.c + random.uniform();
  return {x, pixel.r + random.uniform()};
}

Pose2 Query::random_end(Random& random) const {
  const bool anywhere = with_chance(0.05, random);
  const bool lattice = with_chance(0.15, random);
  Pose2 pose;
  for (int i = 0; i < 60; ++i) {
    Eigen::Vector2d pixel = random_pixel_point(random);
    if (lattice) pixel = (pixel * 4.0).array().floor() / 4.0;
    const Eigen::Vector2d world = map_->to_world(pixel);
    pose = {world.x(), world.y(), random.uniform(-pi, pi)};
    if (anywhere || fits(pose)) break;
  }
  return pose;
}

void Query::choose_ends(Random& random) {
  const OccupancyMap& grown = ground_->grown();
  for (int i = 0; i < static_cast<int>(grown.size()); ++i) {
    const Pixel pixel{i % grown.width(), i / grown.width()};
    if (grown.is_free(pixel)) open_.push_back(pixel);
  }
  const Pose2 start = random_end(random);
  const Pose2 goal = with_chance(0.02, random) ? start : random_end(random);
  request_->start = {start.x, start.y};
  request_->goal = {goal.x, goal.y};
  if (request_->motion == Motion::plane) return;
  request_->start_heading = start.yaw;
  request_->goal_heading = goal.yaw;
}

void Query::choose_options(Random& random) {
  const double pixel = map_->resolution();
  options_.planner = random_planner(request_->motion, random);
  const bool main_planner =
      options_.planner == "RRT" || options_.planner == "RRTConnect" || options_.planner == "RRTstar";
  options_.strategy = std::array{Strategy::uniform, Strategy::region, Strategy::frontier}.at(random.index(3));
  options_.alpha = std::array{0.0, 0.3, 0.8, 0.8, 1.0}.at(random.index(5));
  if (with_chance(0.5, random)) options_.range = pixel * random.uniform(0.3, 20.0);
  options_.goal_bias = std::array{0.05, 0.05, 0.3, 1.0}.at(random.index(4));
  const bool tolerant = takes_goal_tolerance(options_.planner) && with_chance(0.1, random);
  if (tolerant) options_.goal_tolerance = pixel * random.uniform(0.0, 5.0);
  if (shortens_its_path(options_.planner)) {
    options_.stop = std::array{Stop::first, Stop::factor, Stop::limit}.at(random.index(3));
    options_.cost_factor = random.uniform(1.0, 1.5);
  }
  options_.iteration_limit = main_planner ? 1500 : 400;
  options_.time_limit = 0.2;
  options_.seed = random.bits();
  options_.keep_tree = with_chance(0.2, random);
  options_.neighbors = with_chance(0.8, random) ? Neighbors::grid : Neighbors::ompl;
  options_.simplify = with_chance(0.25, random);
}

void Query::make_region(Random& random) {
  static const std::vector<std::string> kinds = {"perfect", "empty",  "noise",       "inverted",
                                                 "full",    "broken", "not a number"};
  region_ = kinds[random.index(kinds.size())];
  const bool around = region_ == "perfect" || region_ == "inverted" || region_ == "broken";
  std::vector<float> probability(map_->size(), region_ == "full" ? 1.0F : 0.0F);
  if (region_ == "not a number")
    std::fill(probability.begin(), probability.end(), std::numeric_limits<float>::quiet_NaN());
  for (float& p : probability) {
    if (region_ == "noise") p = static_cast<float>(random.uniform());
  }
  const Eigen::Vector2d start = ground_->to_pixel(request_->start);
  const Eigen::Vector2d goal = ground_->to_pixel(request_->goal);
  if (around) {
    for (const Pixel p : shortest_way(ground_->grown(), OccupancyMap::pixel_of(start), OccupancyMap::pixel_of(goal))) {
      if (region_ == "broken" && (p.c + p.r) % 11 < 4) continue;
      for (int k = 0; k < 9; ++k) {
        const Pixel q{p.c + k % 3 - 1, p.r + k / 3 - 1};
        if (map_->contains(q)) probability[map_->index(q)] = 1.0F;
      }
    }
  }
  for (float& p : probability) {
    if (region_ == "inverted") p = 1.0F - p;
  }
  predictor_ = std::make_shared<Marked>(std::move(probability));
}

std::string Query::words() const {
  std::ostringstream text;
  text.precision(17);
  text << family_ << " of " << map_->width() << "×" << map_->height() << " at resolution " << map_->resolution()
       << ", origin " << map_->origin().x << ' ' << map_->origin().y << ' ' << map_->origin().yaw << ", "
       << word(request_->motion) << ", radius " << request_->radius << ", turning radius " << request_->turning_radius
       << ", from " << request_->start.transpose() << ' ' << request_->start_heading << " to "
       << request_->goal.transpose() << ' ' << request_->goal_heading << ", " << options_.planner << ", strategy "
       << static_cast<int>(options_.strategy) << ", region " << region_ << ", alpha " << options_.alpha << ", range "
       << options_.range << ", stop " << static_cast<int>(options_.stop) << ", tolerance " << options_.goal_tolerance
       << (options_.simplify ? ", simplified" : "");
  return text.str();
}

}  // namespace lrrt::property
