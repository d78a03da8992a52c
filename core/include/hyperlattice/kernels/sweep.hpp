// One pass over a block of a structured lattice: forces, failure, damping and integration together, rows along x, each pair of particles
// visited once. A row's springs go only forward (to later rows or later sites), so when a row is reached everything it receives from
// earlier rows is there, and its velocities and displacements are updated in place. Received forces wait in a ring of reach + 1 planes.
//
// The ghost planes before the block repeat the neighbour block's springs into this one, in the same order as the whole body would have
// them: sums do not depend on where the body is cut, hence not on the number of threads.
#pragma once

#include <hyperlattice/kernels/springs.hpp>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

enum class Task { step, step_damped, measure };

template <class Law, Membrane membrane, bool Breakable, bool Mixed, Task task>
class Sweep {
  static constexpr int components = components_of(membrane);
  static constexpr bool measuring = task == Task::measure;

 public:
  static void run(const KernelRequest& request) noexcept { Sweep(request).all_rows(); }

 private:
  explicit Sweep(const KernelRequest& request) : request_(request) {}

  void all_rows() {
    for (int k = -request_.reach; k < request_.planes; ++k)
      for (int j = 0; j < request_.rows_per_plane; ++j) {
        const std::uint32_t index = row_index(j, k);
        const Row& row = request_.rows[index];
        if (row.begin < row.end) one_row(row, index, j, k);
      }
    for (int k = request_.planes; k < request_.planes + request_.reach; ++k) {  // forces on the next block's planes: it finds them itself
      double* plane = received_plane(k);
      const std::size_t size = static_cast<std::size_t>(request_.rows_per_plane) * row_size();
      for (std::size_t n = 0; n < size; ++n) plane[n] = 0;
    }
  }

  void one_row(const Row& row, std::uint32_t index, int j, int k) {
    const bool owned = k >= 0;
    const int count = (row.end - row.begin + lanes - 1) / lanes * lanes;
    begin_row(row, count);
    Pack stored{};
    for (std::uint32_t n = 0; n < request_.neighbours.size(); ++n) {
      const NeighbourGeometry& neighbour = request_.neighbours[n];
      if ((row.neighbours >> n & 1u) == 0 || (!owned && k + neighbour.site.dz < 0)) continue;
      const RowPair<components> pair = pair_of(row, neighbour.site, j, k);
      const auto bit = static_cast<std::uint16_t>(1u << n);
      const bool uniform = !Mixed || row.material >= 0;
      const SpringConstants* constants = request_.springs + neighbour.site.spring_class;
      if constexpr (Mixed)
        if (uniform) constants += static_cast<std::uint32_t>(row.material) * (request_.materials + 1) * request_.spring_classes;
      bool rung;
      if (uniform)
        rung = Springs<Law, membrane, Breakable, false, measuring>::add(request_, pair, neighbour, bit, *constants, count, stored);
      else
        rung = Springs<Law, membrane, Breakable, Mixed, measuring>::add(request_, pair, neighbour, bit, *constants, count, stored);
      if (Breakable && rung && owned && !measuring)
        Springs<Law, membrane, Breakable, Mixed, measuring>::review(request_, pair, row, index, n, uniform ? constants : nullptr);
    }
    if (!owned) return;
    if constexpr (measuring) request_.sums[index].stored = sum(stored);
    end_row(row, index, j, k, count);
  }

  /// The row's own forces start with the body acceleration's.
  void begin_row(const Row& row, int count) {
    const double acceleration[4] = {request_.acceleration.x, request_.acceleration.y, request_.acceleration.z, 0};
    for (int c = 0; c < components; ++c) {
      double* own = own_row(c);
      for (int t = 0; t < count; t += lanes) {
        Pack start{};
        if (acceleration[c] != 0) start = where(lanes_with(request_.alive + row.start + t, particle_bit), acceleration[c] * mass_of(row, t));
        store(own + t, start);
      }
    }
  }

