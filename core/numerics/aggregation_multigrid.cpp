#include <numerics/aggregation_multigrid.hpp>
#include <numerics/block_inverse.hpp>
#include <numerics/chebyshev_iteration.hpp>
#include <numerics/power_iteration.hpp>
#include <numerics/random_stream.hpp>

namespace hyperlattice::numerics {

namespace {

constexpr Eigen::Index few_rows = 2000;  // few enough for the factorisation
constexpr std::size_t most_levels = 12;
constexpr int none = -1;

/// Calls visit(node, other node, value) for the entries of a node's rows.
template <class Visit>
void for_entries(const SparseRows& K, int node, int components, const Visit& visit) {
  for (int a = 0; a < components; ++a)
    for (SparseRows::InnerIterator entry(K, node * components + a); entry; ++entry)
      visit(static_cast<int>(entry.col()) / components, a,
            static_cast<int>(entry.col()) % components, entry.value());
}

std::vector<double> units_of_height(const SparseRows& K, int components) {
  std::vector<double> units;
  for (int node = 0; components == 4 && node < static_cast<int>(K.rows()) / components; ++node) {
    double own[4] = {};
    for_entries(K, node, components, [&](int there, int a, int b, double value) {
      if (there == node && a == b) own[a] = value;
    });
    units.push_back(unit_of_height(std::max({own[0], own[1], own[2]}), own[3]));
  }
  return units;
}

/// The stiffness between nodes: the norm of each nonzero block between two nodes, with heights in
/// each node's own unit.
struct Graph {
  std::vector<int> first{0}, other;
  std::vector<double> norm, own;

