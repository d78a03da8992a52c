// One pass over a block of a structured lattice: forces, failure, damping and integration together,
// in rows along x, with each pair of particles visited once. A row has only springs to later rows
// or later sites. When the pass reaches a row, the row has received all forces from earlier rows,
// so its velocities and displacements are updated in place. Received forces wait in a ring of reach
// + 1 planes.
//
// The springs from the ghost planes before the block into the block are computed again, in the
// order of the whole body. So sums do not depend on the cuts between blocks, nor on the number of
// threads.
#pragma once

#include <hyperlattice/kernels/cells.hpp>
#include <hyperlattice/kernels/springs.hpp>
#include <hyperlattice/kernels/stencil.hpp>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

template <class Law, KernelConfig config>
class Sweep {
  using Stored = NumberOf<config.stored>;
  using Real = NumberOf<config.computed>;
  using Pack = PackOf<Real>;
  using Pair = RowPair<config.of_rows()>;
  static constexpr int components = config.components(), width = lanes_of<Real>;
  static constexpr bool measuring = config.measures();

 public:
  static void run(const KernelRequest& request) { Sweep(request).all_rows(); }

  /// Computes the springs of one row for the kernel of another law: see KernelSet::step_row.
  static void run_row(const KernelRequest& request, const RowPlace& place, RowEnergies& sums) {
    Sweep sweep(request);
    const Row& row = request.rows[place.index];
    const int count = (row.end - row.begin + width - 1) / width * width;
    Energies<Pack> energies;
    if (sweep.fuses(row)) {
      sweep.in_one(row, place.index, place.j, place.k, count, false);
    } else {
      for (Real* own : sweep.own_)
        for (int t = 0; t < count; t += width) store(own + t, Pack(0));
      sweep.one_by_one(row, place.index, place.j, place.k, count, energies);
    }
    sums = energies.sums();
  }

 private:
  using OneByOne = Springs<Law, config>;
  using Fused = Stencil<Law, config, CubicList>;
  static constexpr bool can_fuse =
      !measuring && !LawWithMemory<Law> &&
      vectors <= 2;  // processors with shorter vectors have too few registers

  explicit Sweep(const KernelRequest& request)
      : request_(request),
        scratch_(request, components),
        fused_(can_fuse && !request.exact && CubicList::is(request.neighbours)),
        breakable_(!measuring && request.review != nullptr) {
    for (int c = 0; c < components; ++c) own_[c] = scratch_.own(c);
  }

  void all_rows() {
    for (int k = -request_.reach; k < request_.planes; ++k)
      for (int j = 0; j < request_.rows_per_plane; ++j) {
        const std::uint32_t index = row_index(j, k);
        const Row& row = request_.rows[index];
        if (row.begin < row.end) one_row(row, index, j, k);
      }
    for (int k = request_.planes; k < request_.planes + request_.reach;
         ++k) {  // the next block computes the forces on its own planes
      Real* plane = scratch_.received_plane(k);
      for (std::size_t n = 0; n < scratch_.plane_size(); ++n) plane[n] = 0;
    }
  }

  void one_row(const Row& row, std::uint32_t index, int j, int k) {
    const bool owned = k >= 0, others = row.law != 0, in_one_pass = !others && fuses(row);
    const int count = (row.end - row.begin + width - 1) / width * width;
    Energies<Pack> energies;
    if (request_.cells.spacing != 0) energies.stored += add_cells(row, j, k, count);
    // Particles can move as soon as the forces on them are known, unless a criterion, damping or a
    // boundary particle must see the forces first.
    Motion<config> motion(request_, row);
    if (in_one_pass && owned && !breakable_ && !motion.damped() &&
        row.first_boundary_particle == row.last_boundary_particle)
      return in_one(row, index, j, k, count, true);
    if (others) {
      request_.other_row(request_.self, {index, j, k});
    } else if (in_one_pass) {
      in_one(row, index, j, k, count, false);
    } else {
      motion.set_body_force(own_, count);
      one_by_one(row, index, j, k, count, energies);
    }
    if (!owned) return;
    if ((others || in_one_pass) && motion.accelerated()) motion.add_body_force(own_, count);
    motion.vectors(own_);
    motion.template finish<LawWithMemory<Law>>(index, energies);
  }

