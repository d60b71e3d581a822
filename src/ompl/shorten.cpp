// SPDX-License-Identifier: BSD-3-Clause
#include "lrrt/ompl/shorten.hpp"

#include <ompl/base/SpaceInformation.h>
#include <ompl/geometric/PathSimplifier.h>

namespace lrrt {
namespace {

namespace og = ompl::geometric;

/// Rounds that shorten a path by less than this share bring nothing; so many of them in a row end it.
constexpr double worthwhile = 1e-3;
constexpr int most_idle_rounds = 3;

/// OMPL seeds the generators of a process one after the other; a subclass gives this one its own seed.
class SeededSimplifier final : public og::PathSimplifier {
 public:
  SeededSimplifier(const ompl::base::SpaceInformationPtr& si, std::uint32_t seed) : og::PathSimplifier(si) {
    rng_.setLocalSeed(seed);
  }
};

}  // namespace

void shorten(og::PathGeometric& path, const ompl::base::PlannerTerminationCondition& stop, std::uint32_t seed) {
  const ompl::base::SpaceInformationPtr& si = path.getSpaceInformation();
  // OMPL tries shortcuts between points of motions in either direction
  const bool both_ways = si->getStateSpace()->hasSymmetricInterpolate();
  SeededSimplifier simplifier(si, seed);
  for (int idle = 0; idle < most_idle_rounds && !stop();) {
    const double before = path.length();
    simplifier.reduceVertices(path);
    if (both_ways) simplifier.shortcutPath(path);
    idle = path.length() < (1.0 - worthwhile) * before ? 0 : idle + 1;
  }
}

}  // namespace lrrt