  Graph(const SparseRows& K, int components) {
    const int nodes = static_cast<int>(K.rows()) / components;
    std::vector<double> sum(static_cast<std::size_t>(nodes), 0);
    std::vector<int> met;
    const std::vector<double> height = units_of_height(K, components);
    const auto unit = [&](int node, int component) {
      return component == 3 ? height[static_cast<std::size_t>(node)] : 1;
    };
    for (int node = 0; node < nodes; ++node) {
      met.clear();
      for_entries(K, node, components, [&](int there, int a, int b, double value) {
        value *= unit(node, a) * unit(there, b);
        double& square = sum[static_cast<std::size_t>(there)];
        if (square == 0 && value != 0) met.push_back(there);
        square += value * value;
      });
      std::sort(met.begin(), met.end());
      own.push_back(std::sqrt(sum[static_cast<std::size_t>(node)]));
      for (const int there : met) {
        if (there != node) {
          other.push_back(there);
          norm.push_back(std::sqrt(sum[static_cast<std::size_t>(there)]));
        }
        sum[static_cast<std::size_t>(there)] = 0;
      }
      first.push_back(static_cast<int>(other.size()));
    }
  }
};

/// Finds the aggregate of each node, `none` for nodes without connections; returns their number.
/// First makes aggregates of whole neighbourhoods; then each node left joins its stiffest
/// neighbour.
int aggregate(const Graph& graph, double threshold, std::vector<int>& of) {
  const int nodes = static_cast<int>(graph.first.size()) - 1;
  of.assign(static_cast<std::size_t>(nodes), none);
  const auto at = [&](int node) -> int& { return of[static_cast<std::size_t>(node)]; };
  const auto own = [&](int node) { return graph.own[static_cast<std::size_t>(node)]; };
  const auto for_strong = [&](int node, const auto& visit) {
    for (int n = graph.first[static_cast<std::size_t>(node)];
         n < graph.first[static_cast<std::size_t>(node) + 1]; ++n) {
      const int there = graph.other[static_cast<std::size_t>(n)];
      const double norm = graph.norm[static_cast<std::size_t>(n)];
      if (norm > threshold * std::sqrt(own(node) * own(there))) visit(there, norm);
    }
  };
  int count = 0;
  for (int node = 0; node < nodes; ++node) {
    bool alone = true, whole = at(node) == none;
    for_strong(node, [&](int there, double) {
      alone = false;
      whole = whole && at(there) == none;
    });
    if (alone || !whole) continue;
    at(node) = count;
    for_strong(node, [&](int there, double) { at(there) = count; });
    ++count;
  }
  const std::vector<int> roots = of;
  for (int node = 0; node < nodes; ++node) {
    double stiffest = 0;
    if (at(node) != none) continue;
    for_strong(node, [&](int there, double norm) {
      if (roots[static_cast<std::size_t>(there)] == none || norm <= stiffest) return;
      stiffest = norm;
      at(node) = roots[static_cast<std::size_t>(there)];
    });
  }
  for (int node = 0; node < nodes; ++node) {
    if (at(node) != none) continue;
    bool alone = true;
    for_strong(node, [&](int there, double) {
      alone = false;
      if (at(there) == none) at(there) = count;
    });
    if (alone) continue;
    at(node) = count++;
  }
  return count;
}

void times_blocks(const NodeBlocks& blocks, const Eigen::VectorXd& r, Eigen::VectorXd& z) {
  const std::size_t size = blocks.components;
  for (std::size_t row = 0; row < static_cast<std::size_t>(r.size()); ++row) {
    double sum = 0;
    const std::size_t first = row / size * size;
    for (std::size_t b = 0; b < size; ++b)
      sum += blocks.inverse[row * size + b] * r[static_cast<Eigen::Index>(first + b)];
    z[static_cast<Eigen::Index>(row)] = sum;
  }
}

NodeBlocks blocks_of(const SparseRows& K, std::size_t components) {
  NodeBlocks blocks{components,
                    std::vector<double>(static_cast<std::size_t>(K.rows()) * components, 0)};
  const auto size = static_cast<Eigen::Index>(components);
  for (int node = 0; node < static_cast<int>(K.rows() / size); ++node) {
    Eigen::Matrix4d block = Eigen::Matrix4d::Zero();
    for_entries(K, node, static_cast<int>(size), [&](int there, int a, int b, double value) {
      if (there == node) block(a, b) = value;
    });
    const Eigen::Matrix4d inverse = BlockInverse(block).inverse;
    for (Eigen::Index a = 0; a < size; ++a)
      for (Eigen::Index b = 0; b < size; ++b)
        blocks.inverse[(static_cast<std::size_t>(node) * components + static_cast<std::size_t>(a)) *
                           components +
                       static_cast<std::size_t>(b)] = inverse(a, b);
  }
  Eigen::VectorXd x(K.rows()), y(K.rows());
  RandomStream random;
  for (double& value : x) value = random.next();
  const auto apply = [&] {
    y = K * x;
    times_blocks(blocks, y, x);
  };
  blocks.largest = PowerIteration{}.largest_eigenvalue([&] { return x.norm(); },
                                                       [&](double length) { x /= length; }, apply);
  return blocks;
}

/// Returns the smoothed motions of the nodes for each component of each aggregate: P.
SparseRows interpolation(const SparseRows& K, const NodeBlocks& blocks,
                         const std::vector<int>& aggregates, int count) {
  const auto size = static_cast<int>(blocks.components);
  SparseRows sharp(K.rows(), static_cast<Eigen::Index>(count) * size), damped(K.rows(), K.rows());
  sharp.reserve(Eigen::VectorXi::Constant(K.rows(), 1));
  damped.reserve(Eigen::VectorXi::Constant(K.rows(), size));
  const double omega = 4 / (3 * blocks.largest);
  for (int row = 0; row < static_cast<int>(K.rows()); ++row) {
    const int node = row / size, aggregate = aggregates[static_cast<std::size_t>(node)];
    const bool moves =
        std::any_of(blocks.inverse.begin() + row * size, blocks.inverse.begin() + (row + 1) * size,
                    [](double value) { return value != 0; });
    if (aggregate != none && moves) sharp.insert(row, aggregate * size + row % size) = 1;
    for (int b = 0; b < size; ++b)
      damped.insert(row, node * size + b) =
          omega * blocks.inverse[static_cast<std::size_t>(row) * blocks.components +
                                 static_cast<std::size_t>(b)];
  }
  sharp.makeCompressed();
  damped.makeCompressed();
  return (sharp - SparseRows(damped * SparseRows(K * sharp))).pruned();
}

}  // namespace

struct AggregationMultigrid::Level {
  /// P between the finer level and this one, and its transpose.
  SparseRows from_coarse, to_coarse;
  SparseRows K;
  NodeBlocks blocks;
  Eigen::VectorXd b, x, rest, step, product;

