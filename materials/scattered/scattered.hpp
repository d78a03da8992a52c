// A linear spring whose stiffness is its own: k times a number that scatters as Weibull's,
//   f = c k u,  c = (-ln p)^(1 / m) / Gamma(1 + 1 / m),  1 in the mean,
// p by chance from the seed and the spring's particles.
#pragma once

#include <hyperlattice/chance.hpp>
#include <hyperlattice/law.hpp>

#include <cmath>

struct ScatteredLaw {
  struct Constants {
    double modulus;  ///< m
    double seed;
  };
  struct Memory {
    double share;  ///< c
  };

  static double share(double modulus, double p) {
    return std::pow(-std::log(p), 1 / modulus) / std::tgamma(1 + 1 / modulus);
  }

  static Memory start(const Constants& c, const hyperlattice::SpringIdentity& spring) {
    return {share(c.modulus,
                  hyperlattice::chance(static_cast<std::uint64_t>(c.seed), spring.a, spring.b))};
  }
  static void update(const hyperlattice::SpringState&, const Constants&, Memory&) {}
  static double force(const hyperlattice::SpringState& s, const Constants&, const Memory& m) {
    return m.share * s.stiffness * s.elongation;
  }
  static double energy(const hyperlattice::SpringState& s, const Constants&, const Memory& m) {
    return 0.5 * m.share * s.stiffness * s.elongation * s.elongation;
  }
};
