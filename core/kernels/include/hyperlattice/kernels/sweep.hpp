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

#include <hyperlattice/kernels/listed.hpp>
#include <hyperlattice/kernels/stencil.hpp>
#include <hyperlattice/kernels/tangent.hpp>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

template <class Law, KernelConfig config>
class Sweep {
  using Stored = NumberOf<config.stored>;
  using Real = NumberOf<config.computed>;
  using Pack = PackOf<Real>;
  using Pair = RowPair<config.of_rows()>;
  static constexpr int components = config.components(), width = lanes_of<Real>;
  static constexpr bool measuring = config.measures(), Breakable = config.breakable,
                        Mixed = config.mixed;

 public:
  static void run(const KernelRequest& request) { Sweep(request).all_rows(); }

  /// Computes the springs of one row for the kernel of another law: see KernelSet::step_row.
  static void run_row(const KernelRequest& request, const RowPlace& place, RowEnergies& sums) {
    Sweep sweep(request);
    const Row& row = request.rows[place.index];
    const int count = (row.end - row.begin + width - 1) / width * width;
    Energies<Pack> energies;
    if (sweep.fuses(row)) {
      sweep.in_one(row, place.index, place.j, place.k, count);
    } else {
      for (Real* own : sweep.own_)
        for (int t = 0; t < count; t += width) store(own + t, Pack(0));
      sweep.one_by_one(row, place.index, place.j, place.k, count, energies);
    }
    sums = energies.sums();
  }

 private:
  template <bool Several, bool Weighted>
  using OneByOne = Springs<Law, config.of_springs(Several, Weighted)>;
  using Fused = Stencil<Law, config.of_springs(false, false), CubicList>;
  static constexpr bool can_fuse =
      !measuring && !LawWithMemory<Law> &&
      vectors <= 2;  // processors with shorter vectors have too few registers

  explicit Sweep(const KernelRequest& request)
      : request_(request),
        scratch_(request, components),
        fused_(can_fuse && !request.exact && CubicList::is(request.neighbours)) {
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
    const bool owned = k >= 0, others = Mixed && row.law != 0;
    const int count = (row.end - row.begin + width - 1) / width * width;
    Motion<config.of_motion()> motion(request_, row);
    // Particles can move as soon as the forces on them are known, unless a criterion or a boundary
    // particle must see the forces first.
    constexpr bool may_move_at_once = can_fuse && !Breakable && !Mixed && !measuring;
    Energies<Pack> energies;
    if constexpr (may_move_at_once)
      if (fused_ && owned && row.first_boundary_particle == row.last_boundary_particle) {
        move_at_once(row, j, k, count, motion);
        return motion.template finish<LawWithMemory<Law>>(index, energies);
      }
    const bool in_one_pass = !others && fuses(row);
    if (others) {
      request_.other_row(request_.self, {index, j, k});
    } else if (in_one_pass) {
      in_one(row, index, j, k, count);
    } else {
      motion.set_body_force(own_, count);
      one_by_one(row, index, j, k, count, energies);
    }
    if (!owned) return;
    if ((others || in_one_pass) && motion.accelerated()) motion.add_body_force(own_, count);
    motion.vectors(own_);
    motion.template finish<LawWithMemory<Law>>(index, energies);
  }

  void move_at_once(const Row& row, int j, int k, int count, Motion<config.of_motion()>& motion) {
    const bool accelerated = motion.accelerated();
    const typename Fused::Rows rows = rows_of(row, j, k, count);
    Fused(request_, rows)
        .run([&](int t, Forces<components, Real>& forces) __attribute__((always_inline)) {
          if (accelerated)
            for (std::size_t c = 0; c < components; ++c)
              forces[c] += motion.body_force(static_cast<int>(c), t);
          motion.vector(t, forces);
        });
  }

  /// Returns whether all springs of the row can be computed in one pass.
  bool fuses(const Row& row) const { return can_fuse && fused_ && (!Mixed || row.material >= 0); }

  /// Sets the row's own forces to those of its springs and of earlier rows' springs.
  void in_one(const Row& row, std::uint32_t index, int j, int k, int count) {
    if constexpr (can_fuse) {
      const typename Fused::Rows rows = rows_of(row, j, k, count);
      const std::uint32_t rung = Fused(request_, rows).run(own_);
      if (Breakable && k >= 0) review_all(row, index, j, k, rung);
    }
  }