  void smooth(bool from_zero) {
    ChebyshevIteration chebyshev(blocks.largest);
    for (int n = 0; n < chebyshev.degree(); ++n) {
      const ChebyshevIteration::Step weights = n == 0 ? chebyshev.first() : chebyshev.next();
      const bool zero = from_zero && n == 0;
      rest = zero ? b : Eigen::VectorXd(b - K * x);
      times_blocks(blocks, rest, product);
      step = n == 0 ? Eigen::VectorXd(weights.take * product)
                    : Eigen::VectorXd(weights.keep * step + weights.take * product);
      x = zero ? step : Eigen::VectorXd(x + step);
    }
  }
};

AggregationMultigrid::AggregationMultigrid(const SparseRows& finest,
                                           const NodeBlocks& finest_blocks) {
  constexpr double threshold = 0.08;  // on the finest level; aggregates have few neighbours
  const SparseRows* K = &finest;
  const NodeBlocks* blocks = &finest_blocks;
  std::vector<int> aggregates;
  do {
    const int count = aggregate(Graph(*K, static_cast<int>(blocks->components)),
                                levels_.empty() ? threshold : 0, aggregates);
    const Eigen::Index rows =
        static_cast<Eigen::Index>(count) * static_cast<Eigen::Index>(blocks->components);
    if (count == 0 || rows >= K->rows()) break;
    auto level = std::make_unique<Level>();
    level->from_coarse = interpolation(*K, *blocks, aggregates, count);
    level->to_coarse = level->from_coarse.transpose();
    level->K = level->to_coarse * SparseRows(*K * level->from_coarse);
    for (Eigen::Index row = 0; row < rows; ++row)  // for unused components
      if (!(level->K.coeff(row, row) > 0)) level->K.coeffRef(row, row) = 1;
    level->K.makeCompressed();
    level->blocks = blocks_of(level->K, blocks->components);
    for (Eigen::VectorXd* field :
         {&level->b, &level->x, &level->rest, &level->step, &level->product})
      field->setZero(rows);
    levels_.push_back(std::move(level));
    K = &levels_.back()->K;
    blocks = &levels_.back()->blocks;
  } while (K->rows() > few_rows && levels_.size() < most_levels);
  if (levels_.empty()) return;
  constexpr double shift = 1e-9;  // for bodies that are not held
  coarsest_.compute(levels_.back()->K, shift);
}

AggregationMultigrid::~AggregationMultigrid() = default;

void AggregationMultigrid::apply(const Eigen::VectorXd& r, Eigen::VectorXd& z) {
  if (levels_.empty()) {
    z.setZero();
    return;
  }
  levels_.front()->b = levels_.front()->to_coarse * r;
  cycle(0);
  z = levels_.front()->from_coarse * levels_.front()->x;
}

void AggregationMultigrid::cycle(std::size_t n) {
  Level& level = *levels_[n];
  if (n + 1 == levels_.size()) {
    level.x = coarsest_.solve(level.b);
    return;
  }
  Level& below = *levels_[n + 1];
  level.smooth(true);
  level.rest = level.b - level.K * level.x;
  below.b = below.to_coarse * level.rest;
  cycle(n + 1);
  level.x += below.from_coarse * below.x;
  level.smooth(false);
}

}  // namespace hyperlattice::numerics
