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

const std::vector<Vec3>& Measured::external_forces() {
  return once(external_, [&] {
    return simulation_.external_forces(
        [&]() -> const std::vector<Vec3>& { return internal_forces(); });
  });
}

}  // namespace hyperlattice
