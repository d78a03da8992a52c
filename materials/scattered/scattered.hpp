// A linear spring with a random stiffness: k times a factor c of Weibull's distribution, mean 1,
//   f = c k u,  c = (-ln p)^(1 / m) / Gamma(1 + 1 / m),
// with p uniform between 0 and 1, from the seed and the two particles of the spring.
#pragma once

#include <hyperlattice/chance.hpp>
#include <hyperlattice/law.hpp>

#include <cmath>

struct ScatteredLaw {
  struct Constants {
    double modulus;  ///< Weibull modulus m
    double seed;
  };
  struct Memory {
    double share;  ///< stiffness factor c
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
