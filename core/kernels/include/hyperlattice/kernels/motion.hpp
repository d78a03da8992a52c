// The motion of a row of particles for given forces: damping, integration, prescribed motion; or
// the measurement of the row. The same for every lattice.
#pragma once

#include <hyperlattice/kernel_request.hpp>
#include <hyperlattice/kernels/config.hpp>
#include <hyperlattice/kernels/simd.hpp>

#include <array>
#include <type_traits>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

/// Stores a pack in the state's precision.
template <class Real, class Stored>
HYPERLATTICE_INLINE void store_as(Stored* to, const PackOf<Real>& pack) {
  if constexpr (std::is_same_v<Real, Stored>) {
    store(to, pack);
  } else {
    Real values[lanes_of<Real>];
    store(values, pack);
    for (int lane = 0; lane < lanes_of<Real>; ++lane) to[lane] = static_cast<Stored>(values[lane]);
  }
}

/// Loads a pack of weights. `places`: places of the sets of the vectors of `lanes` sites that the
/// pack covers; `offset`: offset into the sets.
template <class Real>
inline PackOf<Real> load_weights(const double* weights, const std::uint32_t* places, int offset) {
  if constexpr (lanes_of<Real> == lanes) {
    return load(weights + places[0] + offset);
  } else {
    return load_halves(weights + places[0] + offset, weights + places[1] + offset);
  }
}

/// Values of a row's particles that depend on their materials and their fractions of a whole
/// particle. OneMaterial: the row has one material.
template <bool OneMaterial, class Real>
class RowValues {
  using Pack = PackOf<Real>;

 public:
  RowValues(const KernelRequest& request, const Row& row)
      : material_(!OneMaterial && row.material < 0 && request.mixture == nullptr
                      ? request.material + row.start
                      : nullptr),
        mixture_(!OneMaterial && row.material < 0 && request.mixture != nullptr
                     ? request.mixture + row.start
                     : nullptr),
        uniform_(row.material < 0 ? 0 : row.material),
        weight_sets_(row.weights == no_weights ? nullptr : request.weight_sets + row.weights),
        weights_(request.weights) {}

  /// Returns the values of the vector at t. `values`: value of a whole particle of each material,
  /// then of each mixture.
  Pack at(const double* values, int t) const {
    Pack pack = values[uniform_];
    if constexpr (!OneMaterial) {
      if (material_ != nullptr) pack = of_lanes(values, material_ + t);
      if (mixture_ != nullptr) pack = of_lanes(values, mixture_ + t);
    }
    return weight_sets_ == nullptr
               ? pack
               : pack * load_weights<Real>(weights_, weight_sets_ + t / lanes, 0);
  }
  /// Returns whether all particles of the row have the same value.
  bool constant() const {
    return material_ == nullptr && mixture_ == nullptr && weight_sets_ == nullptr;
  }

 private:
  template <class Number>
  static Pack of_lanes(const double* values, const Number* numbers) {
    Real of_lane[lanes_of<Real>];
    for (int lane = 0; lane < lanes_of<Real>; ++lane)
      of_lane[lane] = static_cast<Real>(values[numbers[lane]]);
    return load(of_lane);
  }

  const std::uint8_t* material_;
  const std::uint32_t* mixture_;
  std::int32_t uniform_;
  const std::uint32_t* weight_sets_;
  const double* weights_;
};

/// Forces on a vector of particles.
template <int Components, class Real>
using Forces = std::array<PackOf<Real>, static_cast<std::size_t>(Components)>;

/// Energies of a row's springs, J. Only laws with a memory dissipate; laws that soften fracture.
template <class Pack>
struct Energies {
  Pack stored = 0, dissipated = 0, fractured = 0;

  RowEnergies sums() const { return {sum(stored), sum(dissipated), sum(fractured)}; }
};

inline double with_sign(double magnitude, double sign) {
  return sign == 0 ? 0 : __builtin_copysign(magnitude, sign);
}

/// The kick of a damped particle along one component:
///   v+ = v- + kick (F - drag) / m,   drag = damping |F| sign(v-) + damping_rate m (v- + v+) / 2
template <class Number>
struct Kick {
  Number after, drag;

  HYPERLATTICE_INLINE Kick(const KernelRequest& request, double kick, const Number& force,
                           const Number& velocity, const Number& mass, const Number& inverse_mass) {
    drag = with_sign(request.damping * force, velocity);
    after = velocity + kick * inverse_mass * (force - drag);
    if (request.damping_rate == 0) return;
    const double x = 0.5 * kick * request.damping_rate;
    after = (1 / (1 + x)) * (after - x * velocity);
    drag += 0.5 * request.damping_rate * mass * (velocity + after);
  }
};

/// Moves or measures a row. Call vectors() with the forces on all its particles, or vector() for
/// each vector of particles; then finish(). OneMaterial: the row has one material.
template <KernelConfig config, bool OneMaterial = false>
class Motion {
  using Stored = NumberOf<config.stored>;
  using Real = NumberOf<config.computed>;
  using Pack = PackOf<Real>;
  static constexpr Membrane membrane = config.membrane;
  static constexpr int components = config.components(), width = lanes_of<Real>;
  static constexpr bool measuring = config.measures();

