// The cohesive materials of a body: the constants of their damage field, derived from what the
// user said (docs/theory/cohesive.md; shared notation: Q = (1 - d)^2, omega = Q / (A + (1 - A) Q)).
#pragma once

#include <hyperlattice/strength_surface.hpp>

#include <cmath>
#include <cstdint>
#include <vector>

namespace hyperlattice {

struct Model;
struct Stage;

/// Damage of one material. All of these are per material, not per particle.
struct Cohesive {
  std::uint8_t material = 0;
  const Stage* stage = nullptr;  ///< the failure stage; null: this material has no surface
  const void* surface = nullptr;
  double strength = 0;         ///< sigma_t, Pa; the mean if it scatters
  double fracture_energy = 0;  ///< G_c, J/m2
  double corrected = 0;        ///< G_i = G_c / (1 + 0.175 h / b), J/m2
  double length = 0;           ///< b, m
  double modulus = 0;          ///< C11 of the undamaged lattice, Pa, with the volumetric part
  double bulk_modulus = 0;     ///< K of the undamaged lattice, Pa
  double wave_speed = 0;       ///< c_p = sqrt(C11 / rho), m/s
  double viscosity = 0;        ///< tau = 0.5 b / c_p, s
  double weibull_modulus = 0;
  std::uint64_t seed = 1;
  /// Least and largest strength of the body's particles, Pa.
  double least_strength = 0, largest_strength = 0;
  /// Elongation over rest length of a base spring below which no stress reaches the surface,
  /// and the same of shortening: infinite if compressed springs alone never reach it, so that no
  /// pass looks for it. Exact for a particle whose springs have one uniform strain.
  double stretch_alarm = 0, shortening_alarm = 0;
  bool allow_coarse = false, intact_near_supports = true;
  bool crushes() const { return std::isfinite(shortening_alarm); }

  /// A = 2 C11 G_i / (pi b sigma^2) of a particle with strength sigma, Pa.
  double shape(double sigma) const;
  /// Returns the strength of a particle, Pa: sigma_t, or scattered by identity and seed.
  double strength_of(std::uint64_t particle) const;
  /// Writes how close each stress is to the surface of a particle of strength sigma_t: 1 on it.
  void ratios(std::span<const PrincipalStress> stresses, double* ratios) const;
  /// Unit of the energy density of damage, J/m3: 2 G_i / (pi b).
  double energy_unit() const;
  /// Half width of the band of a crack, m: no damage nearer than this to a support.
  double zone() const;
  /// Opening at which the traction ends, m: w_c = 2 G_c / sigma_t.
  double final_opening() const { return 2 * fracture_energy / strength; }
  /// l_ch = C11 G_i / sigma_t^2, m.
  double characteristic_length() const { return modulus * corrected / (strength * strength); }
  /// Returns the length of the zone that softens at the tip of a crack, m, about E' G_i / sigma_t^2
  /// with E' = E / (1 - nu^2) = 4 mu (C11 - mu) / C11.
  double softening_zone() const;
  /// Returns the largest strength, Pa, that this length carries (A = 3/4).
  double largest_admissible_strength() const;
  /// Returns the largest length, m, that a strength, Pa, allows on a lattice of this spacing, m;
  /// not positive: none.
  double largest_length(double sigma, double spacing) const;
};

/// The cohesive materials of a body by number of material; empty if it has none.
using CohesiveMaterials = std::vector<Cohesive>;

/// Least A: below it the equation of damage has several roots.
inline constexpr double least_shape = 0.75;

/// omega(d): what is left of the stiffness of a particle; exactly 0 for d >= 1 - 1e-4.
inline double remaining(double damage, double shape) {
  if (damage >= 1 - 1e-4) return 0;
  const double q = (1 - damage) * (1 - damage);
  return q / (shape + (1 - shape) * q);
}

/// Returns the part that remains of a spring: its halves, of the parts a and b, are in series.
inline double in_series(double a, double b) {
  const double sum = a + b;
  return sum > 0 ? 2 * a * b / sum : 0;
}

/// Returns the part of an alpha spring that remains: a thousandth at least, so that heights of dust
/// stay bounded.
inline double alpha_factor(double remaining) { return remaining < 1e-3 ? 1e-3 : remaining; }

}  // namespace hyperlattice
