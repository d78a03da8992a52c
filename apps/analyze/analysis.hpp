// The analysis of a lattice for `hyperlattice analyze`: elasticity, stability, critical time step.
#pragma once

#include <analyze/elasticity.hpp>
#include <model/stability.hpp>
#include <scene/json.hpp>

namespace hyperlattice {

/// The results for one lattice.
struct Analysis {
  LatticeElasticity elasticity;
  /// The instability of the mirrored layer; none if it is stable.
  std::optional<Instability> mirrored;
  /// A further instability, which only the two-layer lattice has.
  std::optional<Instability> opposed;
  bool listed = false;  ///< a list of springs: it has no waves, counts as stable if no stiffness is
                        ///< negative, and its critical time step depends on the body
  bool all_positive = true;  ///< listed lattice: no stiffness is negative
  Wave stiffest;
  /// 2 / omega_max of the mirrored layer, in sqrt(m / k) with the mass m of a particle; in an
  /// unstable lattice, of the waves that do not grow.
  double critical_time_step = 0;

  bool mirrored_stable() const { return !mirrored && all_positive; }
  bool two_layer_stable() const { return !mirrored && !opposed && all_positive; }
};

/// Analyses a lattice by a search of the Brillouin zone, or by its list of springs.
Analysis analyse(const SpringLattice& lattice);

/// The results as the keys of `--json` and as text. Numbers that do not exist, such as nu' of a
/// lattice without stiffness, are null.
Json analysis_json(const Analysis& analysis);
std::string analysis_text(const Analysis& analysis);

}  // namespace hyperlattice