 public:
  Motion(const KernelRequest& request, const Row& row)
      : request_(request),
        row_(row),
        values_(request, row),
        mass_(values_.at(request.mass, 0)),
        inverse_mass_(1.0 / mass_) {}

  /// Returns whether particles have damping.
  bool damped() const { return request_.damping != 0 || request_.damping_rate != 0; }
  /// Returns whether the body has an acceleration.
  bool accelerated() const {
    return request_.acceleration.x != 0 || request_.acceleration.y != 0 ||
           request_.acceleration.z != 0;
  }
  /// Returns the force of the body acceleration on a vector of particles.
  Pack body_force(int c, int t) const {
    const double acceleration[4] = {request_.acceleration.x, request_.acceleration.y,
                                    request_.acceleration.z, 0};
    return where(lanes_with<Real>(load_bits<Real>(request_.alive + row_.start + t), particle_bit),
                 acceleration[c] * values_.at(request_.mass, t));
  }

  /// Sets the forces on the row's `count` sites to those of the body acceleration. add_body_force()
  /// adds them.
  [[gnu::noinline]] void set_body_force(Real* const (&force)[components], int count) const {
    const bool accelerated = this->accelerated();
    for (int c = 0; c < components; ++c)
      for (int t = 0; t < count; t += width)
        store(force[c] + t, accelerated ? body_force(c, t) : Pack(0));
  }
  [[gnu::noinline]] void add_body_force(Real* const (&force)[components], int count) const {
    for (int c = 0; c < components; ++c)
      for (int t = 0; t < count; t += width)
        store(force[c] + t, load(force[c] + t) + body_force(c, t));
  }

  /// Moves or measures the row, boundary particles included. `force`: one array for each component,
  /// padded to whole vectors. Not inlined: all sweeps share it.
  [[gnu::noinline]] void vectors(Real* const (&force)[components]) {
    supports_before(force);
    if (!measuring && damped())
      all_vectors<true>(force);
    else
      all_vectors<false>(force);
    if constexpr (!measuring) supports_after();
  }

  /// Moves or measures one vector of particles, given the total force on them. The first is element
  /// t of the row. Damped: see damped(); a measurement takes damping into account anyway.
  template <bool Damped>
  HYPERLATTICE_INLINE void vector(int t, Forces<components, Real>& forces) {
    const double kick = request_.back + request_.forward, drift = 2 * request_.forward;
    if (!values_.constant()) {
      mass_ = values_.at(request_.mass, t);
      inverse_mass_ = 1.0 / mass_;
    }
    Pack alpha = 0;
    if constexpr (membrane == Membrane::free) alpha = values_.at(request_.alpha, t);
    for (std::size_t c = 0; c < components; ++c) {
      Stored* u = displacement(c) + row_.start + t;
      Stored* v = velocity(c) + row_.start + t;
      const Pack displacement = load_as<Real>(u), velocity = load_as<Real>(v);
      Pack force = forces[c];
      if (membrane == Membrane::free &&
          c == 3) {  // the alpha spring joins the particle to its own mirror copy
        force -= 2.0 * alpha * displacement;
        if constexpr (measuring) stored_ += alpha * displacement * displacement;
      }
      if constexpr (measuring) {
        const double acceleration[4] = {request_.acceleration.x, request_.acceleration.y,
                                        request_.acceleration.z, 0};
        const Kick<Pack> kicked(request_, 2 * request_.back, force, velocity, mass_, inverse_mass_);
        const Pack mean = 0.5 * (velocity + kicked.after);
        kinetic_ += 0.5 * mass_ * velocity * kicked.after;
        kinetic_mean_ += 0.5 * mass_ * mean * mean;
        momentum_[c] += mass_ * mean;
        potential_ += mass_ * acceleration[c] * displacement;
        damped_ += request_.back * kicked.drag * velocity;
      } else if constexpr (Damped) {
        const Kick<Pack> kicked(request_, kick, force, velocity, mass_, inverse_mass_);
        store_as(v, kicked.after);
        store_as(u, displacement + drift * kicked.after);
        damped_ += kicked.drag * (request_.back * velocity + request_.forward * kicked.after);
      } else {
        const Pack faster = velocity + kick * inverse_mass_ * force;
        store_as(v, faster);
        store_as(u, displacement + drift * faster);
      }
    }
  }

  /// Writes the sums of the row. `springs`: energies of the row's springs; `index`: index of the
  /// row.
  template <bool Dissipating = false>
  [[gnu::noinline]] void finish(std::uint32_t index, const Energies<Pack>& springs) {
    damped_ += springs.dissipated;
    if (!measuring && (Dissipating || damped()))
      request_.damped_work[index] += sum(damped_) - not_damped_;
    if constexpr (!measuring && Dissipating)
      if (request_.fracture_work != nullptr)
        request_.fracture_work[index] += sum(springs.fractured);
    if constexpr (measuring) {
      RowSums measured;
      measured.stored = sum(springs.stored + stored_);
      measured.kinetic = sum(kinetic_);
      measured.kinetic_mean = sum(kinetic_mean_);
      measured.momentum = {sum(momentum_[0]), sum(momentum_[1]), sum(momentum_[2])};
      measured.potential = sum(potential_);
      measured.damped = sum(damped_);
      measured.fractured = sum(springs.fractured);
      supports_measured(measured);
      request_.sums[index] = measured;
    }
  }