  /// Adds the forces of the row's cells to those that it and later rows receive. Returns the
  /// energies of the cells.
  Pack add_cells(const Row& row, int j, int k, int count) {
    using Row4 = CellRow<Stored, Real, measuring>;
    if (k + 1 < 0 || j + 1 == request_.rows_per_plane) return 0;
    typename Row4::Rows rows;
    for (int r = 0; r < 4; ++r) {
      const int to_j = j + (r & 1), to_k = k + (r >> 1);
      const Row& other = request_.rows[row_index(to_j, to_k)];
      const auto there = static_cast<std::ptrdiff_t>(other.start) + (row.begin - other.begin);
      for (int c = 0; c < 3; ++c) {
        rows.displacement[r][c] = static_cast<const Stored*>(request_.displacement[c]) + there;
        rows.received[r][c] = scratch_.received(c, to_j, to_k) + row.begin;
      }
    }
    rows.alive = request_.alive + row.start;
    rows.moduli = request_.cells.moduli == nullptr ? nullptr : request_.cells.moduli + row.start;
    return Row4::add(request_.cells, rows, count);
  }

  /// Returns whether all springs of the row can be computed in one pass.
  bool fuses(const Row& row) const { return can_fuse && fused_ && row.material >= 0; }

  /// Computes the row's springs in one pass. moves_at_once: moves its particles too; otherwise sets
  /// the row's own forces to those of its springs and of earlier rows' springs.
  void in_one(const Row& row, std::uint32_t index, int j, int k, int count, bool moves_at_once) {
    if constexpr (can_fuse) {
      Motion<config, true> motion(request_, row);
      const bool accelerated = motion.accelerated();
      const typename Fused::Rows rows = rows_of(row, j, k, count);
      const std::uint32_t rung =
          Fused(request_, rows)
              .run([&](int t, Forces<components, Real>& forces) __attribute__((always_inline)) {
                if (moves_at_once) {
                  if (accelerated)
                    for (std::size_t c = 0; c < components; ++c)
                      forces[c] += motion.body_force(static_cast<int>(c), t);
                  motion.template vector<false>(t, forces);
                } else {
                  for (std::size_t c = 0; c < components; ++c) store(own_[c] + t, forces[c]);
                }
              });
      if (breakable_ && k >= 0) review_all(row, index, j, k, rung);
    }
  }

  typename Fused::Rows rows_of(const Row& row, int j, int k, int count) {
    if (row.material != kinds_of_) set_kinds(row.material);
    typename Fused::Rows rows;
    for (std::size_t line = 0; line < CubicList::lines.size(); ++line) {
      const auto [dy, dz] = CubicList::lines[line];
      const bool there = (row.neighbours & CubicList::in_line({dy, dz})) !=
                         0;  // if not, the row itself takes its place, without springs
      const int to_j = there ? j + dy : j, to_k = there ? k + dz : k;
      const Row& other = request_.rows[row_index(to_j, to_k)];
      rows.displacement[line] =
          static_cast<std::ptrdiff_t>(other.start) + (row.begin - other.begin);
      rows.received[line] = scratch_.received(0, to_j, to_k) + row.begin;
    }
    rows.alive = request_.alive + row.start;
    rows.weight_sets = row.weights == no_weights ? nullptr : request_.weight_sets + row.weights;
    rows.kinds = kinds_;
    rows.neighbours = row.neighbours;
    rows.count = count;
    return rows;
  }

  void review_all(const Row& row, std::uint32_t index, int j, int k, std::uint32_t rung) {
    for (std::uint32_t n = 0; n < request_.neighbours.size(); ++n)
      if ((rung >> n & 1u) != 0)
        OneByOne::review(request_, pair_of(row, request_.neighbours[n].site, j, k), row, index, n,
                         constants_of(row, request_.neighbours[n].site.spring_class));
  }