  typename Fused::Rows rows_of(const Row& row, int j, int k, int count) {
    if (const std::int32_t material = Mixed ? row.material : 0; material != kinds_of_)
      set_kinds(material);
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
        OneByOne<Mixed, false>::review(request_, pair_of(row, request_.neighbours[n].site, j, k),
                                       row, index, n,
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
      const bool uniform = !Mixed || row.material >= 0;
      const SpringConstants* constants = constants_of(row, neighbour.site.spring_class);
      const auto add = [&]<bool Several, bool Weighted>() {
        using Springs = OneByOne<Several, Weighted>;
        const typename Springs::Place place{row, index, n};
        return Springs::add(request_, pair, neighbour, bit, *constants, count, energies,
                            !measuring && owned ? &place : nullptr);
      };
      bool rung;
      if (row.weights == no_weights) {
        rung = uniform ? add.template operator()<false, false>()
                       : add.template operator()<Mixed, false>();
      } else {
        pair.weight_sets = request_.weight_sets + row.weights;
        pair.weights = request_.weights + lanes * (n + 1);
        rung = uniform ? add.template operator()<false, true>()
                       : add.template operator()<Mixed, true>();
      }
      if (Breakable && rung && owned && !measuring)
        OneByOne<Mixed, false>::review(request_, pair, row, index, n,
                                       uniform ? constants : nullptr);
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
    if (Mixed && row.material >= 0)
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
                    Breakable ? constants.alarm : infinity};
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
    if (Mixed && request_.mixture != nullptr) {
      pair.mixture = request_.mixture + here;
    } else if (Mixed) {
      pair.material_here = request_.material + here;
      pair.material_there = request_.material + there;
    }
    return pair;
  }

  const KernelRequest& request_;
  const ScratchRows<Real> scratch_;
  const bool fused_;
  typename Fused::Kinds kinds_[max_spring_classes];
  std::int32_t kinds_of_ = -1;
  Real* own_[components];
};

/// The kernels of a law for a KernelChoice, all compiled for one instruction set.
template <class Law>
class Kernels {
 public:
  static KernelSet of(const KernelChoice& choice, const char* instructions) {
    KernelSet set = of_membrane(choice);
    set.memory = memory_of<Law>();
    set.linear = is_linear<Law> && !LawWithConstants<Law> && !LawWithMemory<Law>;
    set.softens = has_integrity<Law>;
    if constexpr (has_start<Law>)
      set.start = [](const double* law, const SpringIdentity& spring, double* kept,
                     const Complaint& why) noexcept {
        return detail::guarded(why, [&] { SpringWithMemory<Law>(law).start(spring, kept); });
      };
    set.ask = [](const OneSpring& spring, SpringAnswer& answer, const Complaint& why) noexcept {
      return detail::guarded(why, [&] { answer = asked(spring); });
    };
    set.take = [](const OneSpring& spring, double time_step, double* kept, SpringAnswer& answer,
                  const Complaint& why) noexcept {
      return detail::guarded(why, [&] { answer = taken(spring, time_step, kept); });
    };
    set.instructions = instructions;
    return set;
  }

 private:
  static SpringAnswer asked(const OneSpring& spring) {
    if constexpr (LawWithMemory<Law>)
      return answer_of(SpringWithMemory<Law>(spring.law)
                           .present({spring.stiffness, spring.rest_length, spring.elongation, 0, 0},
                                    spring.memory));
    else
      return taken(spring, 0, nullptr);
  }

  static SpringAnswer taken(const OneSpring& spring, double time_step, double* kept) {
    if constexpr (LawWithMemory<Law>) {
      return answer_of(
          SpringWithMemory<Law>(spring.law)
              .take({spring.stiffness, spring.rest_length, spring.elongation, 0, time_step}, kept));
    } else {
      const SpringOf<double> of{spring.stiffness, spring.rest_length, spring.elongation};
      return {force_of<Law>(of, spring.law), energy_of<Law>(of, spring.law)};
    }
  }
  static SpringAnswer answer_of(const SpringStep& step) {
    return {step.force, step.energy, step.dissipated, step.integrity};
  }

