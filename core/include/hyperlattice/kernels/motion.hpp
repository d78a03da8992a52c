// How a row of particles moves once the forces on it are summed: damping, integration, prescribed motion; or what a measurement takes of it.
// The same for every lattice.
#pragma once

#include <hyperlattice/kernels/request.hpp>
#include <hyperlattice/kernels/simd.hpp>
#include <hyperlattice/material.hpp>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

using Membrane = KernelChoice::Membrane;
constexpr int components_of(Membrane membrane) { return membrane == Membrane::free ? 4 : 3; }

enum class Task { step, step_damped, measure };

/// Numbers of a row's particles that follow from their materials and their shares of a whole particle.
template <bool Mixed>
class RowValues {
 public:
  RowValues(const KernelRequest& request, const Row& row)
      : material_(Mixed && row.material < 0 ? request.material + row.start : nullptr),
        uniform_(row.material < 0 ? 0 : row.material),
        weight_sets_(row.weights == no_weights ? nullptr : request.weight_sets + row.weights),
        weights_(request.weights) {}

  /// `values`: of a whole particle of each material.
  Pack at(const double* values, int t) const {
    Pack pack = fill(values[uniform_]);
    if (material_ != nullptr)
      for (int lane = 0; lane < lanes; ++lane) pack[lane] = values[material_[t + lane]];
    return weight_sets_ == nullptr ? pack : pack * load(weights_ + weight_sets_[t / lanes]);
  }

 private:
  const std::uint8_t* material_;
  std::int32_t uniform_;
  const std::uint32_t* weight_sets_;
  const double* weights_;
};

/// Forces on a row start with the body acceleration's.
template <bool Mixed>
inline void set_body_force(const KernelRequest& request, const Row& row, int component, double* force) {
  const double acceleration[4] = {request.acceleration.x, request.acceleration.y, request.acceleration.z, 0};
  const RowValues<Mixed> values(request, row);
  for (int t = 0; t < row.end - row.begin; t += lanes) {
    Pack start{};
    if (acceleration[component] != 0)
      start = where(lanes_with(request.alive + row.start + t, particle_bit), acceleration[component] * values.at(request.mass, t));
    store(force + t, start);
  }
}

template <Membrane membrane, bool Mixed, Task task>
class Motion {
  static constexpr int components = components_of(membrane);
  static constexpr bool measuring = task == Task::measure;

 public:
  /// `force`: on the row's particles, from springs and body acceleration; one array a component, whole vectors.
  Motion(const KernelRequest& request, const Row& row, double* const (&force)[components]) : request_(request), row_(row), force_(force) {}

  /// `stored`: energy of the row's springs; `index`: the row's.
  void run(std::uint32_t index, Pack stored) {
    const double kick = request_.back + request_.forward, drift = 2 * request_.forward;
    const double acceleration[4] = {request_.acceleration.x, request_.acceleration.y, request_.acceleration.z, 0};
    const RowValues<Mixed> values(request_, row_);
    Pack damped{}, kinetic{}, kinetic_mean{};
    Pack momentum[4] = {}, potential{};
    supports_before();
    for (int t = 0; t < row_.end - row_.begin; t += lanes) {
      const Pack mass = values.at(request_.mass, t), inverse_mass = 1.0 / mass;
      Pack alpha{};
      if constexpr (membrane == Membrane::free) alpha = values.at(request_.alpha, t);
      for (int c = 0; c < components; ++c) {
        double* u = request_.displacement[c] + row_.start + t;
        double* v = request_.velocity[c] + row_.start + t;
        const Pack displacement = load(u), velocity = load(v);
        Pack force = load(force_[c] + t);
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
      RowSums measured;
      measured.stored = sum(stored);
      measured.kinetic = sum(kinetic);
      measured.kinetic_mean = sum(kinetic_mean);
      measured.momentum = {sum(momentum[0]), sum(momentum[1]), sum(momentum[2])};
      measured.potential = sum(potential);
      measured.damped = sum(damped);
      supports_measured(measured);
      request_.sums[index] = measured;
    } else {
      supports_after();
    }
  }

 private:
  // The few particles with external forces or prescribed motion. Their state before the row is moved waits in the support itself.
  void supports_before() {
    for (std::uint32_t n = row_.first_support; n < row_.last_support; ++n) {
      Support& support = request_.supports[n];
      const double force[3] = {support.force.x, support.force.y, support.force.z};
      for (int c = 0; c < 3; ++c) {
        double& sum_of_forces = force_[c][support.site - row_.begin];
        sum_of_forces += force[c];
        support.sum[c] = sum_of_forces;
        support.speed_before[c] = request_.velocity[c][support.index];
        support.place_before[c] = request_.displacement[c][support.index];
      }
    }
  }

  void supports_after() {
    const double kick = request_.back + request_.forward, drift = 2 * request_.forward;
    for (std::uint32_t n = row_.first_support; n < row_.last_support; ++n) {
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
  void supports_measured(RowSums& measured) {
    for (std::uint32_t n = row_.first_support; n < row_.last_support; ++n) {
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

  const KernelRequest& request_;
  const Row& row_;
  double* const (&force_)[components];
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
