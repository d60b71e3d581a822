// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "footprint_oracle.hpp"
#include "lrrt/error.hpp"
#include "lrrt/map/polygon.hpp"
#include "lrrt/map/swept_footprint.hpp"
#include "support.hpp"

namespace lrrt {
namespace {

using Eigen::Vector2d;
using Vertices = std::vector<Vector2d>;

constexpr double pi = 3.14159265358979323846;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A random map, every other one in metres with a turned frame far from zero.
OccupancyMap random_framed_map(Random& random, int i, int least_side, int most_side) {
  const OccupancyMap map = test::random_map(random, least_side, most_side);
  if (i % 2 == 0) return map;
  const Pose2 origin{random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0), random.uniform(-4.0, 4.0)};
  return {map.width(), map.height(), map.cells(), random.uniform(0.02, 3.0), origin};
}

/// A pose on the map or up to two pixels beside it.
Pose2 random_pose(const OccupancyMap& map, Random& random) {
  const Vector2d at = map.to_world({random.uniform(-2.0, map.width() + 2.0), random.uniform(-2.0, map.height() + 2.0)});
  return {at.x(), at.y(), random.uniform(-10.0, 10.0)};
}

/// A motion at even speed along a straight line or an arc, and how fast any point of a robot moves in it at most.
struct Motion {
  Pose2 from;
  double length;     ///< map units
  double turn;       ///< change of heading, radians
  bool arc = false;  ///< follow the heading; else a straight line that turns on the way
  double course;     ///< of the straight line, radians