  /// Sums the forces on the row, then moves it by one step, or measures it.
  void end_row(const Row& row, std::uint32_t index, int j, int k, int count) {
    const double kick = request_.back + request_.forward, drift = 2 * request_.forward;
    RowSums measured;
    Pack damped{}, kinetic{}, kinetic_mean{}, stored{};
    Pack momentum[4] = {}, potential{};
    const double acceleration[4] = {request_.acceleration.x, request_.acceleration.y, request_.acceleration.z, 0};
    for (int c = 0; c < components; ++c) {
      double* own = own_row(c);
      double* received = received_row(c, j, k) + row.begin;
      for (int t = 0; t < count; t += lanes) {
        store(own + t, load(own + t) + load(received + t));
        store(received + t, Pack{});
      }
    }
    supports_before(row);
    for (int t = 0; t < count; t += lanes) {
      const Pack mass = mass_of(row, t), inverse_mass = 1.0 / mass;
      Pack alpha{};
      if constexpr (membrane == Membrane::free) alpha = alpha_of(row, t);
      for (int c = 0; c < components; ++c) {
        double* u = request_.displacement[c] + row.start + t;
        double* v = request_.velocity[c] + row.start + t;
        const Pack displacement = load(u), velocity = load(v);
        Pack force = load(own_row(c) + t);
        if (membrane == Membrane::free && c == 3) {  // the alpha spring joins the particle to its own mirror copy
          force -= 2.0 * alpha * displacement;
          if constexpr (measuring) stored += alpha * displacement * displacement;
        }
        Pack drag{};
        if (task == Task::step_damped || (measuring && request_.damping != 0)) {
          drag = with_sign(request_.damping * absolute(force), velocity);
          force -= drag;
        }
        if constexpr (measuring) {
          const Pack kicked = velocity + 2 * request_.back * inverse_mass * force, mean = velocity + request_.back * inverse_mass * force;
          kinetic += 0.5 * mass * velocity * kicked;
          kinetic_mean += 0.5 * mass * mean * mean;
          momentum[c] += mass * mean;
          potential += mass * acceleration[c] * displacement;
          damped += request_.back * drag * velocity;
        } else {
          const Pack faster = velocity + kick * inverse_mass * force;
          store(v, faster);
          store(u, displacement + drift * faster);
          if constexpr (task == Task::step_damped) damped += drag * (request_.back * velocity + request_.forward * faster);
        }
      }
    }
    if constexpr (task == Task::step_damped) request_.damped_work[index] += sum(damped);
    if constexpr (measuring) {
      measured.stored = request_.sums[index].stored + sum(stored);
      measured.kinetic = sum(kinetic);
      measured.kinetic_mean = sum(kinetic_mean);
      measured.momentum = {sum(momentum[0]), sum(momentum[1]), sum(momentum[2])};
      measured.potential = sum(potential);
      measured.damped = sum(damped);
      supports_measured(row, measured);
      request_.sums[index] = measured;
    } else {
      supports_after(row);
    }
  }

  // The few particles with external forces or prescribed motion. Their state before the row is moved waits in the support itself.
  void supports_before(const Row& row) {
    for (std::uint32_t n = row.first_support; n < row.last_support; ++n) {
      Support& support = request_.supports[n];
      const double force[3] = {support.force.x, support.force.y, support.force.z};
      for (int c = 0; c < 3; ++c) {
        double& sum_of_forces = own_row(c)[support.site - row.begin];
        sum_of_forces += force[c];
        support.sum[c] = sum_of_forces;
        support.speed_before[c] = request_.velocity[c][support.index];
        support.place_before[c] = request_.displacement[c][support.index];
      }
    }
  }

  void supports_after(const Row& row) {
    const double kick = request_.back + request_.forward, drift = 2 * request_.forward;
    for (std::uint32_t n = row.first_support; n < row.last_support; ++n) {
      Support& support = request_.supports[n];
      const double prescribed[3] = {support.velocity.x, support.velocity.y, support.velocity.z};
      double path[3];
      for (int c = 0; c < 3; ++c) {
        double& v = request_.velocity[c][support.index];
        const bool held = (support.axes >> c & 1u) != 0;
        if (held) {
          v = prescribed[c];
          request_.displacement[c][support.index] = support.place_before[c] + drift * v;
        }
        path[c] = request_.back * support.speed_before[c] + request_.forward * v;
        if (held) support.reaction_work += (support.mass * (v - support.speed_before[c]) / kick - support.sum[c]) * path[c];
      }
      support.path = {path[0], path[1], path[2]};
    }
  }

  /// A prescribed component ends the half step before now with the prescribed velocity, not with what its forces would give it.
  void supports_measured(const Row& row, RowSums& measured) {
    for (std::uint32_t n = row.first_support; n < row.last_support; ++n) {
      Support& support = request_.supports[n];
      const double prescribed[3] = {support.velocity.x, support.velocity.y, support.velocity.z};
      double half_path[3], momentum[3] = {0, 0, 0};
      support.reaction_now = 0;
      for (int c = 0; c < 3; ++c) {
        const double before = support.speed_before[c];
        half_path[c] = request_.back * before;
        if ((support.axes >> c & 1u) == 0) continue;
        double force = support.sum[c];
        if (request_.damping != 0 && before != 0) force -= __builtin_copysign(request_.damping * __builtin_fabs(force), before);
        const double free_mean = before + request_.back * force / support.mass;
        const double free_after = before + 2 * request_.back * force / support.mass;
        const double after = request_.back > 0 ? prescribed[c] : before;
        const double mean = 0.5 * (before + after);
        measured.kinetic += 0.5 * support.mass * before * (after - free_after);
        measured.kinetic_mean += 0.5 * support.mass * (mean * mean - free_mean * free_mean);
        momentum[c] = support.mass * (mean - free_mean);
        if (request_.back > 0) support.reaction_now += (support.mass * (after - before) / (2 * request_.back) - support.sum[c]) * half_path[c];
      }
      measured.momentum = measured.momentum + Vec3{momentum[0], momentum[1], momentum[2]};
      support.path = {half_path[0], half_path[1], half_path[2]};
    }
  }