  /// The try block is outside of the kernel, so that it does not affect the loops.
  template <class Kernel>
  static bool run(const KernelRequest& request, const Complaint& why) noexcept {
    return detail::guarded(why, [&] { Kernel::run(request); });
  }
  template <class Kernel>
  static bool run_row(const KernelRequest& request, const RowPlace& row, RowEnergies& energies,
                      const Complaint& why) noexcept {
    return detail::guarded(why, [&] { Kernel::run_row(request, row, energies); });
  }

  static KernelSet of_membrane(const KernelChoice& choice) {
    switch (choice.membrane) {
      case Membrane::none:
        return of_failure<Membrane::none>(choice);
      case Membrane::clamped:
        return of_failure<Membrane::clamped>(choice);
      default:
        return of_failure<Membrane::free>(choice);
    }
  }
  template <Membrane membrane>
  static KernelSet of_failure(const KernelChoice& choice) {
    if constexpr (LawWithMemory<Law>) return of_mixture<membrane, true>(choice);
    return choice.breakable ? of_mixture<membrane, true>(choice)
                            : of_mixture<membrane, false>(choice);
  }
  template <Membrane membrane, bool breakable>
  static KernelSet of_mixture(const KernelChoice& choice) {
    if constexpr (LawWithMemory<Law>)
      return of_precision<membrane, breakable, true>(
          choice);  // such laws run lane by lane, so fewer materials save nothing
    return choice.mixed ? of_precision<membrane, breakable, true>(choice)
                        : of_precision<membrane, breakable, false>(choice);
  }
  template <Membrane membrane, bool breakable, bool mixed>
  static KernelSet of_precision(const KernelChoice& choice) {
    return choice.precision == Precision::floats
               ? of_topology<membrane, breakable, mixed, Precision::floats>(choice)
               : of_topology<membrane, breakable, mixed, Precision::doubles>(choice);
  }
  template <Membrane membrane, bool breakable, bool mixed, Precision stored>
  static KernelSet of_topology(const KernelChoice& choice) {
    constexpr auto config = [](Task task) {
      return config_of<Law>(membrane, breakable && task != Task::measure, mixed, task, stored);
    };
    KernelSet set = choice.listed ? of_sweep<ListedSweep, config(Task::step),
                                             config(Task::step_damped), config(Task::measure)>()
                                  : of_sweep<Sweep, config(Task::step), config(Task::step_damped),
                                             config(Task::measure)>();
    set.linearise = [](const SpringRow& row, double& energy, const Complaint& why) noexcept {
      return detail::guarded(why, [&] { energy = Tangent<Law, membrane>::run(row); });
    };
    return set;
  }
  template <template <class, KernelConfig> class Of, KernelConfig step, KernelConfig step_damped,
            KernelConfig measure>
  static KernelSet of_sweep() {
    KernelSet set;
    set.step = &run<Of<Law, step>>;
    set.step_damped = &run<Of<Law, step_damped>>;
    set.measure = &run<Of<Law, measure>>;
    if constexpr (step.mixed) {
      set.step_row = &run_row<Of<Law, step>>;
      set.measure_row = &run_row<Of<Law, measure>>;
    }
    return set;
  }
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS

#define HYPERLATTICE_TEXT_OF(name) #name
#define HYPERLATTICE_TEXT(name) HYPERLATTICE_TEXT_OF(name)
#define HYPERLATTICE_JOIN_OF(a, b) a##b
#define HYPERLATTICE_JOIN(a, b) HYPERLATTICE_JOIN_OF(a, b)

/// Defines hyperlattice_kernels_avx2(choice), or its like; used once in each generated file.
#define HYPERLATTICE_KERNELS(Law)                                                              \
  hyperlattice::KernelSet HYPERLATTICE_JOIN(hyperlattice_kernels_, HYPERLATTICE_INSTRUCTIONS)( \
      const hyperlattice::KernelChoice& choice) {                                              \
    return hyperlattice::HYPERLATTICE_INSTRUCTIONS::Kernels<Law>::of(                          \
        choice, HYPERLATTICE_TEXT(HYPERLATTICE_INSTRUCTIONS));                                 \
  }
