// Springs of the cubic 4D lattice from E and nu, and back: closed forms of the infinite lattice,
// and the paper's fitted polynomials. Functions of plain numbers. Equation numbers refer to G.-F.
// Zhao, Comput. Methods Appl. Mech. Engrg. (2017). All moduli are those of one layer; the distance
// Delta to the mirror copy is the lattice constant l.
#pragma once

#include <hyperlattice/plain.hpp>

namespace hyperlattice::calibration {

/// The membranes of the paper, the 3D lattice, and `free`, any mixture of k_alpha, k_beta, k_gamma.
enum class Membrane : std::uint32_t { none, I, II, III, IV, I_m, free };
inline constexpr std::string_view membrane_names[] = {"none", "I",   "II",  "III",
                                                      "IV",   "I-m", "free"};

/// Stiffness of the fourth-dimension springs divided by that of the base springs.
struct Ratios {
  double alpha = 0;      ///< k_alpha / k, from a particle to its own copy; not used if clamped
  double beta = 0;       ///< k_beta / k, beside orthogonal base springs
  double gamma = 0;      ///< k_gamma / k, beside diagonal base springs
  bool clamped = false;  ///< k_alpha infinite: no motion in the fourth dimension
};

/// Returns equations (1) to (5); lambda is the 4D stiffness ratio. `none` and `free` have no lambda
/// and give zeros.
constexpr Ratios ratios(Membrane membrane, double lambda) {
  switch (membrane) {
    case Membrane::I:
      return {lambda, lambda, lambda, false};
    case Membrane::II:
      return {lambda, lambda, 0, false};
    case Membrane::III:
      return {0, lambda, lambda, true};
    case Membrane::IV:
      return {0, lambda, 0, true};
    case Membrane::I_m:
      return {lambda, lambda, 0.75 * lambda, false};
    default:
      return {};
  }
}

/// Elastic constants of the infinite lattice. C1..C4 are equations (27) to (30) without their
/// common factor k l^2 / (V Delta). D1..D3 give C11, C12, C44 after the height has relaxed: C11 = k
/// D1 / 2l, and so on.
struct Elasticity {
  double C1 = 6, C2 = 2, C3 = 0, C4 = 0;
  double D1 = 6, D2 = 2, D3 = 2;

  double poisson() const { return D2 / (D1 + D2); }  ///< nu', equation (31): pull along [100]
  /// Returns nu'', equation (32): equal to nu' if isotropic.
  double poisson_shear() const { return (2 * D3 - D1) / (2 * D3 - 2 * D1); }
  /// Returns E l / k along [100].
  double modulus() const { return (D1 - D2) * (D1 + 2 * D2) / (2 * (D1 + D2)); }
  /// Returns eta = E / E(3D lattice), equation (12).
  double modulus_ratio() const { return modulus() / 2.5; }
  double zener() const { return 2 * D3 / (D1 - D2); }  ///< A: 1 if isotropic
};

constexpr Elasticity elasticity(const Ratios& r) {
  Elasticity e;
  e.C1 = 6 + r.beta + 8 * r.gamma / 3;
  e.C2 = 2 + 4 * r.gamma / 3;
  e.C3 = r.alpha + 3 * r.beta + 4 * r.gamma;
  e.C4 = r.beta + 8 * r.gamma / 3;
  const double relaxed =
      r.clamped || e.C3 == 0 ? 0 : e.C4 * e.C4 / e.C3;  // loss of stiffness by the free height
  e.D1 = e.C1 - relaxed;
  e.D2 = e.C2 - relaxed;
  e.D3 = e.C2;
  return e;
}

/// Returns the lambda that gives the infinite lattice this Poisson ratio: equation (10) in closed
/// form; 0 for `none` and `free`.
constexpr double lambda(Membrane membrane, double nu) {
  const double excess = 1 - 4 * nu;
  switch (membrane) {
    case Membrane::I:
      return 144 * excess / (25 + 118 * nu);
    case Membrane::II:
      return 8 * excess / (1 + 2 * nu);
    case Membrane::III:
      return -6 * excess / (4 - 15 * nu);
    case Membrane::IV:
      return 2 * excess / nu;
    case Membrane::I_m:
      return 7 * excess / (1 + 5 * nu);
    default:
      return 0;
  }
}

/// Range of Poisson ratios with a stable mirrored lattice: low < nu <= high, or low < nu < high if
/// `open`.
struct Reach {
  double low = 0, high = 0;
  bool open = false;

  constexpr bool holds(double nu) const { return nu > low && (open ? nu < high : nu <= high); }
};

/// Returns the range of a membrane. `none` has only 1/4; the range of `free` is not known
/// beforehand and is empty.
constexpr Reach reach(Membrane membrane) {
  switch (membrane) {
    case Membrane::none:
      return {0.25 * (1 - 1e-12), 0.25 * (1 + 1e-12), false};
    case Membrane::I:
      return {-25.0 / 118, 0.25, false};
    case Membrane::II:
      return {-0.5, 0.25, false};
    case Membrane::III:
      return {0, 4.0 / 15, true};
    case Membrane::IV:
      return {0, 1.0 / 3, true};
    case Membrane::I_m:
      return {-0.2, 0.25, false};
    case Membrane::free:
      break;
  }
  return {};
}

/// Returns k of a base spring in the infinite lattice, N/m: equations (14) and (15) for one
/// particle, V = l^3.
constexpr double stiffness_bulk(double young, double spacing, double modulus_ratio) {
  return 0.4 * young * spacing / modulus_ratio;
}

/// Returns k by equation (15) over a body, N/m, from the volume of the body and the sum of the
/// squared lengths of all its base springs. k is larger than in the infinite lattice, because the
/// sum lacks the springs that a surface does not have.
constexpr double stiffness_eq15(double young, double volume, double sum_of_squared_lengths,
                                double modulus_ratio) {
  return 6 * volume * young / (modulus_ratio * sum_of_squared_lengths);
}

/// The paper's fits for lattice I-m, from a virtual test on 20^3 particles. Valid only between
/// these Poisson ratios.
inline constexpr double paper_poisson_low = 0.04, paper_poisson_high = 0.2464;
inline constexpr double paper_cubic[] = {-211.13493779, 162.84655851, -55.42449719,
                                         6.92902211};  ///< (11), highest power first
inline constexpr double paper_quadratic[] = {-0.0078506, 0.41613615, 1.00369223};  ///< (13)
constexpr double polynomial(std::span<const double> coefficients, double x) {
  double value = 0;
  for (const double coefficient : coefficients) value = value * x + coefficient;
  return value;
}
constexpr double paper_lambda(double nu) { return polynomial(paper_cubic, nu); }  ///< equation (11)
/// Returns equation (13).
constexpr double paper_modulus_ratio(double lambda) { return polynomial(paper_quadratic, lambda); }

}  // namespace hyperlattice::calibration