  // Where things are.
  std::uint32_t row_index(int j, int k) const { return static_cast<std::uint32_t>((k + request_.reach) * request_.rows_per_plane + j); }
  std::size_t row_size() const { return static_cast<std::size_t>(components) * static_cast<std::size_t>(request_.scratch_width); }
  double* received_plane(int k) const {
    const auto slot = static_cast<std::size_t>((k + request_.reach) % (request_.reach + 1));
    return request_.scratch + row_size() * (1 + slot * static_cast<std::size_t>(request_.rows_per_plane));
  }
  double* received_row(int c, int j, int k) const {  // element i belongs to site i
    return received_plane(k) + row_size() * static_cast<std::size_t>(j) + c * request_.scratch_width + scratch_margin;
  }
  double* own_row(int c) const { return request_.scratch + c * request_.scratch_width; }  // element t belongs to site begin + t

  RowPair<components> pair_of(const Row& row, const Neighbour& to, int j, int k) const {
    const Row& other = request_.rows[row_index(j + to.dy, k + to.dz)];
    const auto here = static_cast<std::ptrdiff_t>(row.start);
    const auto there = static_cast<std::ptrdiff_t>(other.start) + (row.begin + to.dx - other.begin);
    RowPair<components> pair;
    for (int c = 0; c < components; ++c) {
      pair.here[c] = request_.displacement[c] + here;
      pair.there[c] = request_.displacement[c] + there;
      pair.own[c] = own_row(c);
      pair.received[c] = received_row(c, j + to.dy, k + to.dz) + row.begin + to.dx;
    }
    pair.alive = request_.alive + here;
    pair.material_here = Mixed ? request_.material + here : nullptr;
    pair.material_there = Mixed ? request_.material + there : nullptr;
    return pair;
  }

  Pack per_material(const double* values, const Row& row, int t) const {
    if (!Mixed || row.material >= 0) return fill(values[Mixed ? row.material : 0]);
    Pack pack;
    for (int lane = 0; lane < lanes; ++lane) pack[lane] = values[request_.material[row.start + static_cast<std::uint64_t>(t + lane)]];
    return pack;
  }
  Pack mass_of(const Row& row, int t) const { return per_material(request_.mass, row, t); }
  Pack alpha_of(const Row& row, int t) const { return per_material(request_.alpha, row, t); }

  const KernelRequest& request_;
};

/// The kernels of a law for a choice, all compiled for one instruction set.
template <class Law>
KernelSet kernels_of(const KernelChoice& choice, const char* instructions) {
  KernelSet set;
  const auto with = [&]<Membrane membrane, bool Breakable, bool Mixed>() {
    set.step = &Sweep<Law, membrane, Breakable, Mixed, Task::step>::run;
    set.step_damped = &Sweep<Law, membrane, Breakable, Mixed, Task::step_damped>::run;
    set.measure = &Sweep<Law, membrane, false, Mixed, Task::measure>::run;
  };
  const auto with_membrane = [&]<Membrane membrane>() {
    if (choice.breakable && choice.mixed)
      with.template operator()<membrane, true, true>();
    else if (choice.breakable)
      with.template operator()<membrane, true, false>();
    else if (choice.mixed)
      with.template operator()<membrane, false, true>();
    else
      with.template operator()<membrane, false, false>();
  };
  switch (choice.membrane) {
    case Membrane::none:
      with_membrane.template operator()<Membrane::none>();
      break;
    case Membrane::clamped:
      with_membrane.template operator()<Membrane::clamped>();
      break;
    case Membrane::free:
      with_membrane.template operator()<Membrane::free>();
      break;
  }
  set.force = [](double stiffness, double elongation) noexcept { return Law::force(stiffness, elongation); };
  set.energy = [](double stiffness, double elongation) noexcept { return Law::energy(stiffness, elongation); };
  set.instructions = instructions;
  return set;
}

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS

#define HYPERLATTICE_TEXT_OF(name) #name
#define HYPERLATTICE_TEXT(name) HYPERLATTICE_TEXT_OF(name)
#define HYPERLATTICE_JOIN_OF(a, b) a##b
#define HYPERLATTICE_JOIN(a, b) HYPERLATTICE_JOIN_OF(a, b)

/// Written once in each generated file: hyperlattice_kernels_avx2(choice), and so on.
#define HYPERLATTICE_KERNELS(Law)                                                                                                         \
  hyperlattice::KernelSet HYPERLATTICE_JOIN(hyperlattice_kernels_, HYPERLATTICE_INSTRUCTIONS)(const hyperlattice::KernelChoice& choice) { \
    return hyperlattice::HYPERLATTICE_INSTRUCTIONS::kernels_of<Law>(choice, HYPERLATTICE_TEXT(HYPERLATTICE_INSTRUCTIONS));                \
  }
