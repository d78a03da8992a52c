// Everything that `hyperlattice analyze` says of a lattice.
#pragma once

#include <analyze/elasticity.hpp>
#include <model/stability.hpp>
#include <scene/json.hpp>

namespace hyperlattice {

struct Analysis {
  LatticeElasticity elasticity;
  std::optional<Instability> mirrored;  ///< what grows in the mirrored layer
  std::optional<Instability> opposed;   ///< what grows besides in the two-layer lattice
  bool listed = false;       ///< no waves, and stable if no spring is negative: its critical step
                             ///< depends on the body
  bool all_positive = true;  ///< of a listed lattice
  Wave stiffest;
  double critical_time_step =
      0;  ///< 2 / omega_max of the mirrored layer in sqrt(m / k), m the mass of a particle; of an
          ///< unstable lattice: of the waves that do not grow

  bool mirrored_stable() const { return !mirrored && all_positive; }
  bool two_layer_stable() const { return !mirrored && !opposed && all_positive; }
};

Analysis analyse(const SpringLattice& lattice);

/// The keys of `--json`, and the same as a page. Numbers that do not exist, such as nu' of a
/// lattice without stiffness, are null.
Json analysis_json(const Analysis& analysis);
std::string analysis_text(const Analysis& analysis);

}  // namespace hyperlattice
