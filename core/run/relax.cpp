#include <run/relax.hpp>

#include <base/errors.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace hyperlattice {

namespace {

constexpr std::uint64_t most_evaluations = 100000;

/// A number for each degree of freedom: x y z of the particles, then the heights if there are any.
using Field = std::vector<double>;

double product(const Field& a, const Field& b) { return std::inner_product(a.begin(), a.end(), b.begin(), 0.0); }
double largest(const Field& a) {
  double found = 0;
  for (const double value : a) found = std::max(found, std::abs(value));
  return found;
}
/// a + factor b
Field sum(const Field& a, double factor, const Field& b) {
  Field out(a);
  for (std::size_t n = 0; n < out.size(); ++n) out[n] += factor * b[n];
  return out;
}

class Forces {
 public:
  Forces(Simulation& simulation, const Model& model) : simulation_(simulation), model_(model), step_(model.critical_time_step) {
    simulation_.displacements(xyz_);
    simulation_.heights(heights_);
    start_ = joined();
    simulation_.step(step_);  // from here on loads prescribe what they will prescribe
  }

  const Field& start() const { return start_; }
  std::uint64_t evaluations() const { return evaluations_; }

  /// At displacements u; zero where a load holds. A step from rest gives each particle the velocity step * force / mass.
  Field at(const Field& u) {
    place(u);
    simulation_.step(step_);
    ++evaluations_;
    simulation_.velocities(xyz_);
    simulation_.height_rates(heights_);
    Field forces = joined();
    for (Particle p = 0; p < model_.body.particles; ++p) {
      const double per_velocity = model_.mass(p) / step_;
      for (std::size_t c = 0; c < 3; ++c) forces[3 * p + c] *= per_velocity;
      if (!heights_.empty()) forces[3 * model_.body.particles + p] *= per_velocity;
    }
    return forces;
  }

  /// Of the load that is pushed most, a particle's share, at displacements u.
  double mean_held(const Field& u) {
    place(u);
    const std::vector<Vec3> forces = simulation_.force_on_load();
    double mean = 0;
    for (std::size_t l = 0; l < forces.size(); ++l)
      if (!model_.loads[l].particles.empty()) mean = std::max(mean, norm(forces[l]) / static_cast<double>(model_.loads[l].particles.size()));
    return mean;
  }

  /// At rest at displacements u.
  void place(const Field& u) {
    const auto heights = u.begin() + static_cast<std::ptrdiff_t>(3 * model_.body.particles);
    xyz_.assign(u.begin(), heights);
    heights_.assign(heights, u.end());
    simulation_.set_displacements(xyz_, heights_);
    std::fill(xyz_.begin(), xyz_.end(), 0.0);
    std::fill(heights_.begin(), heights_.end(), 0.0);
    simulation_.set_velocities(xyz_, heights_);
  }

 private:
  Field joined() const {
    Field all = xyz_;
    all.insert(all.end(), heights_.begin(), heights_.end());
    return all;
  }

  Simulation& simulation_;
  const Model& model_;
  double step_;
  Field xyz_, heights_, start_;
  std::uint64_t evaluations_ = 0;
};

/// The displacements that would release the forces at u if these were linear, up to a rest of no component above `allowed`.
Field linear_answer(Forces& forces, const Field& u, const Field& force, double allowed) {
  const double nearby = 1e-5 * largest(u);  // of u, for the derivative
  Field answer(u.size(), 0.0), rest = force, direction = force;
  while (largest(rest) > allowed && forces.evaluations() < most_evaluations) {
    const double scale = nearby / largest(direction);
    const Field resistance = sum(force, -1, forces.at(sum(u, scale, direction)));  // scale * stiffness * direction
    const double square = product(rest, rest), length = scale * square / product(direction, resistance);
    if (!(length > 0) || !std::isfinite(length)) throw RunError("the body does not come to rest: it has lost its stiffness");
    answer = sum(answer, length, direction);
    rest = sum(rest, -length / scale, resistance);
    direction = sum(rest, product(rest, rest) / square, direction);
  }
  return answer;
}

}  // namespace

Rest relax(Simulation& simulation, const Model& model, double residual) {
  Forces forces(simulation, model);
  Field u = forces.start();
  Rest rest;
  while (forces.evaluations() < most_evaluations) {
    const double held = forces.mean_held(u);
    const Field force = forces.at(u);
    rest = {forces.evaluations(), largest(force) / held};
    if (rest.residual <= residual) {
      forces.place(u);
      return rest;
    }
    constexpr double reduction = 1e-4;  // more would be spent on what is not linear
    u = sum(u, 1, linear_answer(forces, u, force, std::max(residual * held / 2, reduction * largest(force))));
  }
  throw RunError(fmt::format("the body does not come to rest: after {} evaluations forces of {:.3g} of the mean force on its supports are left",
                             rest.evaluations, rest.residual));
}

}  // namespace hyperlattice