  /// Adds the forces of the row's springs, one neighbour after another, and those that it received
  /// from earlier rows, to the row's own.
  [[gnu::noinline]] void one_by_one(const Row& row, std::uint32_t index, int j, int k, int count,
                                    Energies<Pack>& energies) {
    const bool owned = k >= 0;
    for (std::uint32_t n = 0; n < request_.neighbours.size(); ++n) {
      const NeighbourGeometry& neighbour = request_.neighbours[n];
      if ((row.neighbours >> n & 1u) == 0 || (!owned && k + neighbour.site.dz < 0)) continue;
      Pair pair = pair_of(row, neighbour.site, j, k);
      if constexpr (memory_of<Law>() > 0)
        pair.memory =
            request_.memory +
            n * kinds_of(config.membrane) * request_.memory_numbers * request_.memory_stride +
            row.start;
      const auto bit = static_cast<std::uint16_t>(1u << n);
      const SpringConstants* constants = constants_of(row, neighbour.site.spring_class);
      if (row.weights != no_weights) {
        pair.weight_sets = request_.weight_sets + row.weights;
        pair.weights = request_.weights + lanes * (n + 1);
      }
      const typename OneByOne::Place place{row, index, n};
      const bool rung = OneByOne::add(request_, pair, neighbour, bit, *constants, count, energies,
                                      !measuring && owned ? &place : nullptr);
      if (breakable_ && rung && owned)
        OneByOne::review(request_, pair, row, index, n, row.material >= 0 ? constants : nullptr);
    }
    join_received(row, j, k, count);
  }

  /// Adds the forces that the row received from earlier rows to its own.
  void join_received(const Row& row, int j, int k, int count) {
    for (int c = 0; c < components; ++c) {
      Real* received = scratch_.received(c, j, k) + row.begin;
      for (int t = 0; t < count; t += width) {
        store(own_[c] + t, load(own_[c] + t) + load(received + t));
        store(received + t, Pack(0));
      }
    }
  }

  // Constants of springs.
  const SpringConstants* constants_of(const Row& row, std::uint32_t spring_class) const {
    const SpringConstants* constants = request_.springs + spring_class;
    if (row.material >= 0)
      constants += static_cast<std::uint32_t>(row.material) * (request_.materials + 1) *
                   request_.spring_classes;
    return constants;
  }
  void set_kinds(std::int32_t material) {
    kinds_of_ = material;
    const SpringConstants* of_material = request_.springs + static_cast<std::uint32_t>(material) *
                                                                (request_.materials + 1) *
                                                                request_.spring_classes;
    for (const NeighbourGeometry& neighbour : request_.neighbours) {
      const SpringConstants& constants = of_material[neighbour.site.spring_class];
      auto& kinds = kinds_[neighbour.site.spring_class];
      kinds.base = {constants.stiffness, neighbour.rest_length, constants.law[0],
                    breakable_ ? constants.alarm : infinity};
      kinds.cross = {constants.cross_stiffness, neighbour.cross_rest_length, constants.law[1],
                     infinity};
    }
  }

  // Places of rows in the arrays.
  std::uint32_t row_index(int j, int k) const {
    return static_cast<std::uint32_t>((k + request_.reach) * request_.rows_per_plane + j);
  }
  Pair pair_of(const Row& row, const Neighbour& to, int j, int k) const {
    const Row& other = request_.rows[row_index(j + to.dy, k + to.dz)];
    const auto here = static_cast<std::ptrdiff_t>(row.start);
    const auto there = static_cast<std::ptrdiff_t>(other.start) + (row.begin + to.dx - other.begin);
    Pair pair{};
    for (int c = 0; c < components; ++c) {
      const auto* displacement = static_cast<const Stored*>(request_.displacement[c]);
      pair.here[c] = displacement + here;
      pair.there[c] = displacement + there;
      pair.own[c] = own_[c];
      pair.received[c] = scratch_.received(c, j + to.dy, k + to.dz) + row.begin + to.dx;
    }
    pair.alive = request_.alive + here;
    if (row.material >= 0) return pair;
    if (request_.mixture != nullptr) {
      pair.mixture = request_.mixture + here;
    } else {
      pair.material_here = request_.material + here;
      pair.material_there = request_.material + there;
    }
    return pair;
  }

  const KernelRequest& request_;
  const ScratchRows<Real> scratch_;
  const bool fused_;
  const bool breakable_;  ///< springs have alarms
  typename Fused::Kinds kinds_[max_spring_classes];
  std::int32_t kinds_of_ = -1;
  Real* own_[components];
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
