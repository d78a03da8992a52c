// Stress, strain and forces of the particles at one time, computed when a field asks for them.
#pragma once

#include <state/particle_strain.hpp>
#include <state/simulation.hpp>

#include <optional>
#include <vector>

namespace hyperlattice {

/// Quantities of the present state from which several fields follow. Each is computed when it is
/// first asked for.
class Measured {
 public:
  Measured(const Model& model, const Simulation& simulation)
      : model_(model), simulation_(simulation) {}

  const PresentSprings& springs();
  const std::vector<Symmetric>& stresses();    ///< Cauchy stress, Pa
  const std::vector<Tensor>& gradients();      ///< H = F - 1
  const std::vector<Principal>& principals();  ///< of the Cauchy stress
  const std::vector<Vec3>& internal_forces();  ///< N
  const std::vector<Vec3>& external_forces();  ///< N, reactions included

 private:
  const Model& model_;
  const Simulation& simulation_;
  std::optional<PresentSprings> springs_;
  std::optional<std::vector<Symmetric>> stresses_;
  std::optional<std::vector<Tensor>> gradients_;
  std::optional<std::vector<Principal>> principals_;
  std::optional<std::vector<Vec3>> internal_, external_;
};

}  // namespace hyperlattice
