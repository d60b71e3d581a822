// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

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

double cross(const Vector2d& a, const Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// A second opinion that shares nothing with the library but the map: the robot is cut into triangles by clipping ears,
/// and every triangle is held against every pixel that is not free, the ones around the map included.
class Oracle {
 public:
  Oracle(const OccupancyMap& map, Vertices vertices) : map_(map), vertices_(std::move(vertices)) { clip_ears(); }

  bool is_free(const Pose2& pose) const { return keeps(pose, 0.0); }

  /// Whether the robot is at least this far, in pixels, from everything that is not free; at 0, whether it touches
  /// nothing.
  bool keeps(const Pose2& pose, double distance) const {
    const Vertices corners = placed(pose);
    const auto [low, high] = box(corners, distance);
    for (int r = static_cast<int>(std::floor(low.y())); r <= high.y(); ++r) {
      for (int c = static_cast<int>(std::floor(low.x())); c <= high.x(); ++c) {
        if (map_.is_free({c, r})) continue;
        if (touches(corners, c, r) || (distance > 0.0 && gap(corners, c, r) < distance)) return false;
      }
    }
    return true;
  }

 private:
  static std::pair<Vector2d, Vector2d> box(const Vertices& corners, double margin) {
    Vector2d low = corners.front();
    Vector2d high = low;
    for (const Vector2d& corner : corners) {
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
    return {low.array() - margin, high.array() + margin};
  }

  Vertices placed(const Pose2& pose) const {
    Vertices corners;
    for (const Vector2d& v : vertices_) {
      const Vector2d world(pose.x + std::cos(pose.yaw) * v.x() - std::sin(pose.yaw) * v.y(),
                           pose.y + std::sin(pose.yaw) * v.x() + std::cos(pose.yaw) * v.y());
      corners.push_back(map_.to_pixel(world));
    }
    return corners;
  }

  void clip_ears() {
    std::vector<std::size_t> left(vertices_.size());
    std::iota(left.begin(), left.end(), 0U);
    double area = 0.0;
    for (std::size_t i = 0; i < left.size(); ++i) area += cross(vertices_[i], vertices_[(i + 1) % left.size()]);
    if (area < 0.0) std::reverse(left.begin(), left.end());
    while (left.size() > 3) {
      std::size_t i = 0;
      while (i < left.size() && !is_ear(left, i)) ++i;
      ASSERT_LT(i, left.size());
      const std::size_t n = left.size();
      triangles_.push_back({left[(i + n - 1) % n], left[i], left[(i + 1) % n]});
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
    }
    triangles_.push_back({left[0], left[1], left[2]});
  }

  bool is_ear(const std::vector<std::size_t>& left, std::size_t i) const {
    const std::size_t n = left.size();
    const Vector2d& a = vertices_[left[(i + n - 1) % n]];
    const Vector2d& b = vertices_[left[i]];
    const Vector2d& c = vertices_[left[(i + 1) % n]];
    if (cross(b - a, c - b) <= 0.0) return false;
    for (const std::size_t k : left) {
      const Vector2d& p = vertices_[k];
      if (p == a || p == b || p == c) continue;
      if (cross(b - a, p - a) >= 0.0 && cross(c - b, p - b) >= 0.0 && cross(a - c, p - c) >= 0.0) return false;
    }
    return true;
  }

  /// Whether the projections of a triangle and a pixel overlap on an axis.
  static bool overlap(const Vertices& triangle, int c, int r, const Vector2d& axis) {
    double low[2] = {infinity, infinity};
    double high[2] = {-infinity, -infinity};
    for (const Vector2d& p : triangle) {
      low[0] = std::min(low[0], axis.dot(p));
      high[0] = std::max(high[0], axis.dot(p));
    }
    for (const Vector2d& p : square(c, r)) {
      low[1] = std::min(low[1], axis.dot(p));
      high[1] = std::max(high[1], axis.dot(p));
    }
    return low[0] <= high[1] && low[1] <= high[0];
  }

  static std::array<Vector2d, 4> square(int c, int r) {
    return {Vector2d(c, r), Vector2d(c + 1, r), Vector2d(c + 1, r + 1), Vector2d(c, r + 1)};
  }

  bool touches(const Vertices& corners, int c, int r) const {
    for (const auto& [i, j, k] : triangles_) {
      const Vertices triangle = {corners[i], corners[j], corners[k]};
      bool all = overlap(triangle, c, r, {1.0, 0.0}) && overlap(triangle, c, r, {0.0, 1.0});
      for (std::size_t e = 0; all && e < 3; ++e) {
        const Vector2d side = triangle[(e + 1) % 3] - triangle[e];
        all = overlap(triangle, c, r, {-side.y(), side.x()});
      }
      if (all) return true;
    }
    return false;
  }

  static double to_segment(const Vector2d& p, const Vector2d& a, const Vector2d& b) {
    const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
    return (p - a - t * (b - a)).norm();
  }

  /// Distance to a pixel that the robot does not touch.
  static double gap(const Vertices& corners, int c, int r) {
    const auto pixel = square(c, r);
    double least = infinity;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      for (std::size_t k = 0; k < 4; ++k) {
        least = std::min(least, to_segment(corners[i], pixel[k], pixel[(k + 1) % 4]));
        least = std::min(least, to_segment(pixel[k], corners[i], corners[(i + 1) % corners.size()]));
      }
    }
    return least;
  }

  const OccupancyMap& map_;
  Vertices vertices_;
  std::vector<std::array<std::size_t, 3>> triangles_;
};

/// A random map, every other one in metres with a turned frame far from zero.
OccupancyMap random_framed_map(Random& random, int i, int least_side, int most_side) {
  const OccupancyMap map = test::random_map(random, least_side, most_side);
  if (i % 2 == 0) return map;
  const Pose2 origin{random.uniform(-50.0, 50.0), random.uniform(-50.0, 50.0), random.uniform(-4.0, 4.0)};
  return {map.width(), map.height(), map.cells(), random.uniform(0.02, 3.0), origin};
}

/// A random simple polygon, seldom convex, either way round; the reference point may lie outside. @param size map
/// units.
Vertices random_vertices(Random& random, double size) {
  const std::size_t n = 3 + random.index(6);
  const Vector2d centre = size * Vector2d(random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
  Vertices vertices;
  for (std::size_t i = 0; i < n; ++i) {
    const double angle = 2.0 * pi * (static_cast<double>(i) + random.uniform(0.0, 0.8)) / static_cast<double>(n);
    vertices.push_back(centre + size * random.uniform(0.15, 1.0) * Vector2d(std::cos(angle), std::sin(angle)));
  }
  if (random.uniform() < 0.5) std::reverse(vertices.begin(), vertices.end());
  return vertices;
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
    const Polygon polygon(random_vertices(random, 3.0));
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
    const Vertices vertices = random_vertices(random, random.uniform(0.1, 10.0) * map.resolution());
    const FootprintWalk walk(map, field, Polygon(vertices));
    const Oracle oracle(map, vertices);
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
    const Vertices vertices = random_vertices(random, random.uniform(0.1, 4.0) * pixel);
    const FootprintWalk walk(map, field, Polygon(vertices));
    const Oracle oracle(map, vertices);
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
  try_motions(43, 200, [&](const Oracle& oracle, const FootprintWalk& walk, const Motion& motion, bool answer, double) {
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
              [&](const Oracle& oracle, const FootprintWalk& walk, const Motion& motion, bool answer, double pixel) {
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
    const Vertices vertices = random_vertices(random, random.uniform(0.1, 6.0) * pixel);
    const FootprintWalk walk(map, field, Polygon(vertices));
    const Oracle oracle(map, vertices);
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
      const FootprintWalk walk(*map, field, Polygon(random_vertices(random, random.uniform(0.01, 3.0))));
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