  Pose2 operator()(double t) const {
    const double yaw = from.yaw + t * turn;
    if (!arc) return {from.x + t * length * std::cos(course), from.y + t * length * std::sin(course), yaw};
    const double radius = length / turn;
    return {from.x + radius * (std::sin(yaw) - std::sin(from.yaw)),
            from.y - radius * (std::cos(yaw) - std::cos(from.yaw)), yaw};
  }
  double speed(const Polygon& robot) const { return length + robot.circumscribed_radius() * std::abs(turn); }
};

std::string refusal(const Vertices& vertices) {
  try {
    const Polygon polygon(vertices);
  } catch (const RequestError& error) {
    return error.what();
  }
  return {};
}

testing::AssertionResult names(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess();
  return testing::AssertionFailure() << '"' << text << "\" does not name \"" << part << '"';
}

TEST(Polygon, NamesWhatIsWrong) {
  EXPECT_TRUE(names(refusal({{0, 0}, {1, 0}}), "at least 3"));
  EXPECT_TRUE(names(refusal(std::vector<Eigen::Vector2d>(5000, {1, 1})), "at most 4096"));
  EXPECT_TRUE(names(refusal({{0, 0}, {1, 0}, {nan, 1}}), "vertex 2"));
  EXPECT_TRUE(names(refusal({{0, 0}, {infinity, 0}, {1, 1}}), "vertex 1"));
  EXPECT_TRUE(names(refusal({{0, 0}, {1, 0}, {1, 2e9}}), "vertex 2"));
  EXPECT_TRUE(names(refusal({{0, 0}, {1, 0}, {1, 0}, {0, 1}}), "edge 1"));
  EXPECT_TRUE(names(refusal({{0, 0}, {1, 0}, {1, 1}, {0, 0}}), "edge 3"));  // closed by hand
  EXPECT_TRUE(names(refusal({{0, 0}, {2, 2}, {2, 0}, {0, 2}}), "edge 0"));  // bow tie
  EXPECT_TRUE(names(refusal({{0, 0}, {2, 2}, {2, 0}, {0, 2}}), "edge 2"));
  EXPECT_TRUE(names(refusal({{0, 0}, {4, 0}, {4, 2}, {2, 0}, {0, 2}}), "touches edge 2"));   // a vertex on an edge
  EXPECT_TRUE(names(refusal({{0, 0}, {4, 0}, {2, 2}, {4, 4}, {0, 4}, {2, 2}}), "touches"));  // a vertex on a vertex
  EXPECT_TRUE(names(refusal({{0, 0}, {4, 0}, {4, 4}, {4, 1}, {0, 1}}), "edge 2 at (4, 4) turns back"));
  EXPECT_TRUE(names(refusal({{0, 0}, {1, 1}, {3, 3}}), "edge"));  // no area
  EXPECT_EQ(refusal({{0, 0}, {1, 0}, {2, 0}, {2, 1}}), "");       // a straight angle is fine
  EXPECT_THROW(Polygon::rectangle(0.0, 1.0, 0.0), RequestError);
  EXPECT_THROW(Polygon::rectangle(1.0, -1.0, 0.0), RequestError);
  EXPECT_THROW(Polygon::rectangle(1.0, nan, 0.0), RequestError);
  EXPECT_THROW(Polygon::rectangle(1.0, 1.0, nan), RequestError);
}

TEST(Polygon, IsStoredCounterClockwise) {
  const Vertices clockwise = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  const Vertices stored = Polygon(clockwise).vertices();
  EXPECT_EQ(stored, Vertices(clockwise.rbegin(), clockwise.rend()));
  EXPECT_EQ(Polygon(stored).vertices(), stored);
}

TEST(Polygon, RectangleHasItsReferencePointOnTheCentreLine) {
  const Polygon car = Polygon::rectangle(4.0, 2.0, 1.0);
  EXPECT_EQ(car.vertices(), (Vertices{{-1, -1}, {3, -1}, {3, 1}, {-1, 1}}));
  EXPECT_DOUBLE_EQ(car.inscribed_radius(), 1.0);
  EXPECT_DOUBLE_EQ(car.circumscribed_radius(), std::sqrt(10.0));
  EXPECT_EQ(Polygon::rectangle(4.0, 2.0, -1.0).inscribed_radius(), 0.0);  // the reference point is behind the robot
}

TEST(Polygon, DiscsHoldAndAreHeld) {
  Random random(41);
  for (int i = 0; i < 200; ++i) {
    const Polygon polygon(test::random_vertices(random, 3.0));
    EXPECT_EQ(polygon.inscribed_radius() > 0.0, polygon.contains({0.0, 0.0}));
    for (int k = 0; k < 200; ++k) {
      const Vector2d point(random.uniform(-5.0, 5.0), random.uniform(-5.0, 5.0));
      const bool inside = polygon.contains(point);
      EXPECT_TRUE(inside || point.norm() >= polygon.inscribed_radius());
      EXPECT_TRUE(!inside || point.norm() <= polygon.circumscribed_radius());
    }
    for (const Vector2d& vertex : polygon.vertices()) EXPECT_TRUE(polygon.contains(vertex));
  }
}

TEST(FootprintWalk, APoseIsFreeExactlyWhenNoTriangleTouchesABlockedPixel) {
  Random random(42);
  int free = 0;
  int blocked = 0;
  for (int i = 0; i < 1000; ++i) {
    const OccupancyMap map = random_framed_map(random, i, 3, 48);
    const DistanceField field(map);
    const Vertices vertices = test::random_vertices(random, random.uniform(0.1, 10.0) * map.resolution());
    const FootprintWalk walk(map, field, Polygon(vertices));
    const test::FootprintOracle oracle(map, vertices);
    for (int k = 0; k < 100; ++k) {
      const Pose2 pose = random_pose(map, random);
      const bool expected = oracle.is_free(pose);
      ASSERT_EQ(walk.is_free(pose), expected) << "map " << i << " at " << pose.x << ' ' << pose.y << ' ' << pose.yaw;
      ++(expected ? free : blocked);
    }
  }
  EXPECT_GT(free, 5000);
  EXPECT_GT(blocked, 5000);
}

/// Random motions with their answers: `judge` gets the oracle, the walk, the motion and the answer.
template <typename Judge>
void try_motions(std::uint64_t seed, int maps, const Judge& judge) {
  Random random(seed);
  for (int i = 0; i < maps; ++i) {
    const OccupancyMap map = random_framed_map(random, i / 2, 16, 48);
    const DistanceField field(map);
    const double pixel = map.resolution();
    const Vertices vertices = test::random_vertices(random, random.uniform(0.1, 4.0) * pixel);
    const FootprintWalk walk(map, field, Polygon(vertices));
    const test::FootprintOracle oracle(map, vertices);
    for (int k = 0; k < 40; ++k) {
      const Motion motion{random_pose(map, random), random.uniform(0.0, 12.0) * pixel, random.uniform(-2.0, 2.0),
                          k % 2 == 0, random.uniform(-pi, pi)};
      judge(oracle, walk, motion, walk.is_free(motion, motion.speed(walk.polygon())), pixel);
    }
  }
}

constexpr int moments = 2000;

TEST(FootprintWalk, AMotionCalledFreeIsFreeAtEveryMoment) {
  int free = 0;
  try_motions(
      43, 200,
      [&](const test::FootprintOracle& oracle, const FootprintWalk& walk, const Motion& motion, bool answer, double) {
        if (!answer) return;
        ++free;
        for (int k = 0; k <= moments; ++k) {
          const Pose2 pose = motion(static_cast<double>(k) / moments);
          ASSERT_TRUE(oracle.is_free(pose)) << k;
        }
        EXPECT_TRUE(walk.is_free(motion(0.0)) && walk.is_free(motion(1.0)));
      });
  EXPECT_GT(free, 100);
}

TEST(FootprintWalk, AMotionIsRefusedOnlyWhenItComesNearerThanTheTolerance) {
  int refused = 0;
  int close = 0;
  try_motions(44, 200,
              [&](const test::FootprintOracle& oracle, const FootprintWalk& walk, const Motion& motion, bool answer,
                  double pixel) {
                if (answer) return;
                ++refused;
                const double step = motion.speed(walk.polygon()) / pixel / moments;
                bool kept = true;
                bool hit = false;
                for (int k = 0; k <= moments && !hit; ++k) {
                  const Pose2 pose = motion(static_cast<double>(k) / moments);
                  hit = !oracle.is_free(pose);
                  kept = kept && !hit && oracle.keeps(pose, walk.tolerance() + step);
                }
                EXPECT_FALSE(kept);
                close += hit ? 0 : 1;
              });
  EXPECT_GT(refused, 1000);
  EXPECT_LT(close, refused / 20);
}

TEST(FootprintWalk, ABriefTouchIsNotMissed) {
  Random random(46);
  int tried = 0;
  for (int i = 0; i < 400; ++i) {
    const OccupancyMap map = random_framed_map(random, i, 24, 48);
    const DistanceField field(map);
    const double pixel = map.resolution();
    const Vertices vertices = test::random_vertices(random, random.uniform(0.1, 6.0) * pixel);
    const FootprintWalk walk(map, field, Polygon(vertices));
    const test::FootprintOracle oracle(map, vertices);
    for (int k = 0; k < 30; ++k) {
      const Pose2 home = random_pose(map, random);
      if (!oracle.is_free(home)) continue;
      const double course = random.uniform(-pi, pi);
      const double turn = k % 3 == 0 ? random.uniform(-1.0, 1.0) : 0.0;  // radians for every pixel of way
      const auto away = [&](double way) {
        return Pose2{home.x + way * pixel * std::cos(course), home.y + way * pixel * std::sin(course),
                     home.yaw + way * turn};
      };
      double free = 0.0;
      double blocked = 100.0;  // pixels: off the map
      for (int b = 0; b < 40; ++b) {
        const double middle = (free + blocked) / 2.0;
        (oracle.is_free(away(middle)) ? free : blocked) = middle;
      }
      // There and back at even speed; what is hit is hit by a thousandth of a pixel.
      const double peak = random.uniform(0.2, 0.8);
      const double way = blocked + 0.001;
      const auto motion = [&](double t) { return away(way * (t < peak ? t / peak : (1.0 - t) / (1.0 - peak))); };
      const double speed = way / std::min(peak, 1.0 - peak);
      const double reach = pixel + walk.polygon().circumscribed_radius() * std::abs(turn);
      if (oracle.is_free(motion(peak))) continue;  // a corner only grazed
      ++tried;
      ASSERT_FALSE(walk.is_free(motion, speed * reach)) << "map " << i << " motion " << k;
    }
  }
  EXPECT_GT(tried, 2000);
}

TEST(FootprintWalk, AWallOfOnePixelIsNeverJumpedOver) {
  std::vector<std::string> rows(101, std::string(301, '.'));
  for (std::string& row : rows) row[150] = '#';
  const OccupancyMap wall = test::map_from_rows(rows);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    rows[r][150] = '.';
    rows[r][100 + r] = '#';  // pixels that meet at their corners only
  }
  const OccupancyMap stairs = test::map_from_rows(rows);
  Random random(45);
  for (const OccupancyMap* map : {&wall, &stairs}) {
    const DistanceField field(*map);
    for (int i = 0; i < 2000; ++i) {
      const FootprintWalk walk(*map, field, Polygon(test::random_vertices(random, random.uniform(0.01, 3.0))));
      const Vector2d from(random.uniform(5.0, 95.0), random.uniform(5.0, 95.0));
      const Vector2d to(random.uniform(205.0, 295.0), random.uniform(5.0, 95.0));
      const Vector2d way = to - from;
      const Motion motion{{from.x(), from.y(), random.uniform(-pi, pi)},
                          way.norm(),
                          random.uniform(-7.0, 7.0),
                          false,
                          std::atan2(way.y(), way.x())};
      ASSERT_FALSE(walk.is_free(motion, motion.speed(walk.polygon()))) << i;
    }
  }
}

