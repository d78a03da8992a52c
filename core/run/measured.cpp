#include <run/measured.hpp>
#include <state/particle_stress.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Returns the value, and computes it first if there is none.
template <class T, class Compute>
const T& once(std::optional<T>& value, const Compute& compute) {
  if (!value) value.emplace(compute());
  return *value;
}

}  // namespace

const PresentSprings& Measured::springs() {
  if (!springs_) springs_.emplace(model_, simulation_);
  return *springs_;
}

const std::vector<Symmetric>& Measured::stresses() {
  return once(stresses_, [&] { return cauchy_stresses(springs()); });
}

const std::vector<Tensor>& Measured::gradients() {
  return once(gradients_,
              [&] { return hyperlattice::gradients(springs(), springs().displacements()); });
}

const std::vector<Principal>& Measured::principals() {
  return once(principals_, [&] {
    constexpr std::size_t piece = 4096;  // particles
    const std::vector<Symmetric>& stress = stresses();
    std::vector<Principal> all(stress.size());
    simulation_.in_parallel((all.size() + piece - 1) / piece, [&](std::size_t n) {
      for (std::size_t p = n * piece; p < std::min(all.size(), (n + 1) * piece); ++p)
        all[p] = principal(stress[p]);
    });
    return all;
  });
}

const std::vector<Vec3>& Measured::internal_forces() {
  return once(internal_, [&] { return hyperlattice::internal_forces(springs()); });
}

/// Along a prescribed axis the loads and the reaction give the mass its prescribed acceleration.
const std::vector<Vec3>& Measured::external_forces() {
  return once(external_, [&] {
    const PresentLoads loads = simulation_.present_loads();
    std::vector<Vec3> forces(model_.body.particles);
    if (!(loads.acceleration == Vec3{}))
      for (Particle p = 0; p < model_.body.particles; ++p)
        forces[p] = model_.mass(p) * loads.acceleration;
    for (const LoadOnParticle& on : loads.particles) {
      Vec3& force = forces[on.particle];
      force += on.force;
      for (int c = 0; c < 3; ++c)
        if ((on.prescribed >> c & 1U) != 0)
          force[c] =
              model_.mass(on.particle) * on.acceleration[c] - internal_forces()[on.particle][c];
    }
    return forces;
  });
}

}  // namespace hyperlattice
