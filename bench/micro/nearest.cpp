// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/datastructures/NearestNeighborsGNAT.h>
#include <ompl/datastructures/NearestNeighborsGNATNoThreadSafety.h>
#include <ompl/datastructures/NearestNeighborsLinear.h>
#include <ompl/datastructures/NearestNeighborsSqrtApprox.h>

#include <cmath>
#include <memory>
#include <type_traits>
#include <vector>

#include "lrrt/ompl/grid_neighbors.hpp"
#include "lrrt/sampling/random.hpp"

// What a tree planner pays in every iteration: the nearest node, the nodes of a disc, one more node. The grid is this
// library's, the others are OMPL's.
namespace lrrt::micro {
namespace {

namespace ob = ompl::base;

constexpr double side = 256.0;
constexpr std::size_t query_count = 1024;

/// What planners keep: something with a state.
struct Motion {
  ob::State* state;
};

using Node = const Motion*;
using Grid = GridNeighbors<Node>;
using Gnat = ompl::NearestNeighborsGNATNoThreadSafety<Node>;  ///< OMPL's choice for planners of one thread
using GnatForThreads = ompl::NearestNeighborsGNAT<Node>;      ///< and for PRM
using SqrtApprox = ompl::NearestNeighborsSqrtApprox<Node>;
using Linear = ompl::NearestNeighborsLinear<Node>;

/// Random points of a square as states of the plane: planners reach them through a pointer and the space's distance.
class Points {
 public:
  Points(std::size_t count, std::uint64_t seed) : space_(std::make_shared<ob::RealVectorStateSpace>(2)) {
    Random random(seed);
    for (std::size_t i = 0; i < count; ++i) {
      auto* state = space_->allocState()->as<ob::RealVectorStateSpace::StateType>();
      (*state)[0] = random.uniform(0.0, side);
      (*state)[1] = random.uniform(0.0, side);
      motions_.push_back({state});
    }
  }
  ~Points() {
    for (const Motion& motion : motions_) space_->freeState(motion.state);
  }
  Points(const Points&) = delete;
  Points& operator=(const Points&) = delete;

  Node operator[](std::size_t i) const { return &motions_[i]; }
  std::size_t size() const { return motions_.size(); }

  /// Adds all of them to a structure, one after the other, as a tree grows.
  template <typename Structure>
  void fill(Structure& structure) const {
    structure.setDistanceFunction(
        [space = space_.get()](const Node& a, const Node& b) { return space->distance(a->state, b->state); });
    for (const Motion& motion : motions_) structure.add(&motion);
  }

 private:
  ob::StateSpacePtr space_;
  std::vector<Motion> motions_;
};

/// The disc within which RRT* rewires a tree of so many nodes in free space (Karaman and Frazzoli 2011), with OMPL's
/// factor of 1.1.
double rewiring_radius(double nodes) {
  const double area_of_unit_disc = 3.141592653589793;
  return 1.1 * std::sqrt(3.0 * side * side / area_of_unit_disc * std::log(nodes) / nodes);
}

template <typename Structure>
Structure make() {
  if constexpr (std::is_same_v<Structure, Grid>) {
    ob::RealVectorBounds square(2);
    square.setLow(0.0);
    square.setHigh(side);
    return Grid(square, 6.0);
  } else {
    return {};
  }
}

Points nodes_of(const benchmark::State& state) {
  return {static_cast<std::size_t>(state.range(0)), 1};
}

/// A structure with its nodes in it, and points to ask it for.
template <typename Structure>
struct Filled {
  explicit Filled(const benchmark::State& state) : nodes(nodes_of(state)), structure(make<Structure>()) {
    nodes.fill(structure);
  }

  Points nodes;
  Points queries{query_count, 2};
  Structure structure;
};

template <typename Structure>
void nearest(benchmark::State& state) {
  const Filled<Structure> tree(state);
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    benchmark::DoNotOptimize(tree.structure.nearest(tree.queries[i++ % query_count]));
  }
  state.SetItemsProcessed(state.iterations());
}

template <typename Structure>
void disc(benchmark::State& state) {
  const Filled<Structure> tree(state);
  const double radius = rewiring_radius(static_cast<double>(tree.nodes.size()));
  std::vector<Node> found;
  double sum = 0.0;
  std::size_t i = 0;
  for ([[maybe_unused]] auto _ : state) {
    tree.structure.nearestR(tree.queries[i++ % query_count], radius, found);
    sum += static_cast<double>(found.size());
  }
  state.counters["neighbours"] = benchmark::Counter(sum, benchmark::Counter::kAvgIterations);
  state.SetItemsProcessed(state.iterations());
}

/// A whole tree, node by node; items are nodes.
template <typename Structure>
void add(benchmark::State& state) {
  const Points nodes = nodes_of(state);
  for ([[maybe_unused]] auto _ : state) {
    Structure structure = make<Structure>();
    nodes.fill(structure);
    benchmark::DoNotOptimize(structure);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

constexpr auto sizes = [](auto* row) { row->Arg(1000)->Arg(10000); };
constexpr auto sizes_us = [](auto* row) { row->Arg(1000)->Arg(10000)->Unit(benchmark::kMicrosecond); };

BENCHMARK(nearest<Grid>)->Name("nearest/one/grid")->Apply(sizes);
BENCHMARK(nearest<Gnat>)->Name("nearest/one/gnat")->Apply(sizes);
BENCHMARK(nearest<GnatForThreads>)->Name("nearest/one/gnat_for_threads")->Apply(sizes);
BENCHMARK(nearest<SqrtApprox>)->Name("nearest/one/sqrt_approx")->Apply(sizes);
BENCHMARK(nearest<Linear>)->Name("nearest/one/linear")->Apply(sizes);
BENCHMARK(disc<Grid>)->Name("nearest/disc/grid")->Apply(sizes);
BENCHMARK(disc<Gnat>)->Name("nearest/disc/gnat")->Apply(sizes);
BENCHMARK(disc<GnatForThreads>)->Name("nearest/disc/gnat_for_threads")->Apply(sizes);
BENCHMARK(disc<SqrtApprox>)->Name("nearest/disc/sqrt_approx")->Apply(sizes);
BENCHMARK(disc<Linear>)->Name("nearest/disc/linear")->Apply(sizes);
BENCHMARK(add<Grid>)->Name("nearest/add/grid")->Apply(sizes_us);
BENCHMARK(add<Gnat>)->Name("nearest/add/gnat")->Apply(sizes_us);
BENCHMARK(add<GnatForThreads>)->Name("nearest/add/gnat_for_threads")->Apply(sizes_us);
BENCHMARK(add<Linear>)->Name("nearest/add/linear")->Apply(sizes_us);

}  // namespace
}  // namespace lrrt::micro