TEST(FootprintWalk, TouchingAPixelCountsOnEverySideAndCorner) {
  std::vector<Cell> cells(81, Cell::free);
  cells[4 * 9 + 4] = Cell::occupied;
  const OccupancyMap map(9, 9, std::move(cells));
  const DistanceField field(map);
  const FootprintWalk square(map, field, Polygon::rectangle(3.0, 3.0, 1.5));
  const FootprintWalk diamond(map, field, Polygon({{-1.5, 0}, {0, -1.5}, {1.5, 0}, {0, 1.5}}));
  for (const double x : {-1.0, 0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, 1.0}) {
      if (x == 0.0 && y == 0.0) continue;
      for (const double apart : {-1e-6, 0.0, 1e-6}) {
        const double far = 2.0 + apart;
        EXPECT_EQ(square.is_free(Pose2{4.5 + x * far, 4.5 + y * far, 0.0}), apart > 0.0) << x << ' ' << y;
        EXPECT_EQ(square.is_free(Pose2{4.5 + x * far, 4.5 + y * far, pi / 2.0}), apart > 0.0) << x << ' ' << y;
        const double corner = x * y == 0.0 ? far : 1.25 + apart;
        EXPECT_EQ(diamond.is_free(Pose2{4.5 + x * corner, 4.5 + y * corner, 0.0}), apart > 0.0) << x << ' ' << y;
      }
    }
  }
}

