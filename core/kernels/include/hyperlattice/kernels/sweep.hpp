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

 private:
  template <bool Several, bool Weighted>
  using OneByOne = Springs<Law, config.of_springs(Several, Weighted)>;
  using Fused = Stencil<Law, config.of_springs(false, false), CubicList>;
  static constexpr bool can_fuse =
      !measuring && !LawWithConstants<Law> &&
      vectors <= 2;  // processors with shorter vectors have too few registers

  explicit Sweep(const KernelRequest& request)
      : request_(request), fused_(can_fuse && !request.exact && CubicList::is(request.neighbours)) {
    for (int c = 0; c < components; ++c) own_[c] = own_row(c);
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
      Real* plane = received_plane(k);
      const std::size_t size = static_cast<std::size_t>(request_.rows_per_plane) * row_size();
      for (std::size_t n = 0; n < size; ++n) plane[n] = 0;
    }
  }

  void one_row(const Row& row, std::uint32_t index, int j, int k) {
    const bool owned = k >= 0, fused = fused_ && (!Mixed || row.material >= 0);
    const int count = (row.end - row.begin + width - 1) / width * width;
    Motion<config.of_motion()> motion(request_, row);
    const bool accelerated = motion.accelerated();
    // Particles can move as soon as the forces on them are known, unless a criterion or a boundary
    // particle must see the forces first.
    constexpr bool may_move_at_once = !Breakable && !Mixed && !measuring;
    const bool at_once = may_move_at_once && fused && owned &&
                         row.first_boundary_particle == row.last_boundary_particle;
    Energies<Pack> energies;
    if (!fused) {
      motion.set_body_force(own_, count);
      one_by_one(row, index, j, k, count, energies);
    } else if constexpr (can_fuse) {
      const typename Fused::Rows rows = rows_of(row, j, k, count);
      Fused stencil(request_, rows);
      if (may_move_at_once && at_once) {
        if constexpr (may_move_at_once)
          stencil.run([&](int t, Forces<components, Real>& forces) __attribute__((always_inline)) {
            if (accelerated)
              for (std::size_t c = 0; c < components; ++c)
                forces[c] += motion.body_force(static_cast<int>(c), t);
            motion.vector(t, forces);
          });
      } else {
        const std::uint32_t rung = stencil.run(own_);
        if (accelerated) motion.add_body_force(own_, count);
        if (Breakable && owned) review_all(row, index, j, k, rung);
      }
    }
    if (!owned) return;
    if (!at_once) motion.vectors(own_);
    motion.template finish<LawWithMemory<Law>>(index, energies);
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
      rows.received[line] = received_row(0, to_j, to_k) + row.begin;
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

  [[gnu::noinline]] void one_by_one(const Row& row, std::uint32_t index, int j, int k, int count,
                                    Energies<Pack>& energies) {
    const bool owned = k >= 0;
    for (std::uint32_t n = 0; n < request_.neighbours.size(); ++n) {
      const NeighbourGeometry& neighbour = request_.neighbours[n];
      if ((row.neighbours >> n & 1u) == 0 || (!owned && k + neighbour.site.dz < 0)) continue;
      Pair pair = pair_of(row, neighbour.site, j, k);
      if constexpr (memory_of<Law>() > 0)
        pair.memory = request_.memory +
                      n * kinds_of(config.membrane) * memory_of<Law>() * request_.memory_stride +
                      row.start;
      const auto bit = static_cast<std::uint16_t>(1u << n);
      const bool uniform = !Mixed || row.material >= 0;
      const SpringConstants* constants = constants_of(row, neighbour.site.spring_class);
      const auto add = [&]<bool Several, bool Weighted>() {
        return OneByOne<Several, Weighted>::add(request_, pair, neighbour, bit, *constants, count,
                                                energies);
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
      Real* received = received_row(c, j, k) + row.begin;
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
      kinds.base = {constants.stiffness, neighbour.rest_length,
                    Breakable ? constants.alarm : infinity};
      kinds.cross = {constants.cross_stiffness, neighbour.cross_rest_length, infinity};
    }
  }

  // Places of rows in the arrays.
  std::uint32_t row_index(int j, int k) const {
    return static_cast<std::uint32_t>((k + request_.reach) * request_.rows_per_plane + j);
  }
  std::size_t row_size() const {
    return static_cast<std::size_t>(components) * static_cast<std::size_t>(request_.scratch_width);
  }
  Real* received_plane(int k) const {  // the same address for both precisions, so that steps and
                                       // measurements find zeros there
    const auto slot = static_cast<std::size_t>((k + request_.reach) % (request_.reach + 1));
    void* first = static_cast<double*>(request_.scratch) + row_size();
    return static_cast<Real*>(first) +
           row_size() * slot * static_cast<std::size_t>(request_.rows_per_plane);
  }
  Real* received_row(int c, int j, int k) const {  // element i belongs to site i
    return received_plane(k) + row_size() * static_cast<std::size_t>(j) +
           c * request_.scratch_width + scratch_margin;
  }
  Real* own_row(int c) const {
    return static_cast<Real*>(request_.scratch) + c * request_.scratch_width;
  }  // element t belongs to site begin + t

  Pair pair_of(const Row& row, const Neighbour& to, int j, int k) const {
    const Row& other = request_.rows[row_index(j + to.dy, k + to.dz)];
    const auto here = static_cast<std::ptrdiff_t>(row.start);
    const auto there = static_cast<std::ptrdiff_t>(other.start) + (row.begin + to.dx - other.begin);
    Pair pair{};
    for (int c = 0; c < components; ++c) {
      const auto* displacement = static_cast<const Stored*>(request_.displacement[c]);
      pair.here[c] = displacement + here;
      pair.there[c] = displacement + there;
      pair.own[c] = own_row(c);
      pair.received[c] = received_row(c, j + to.dy, k + to.dz) + row.begin + to.dx;
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
    if constexpr (LawWithStart<Law>)
      set.start = [](const double* law, const SpringIdentity& spring, double* kept,
                     const Complaint& why) noexcept {
        return detail::guarded(why, [&] { SpringStep<Law>::start(law, spring, kept); });
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
    const double k = spring.stiffness, u = spring.elongation;
    if constexpr (LawWithMemory<Law>)
      return {
          spring.memory[SpringStep<Law>::own + 1],
          SpringStep<Law>::energy_of({k, spring.rest_length, u, 0, 0}, spring.law, spring.memory)};
    else
      return taken(spring, 0, nullptr);
  }

  static SpringAnswer taken(const OneSpring& spring, double time_step, double* kept) {
    if constexpr (LawWithConstants<Law>) {
      const auto step = SpringStep<Law>::take(
          {spring.stiffness, spring.rest_length, spring.elongation, 0, time_step}, spring.law,
          kept);
      return {step.force, step.energy};
    } else {
      return {Law::force(spring.stiffness, spring.elongation),
              Law::energy(spring.stiffness, spring.elongation)};
    }
  }

  /// The try block is outside of the kernel, so that it does not affect the loops.
  template <class Kernel>
  static bool run(const KernelRequest& request, const Complaint& why) noexcept {
    return detail::guarded(why, [&] { Kernel::run(request); });
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
    if constexpr (LawWithConstants<Law>) return of_mixture<membrane, true>(choice);
    return choice.breakable ? of_mixture<membrane, true>(choice)
                            : of_mixture<membrane, false>(choice);
  }
  template <Membrane membrane, bool breakable>
  static KernelSet of_mixture(const KernelChoice& choice) {
    if constexpr (LawWithConstants<Law>)
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
    if (choice.listed)
      return of_sweep<ListedSweep, config(Task::step), config(Task::step_damped),
                      config(Task::measure)>();
    KernelSet set =
        of_sweep<Sweep, config(Task::step), config(Task::step_damped), config(Task::measure)>();
    if constexpr (!LawWithConstants<Law>)
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