 private:
  template <bool Damped>
  void all_vectors(Real* const (&force)[components]) {
    for (int t = 0; t < row_.end - row_.begin; t += width) {
      Forces<components, Real> forces;
      for (std::size_t c = 0; c < components; ++c) forces[c] = load(force[c] + t);
      vector<Damped>(t, forces);
    }
  }

  Stored* displacement(std::size_t c) const {
    return static_cast<Stored*>(request_.displacement[c]);
  }
  Stored* velocity(std::size_t c) const { return static_cast<Stored*>(request_.velocity[c]); }

  // The few particles with external forces or prescribed motion. Each keeps its own state from
  // before the row is moved.
  void supports_before(Real* const (&forces)[components]) {
    for (std::uint32_t n = row_.first_boundary_particle; n < row_.last_boundary_particle; ++n) {
      BoundaryParticle& support = request_.boundary_particles[n];
      const double force[3] = {support.force.x, support.force.y, support.force.z};
      for (std::size_t c = 0; c < 3; ++c) {
        Real& sum_of_forces = forces[c][support.site - row_.begin];
        sum_of_forces += static_cast<Real>(force[c]);
        support.sum[c] = sum_of_forces;
        support.speed_before[c] = velocity(c)[support.index];
        support.place_before[c] = displacement(c)[support.index];
      }
    }
  }

  void supports_after() {
    const double kick = request_.back + request_.forward, drift = 2 * request_.forward;
    for (std::uint32_t n = row_.first_boundary_particle; n < row_.last_boundary_particle; ++n) {
      BoundaryParticle& support = request_.boundary_particles[n];
      const double prescribed[3] = {support.velocity.x, support.velocity.y, support.velocity.z};
      double path[3];
      for (std::size_t c = 0; c < 3; ++c) {
        Stored& v = velocity(c)[support.index];
        const bool held = (support.axes >> c & 1u) != 0;
        if (held) {
          if (damped()) {  // a prescribed component has no drag
            const Kick<double> free(request_, kick, support.sum[c], support.speed_before[c],
                                    support.mass, 1 / support.mass);
            not_damped_ += free.drag * (request_.back * support.speed_before[c] +
                                        request_.forward * free.after);
          }
          v = static_cast<Stored>(prescribed[c]);
          displacement(c)[support.index] =
              static_cast<Stored>(support.place_before[c] + drift * prescribed[c]);
        }
        path[c] = request_.back * support.speed_before[c] + request_.forward * v;
        if (held)
          support.reaction_work +=
              (support.mass * (v - support.speed_before[c]) / kick - support.sum[c]) * path[c];
      }
      support.path = {path[0], path[1], path[2]};
    }
  }

  /// A prescribed component ends the half step before now with the prescribed velocity, not with
  /// the velocity that its forces would give.
  void supports_measured(RowSums& measured) {
    for (std::uint32_t n = row_.first_boundary_particle; n < row_.last_boundary_particle; ++n) {
      BoundaryParticle& support = request_.boundary_particles[n];
      const double prescribed[3] = {support.velocity.x, support.velocity.y, support.velocity.z};
      double half_path[3], momentum[3] = {0, 0, 0};
      support.reaction_now = 0;
      for (int c = 0; c < 3; ++c) {
        const double before = support.speed_before[c];
        half_path[c] = request_.back * before;
        if ((support.axes >> c & 1u) == 0) continue;
        const Kick<double> free(request_, 2 * request_.back, support.sum[c], before, support.mass,
                                1 / support.mass);
        const double after = request_.back > 0 ? prescribed[c] : before;
        const double mean = 0.5 * (before + after), free_mean = 0.5 * (before + free.after);
        measured.damped -= free.drag * half_path[c];
        measured.kinetic += 0.5 * support.mass * before * (after - free.after);
        measured.kinetic_mean += 0.5 * support.mass * (mean * mean - free_mean * free_mean);
        momentum[c] = support.mass * (mean - free_mean);
        if (request_.back > 0)
          support.reaction_now +=
              (support.mass * (after - before) / (2 * request_.back) - support.sum[c]) *
              half_path[c];
      }
      measured.momentum = measured.momentum + Vec3{momentum[0], momentum[1], momentum[2]};
      support.path = {half_path[0], half_path[1], half_path[2]};
    }
  }

  const KernelRequest& request_;
  const Row& row_;
  RowValues<OneMaterial, Real> values_;
  Pack mass_, inverse_mass_;
  Pack stored_ = 0, damped_ = 0, kinetic_ = 0, kinetic_mean_ = 0, momentum_[4] = {0, 0, 0, 0},
       potential_ = 0;
  double not_damped_ = 0;  ///< part of damped_ that was counted for prescribed components
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