TEST(FootprintWalk, AForkMaySurroundAnObstacleWithoutTouchingIt) {
  const OccupancyMap map = test::map_from_rows({".........", ".........", ".........", ".........", "....#....",
                                                ".........", ".........", ".........", "........."});
  const DistanceField field(map);
  const Vertices fork = {{-1, -2}, {3, -2}, {3, -1}, {0, -1}, {0, 1}, {3, 1}, {3, 2}, {-1, 2}};
  const FootprintWalk walk(map, field, Polygon(fork));
  EXPECT_TRUE(walk.is_free(Pose2{3.5, 4.5, 0.0}));   // the pixel stands between the prongs
  EXPECT_FALSE(walk.is_free(Pose2{4.0, 4.5, 0.0}));  // the fork's bottom touches it
  EXPECT_FALSE(walk.is_free(Pose2{3.5, 5.0, 0.0}));  // a prong touches it
  const FootprintWalk hull(map, field, Polygon({{-1, -2}, {3, -2}, {3, 2}, {-1, 2}}));
  EXPECT_FALSE(hull.is_free(Pose2{3.5, 4.5, 0.0}));  // inside, and far from every edge
  EXPECT_FALSE(hull.is_free([](double t) { return Pose2{2.2 + 0.1 * t, 4.5, 0.0}; }, 0.1));
  const auto drive = [](double t) { return Pose2{1.5 + 2.0 * t, 4.5, 0.0}; };
  EXPECT_TRUE(walk.is_free(drive, 2.0));
  const auto turn = [](double t) { return Pose2{3.5, 4.5, t * pi}; };
  EXPECT_FALSE(walk.is_free(turn, pi * walk.polygon().circumscribed_radius()));
}

