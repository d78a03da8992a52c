// The kind of each particle, which is a material or, in a body of cells, a mixture of materials. It
// sets the mass and the alpha spring of the particle.
#pragma once

#include <base/paged_numbers.hpp>
#include <model/mixtures.hpp>

#include <cstdint>
#include <vector>

namespace hyperlattice {

/// The kinds of all particles.
struct ParticleKinds {
  /// Material of each particle; empty if there is one material, or if cells have the materials.
  PagedNumbers<std::uint8_t> material_of;
  Mixtures mixtures;  ///< for a body of cells of several materials
  /// Mass, kg, and alpha stiffness, N/m (0 if clamped), of a whole particle: first of each
  /// material, then of each mixture; index: of().
  std::vector<double> masses, alphas;

  /// Returns the particle's material. A particle between several materials has the material of most
  /// cells around it.
  std::uint8_t material(Particle particle) const {
    if (!mixtures.empty()) return mixtures.commonest(mixtures.of(particle));
    return material_of.empty() ? std::uint8_t{0} : material_of[particle];
  }
  /// Returns the particle's kind, its index in `masses` and `alphas`.
  std::uint32_t of(Particle particle) const {
    return mixtures.empty() ? material(particle) : mixtures.of(particle);
  }
};

}  // namespace hyperlattice