TEST(FootprintWalk, HeadingsTurnFromTheXAxisToTheYAxis) {
  std::vector<Cell> cells(81, Cell::free);
  cells[7 * 9 + 4] = Cell::occupied;  // below the middle
  const Polygon pointer = Polygon::rectangle(3.4, 0.5, 0.2);
  const OccupancyMap plain(9, 9, cells);
  const DistanceField plain_field(plain);
  const FootprintWalk picture(plain, plain_field, pointer);
  EXPECT_FALSE(picture.is_free(Pose2{4.5, 4.5, pi / 2.0}));
  EXPECT_TRUE(picture.is_free(Pose2{4.5, 4.5, -pi / 2.0}));
  const OccupancyMap metres(9, 9, cells, 1.0, {});
  const DistanceField metres_field(metres);
  const FootprintWalk metric(metres, metres_field, pointer);
  EXPECT_TRUE(metric.is_free(Pose2{4.5, 4.5, pi / 2.0}));
  EXPECT_FALSE(metric.is_free(Pose2{4.5, 4.5, -pi / 2.0}));
}

TEST(FootprintWalk, TheRobotMayNotLeaveTheMap) {
  const OccupancyMap map(20, 10, std::vector<Cell>(200, Cell::free), 0.1, {5.0, 5.0, 0.0});
  const DistanceField field(map);
  const FootprintWalk walk(map, field, Polygon::rectangle(0.6, 0.4, 0.1));
  EXPECT_TRUE(walk.is_free(Pose2{5.11, 5.5, 0.0}));
  EXPECT_FALSE(walk.is_free(Pose2{5.1, 5.5, 0.0}));  // its rear on the border
  EXPECT_FALSE(walk.is_free(Pose2{5.05, 5.5, 0.0}));
  EXPECT_FALSE(walk.is_free(Pose2{6.8, 5.5, 0.0}));
  EXPECT_TRUE(walk.is_free(Pose2{6.8, 5.5, pi}));
  EXPECT_FALSE(walk.is_free(Pose2{0.0, 0.0, 0.0}));
  const auto out_and_back = [](double t) { return Pose2{6.0, 5.3 + 1.2 * t * (1.0 - t) * 2.0, 0.0}; };
  EXPECT_FALSE(walk.is_free(out_and_back, 2.4));
  const FootprintWalk larger_than_the_map(map, field, Polygon::rectangle(50.0, 50.0, 25.0));
  EXPECT_FALSE(larger_than_the_map.is_free(Pose2{6.0, 5.5, 0.0}));
}

TEST(FootprintWalk, StandingStillIsAMotion) {
  const OccupancyMap map = test::map_from_rows({"....#", "....#", "....#"});
  const DistanceField field(map);
  const FootprintWalk walk(map, field, Polygon::rectangle(1.0, 1.0, 0.5));
  EXPECT_TRUE(walk.is_free([](double) { return Pose2{2.0, 1.5, 0.0}; }, 0.0));
  EXPECT_FALSE(walk.is_free([](double) { return Pose2{3.5, 1.5, 0.0}; }, 0.0));
}

TEST(FootprintWalk, NonsenseIsNotFreeOrRefused) {
  const OccupancyMap map(100, 100, std::vector<Cell>(10000, Cell::free));
  const DistanceField field(map);
  for (const double rear : {0.5, -3.0}) {  // the reference point inside the robot and behind it
    const FootprintWalk walk(map, field, Polygon::rectangle(1.0, 1.0, rear));
    for (const double bad : {nan, infinity, -infinity, 1e300}) {
      EXPECT_FALSE(walk.is_free(Pose2{bad, 50.0, 0.0}));
      EXPECT_FALSE(walk.is_free(Pose2{50.0, bad, 0.0}));
      EXPECT_EQ(walk.is_free(Pose2{50.0, 50.0, bad}), std::abs(bad) == 1e300);
      EXPECT_FALSE(walk.is_free([](double) { return Pose2{50.0, 50.0, 0.0}; }, bad));
    }
    EXPECT_FALSE(walk.is_free([](double) { return Pose2{50.0, 50.0, 0.0}; }, -1.0));
  }
  const Polygon robot = Polygon::rectangle(1.0, 1.0, 0.5);
  for (const double tolerance : {0.0, -1.0, 2.0, nan})
    EXPECT_THROW(FootprintWalk(map, field, robot, tolerance), RequestError);
  EXPECT_THROW(FootprintWalk(test::map_from_rows({"..", ".."}), field, robot), RequestError);
}

}  // namespace
}  // namespace lrrt
