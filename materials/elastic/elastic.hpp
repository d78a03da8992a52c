// The law of a linear elastic spring: f = k u, with u the elongation. Geometry makes the body
// nonlinear, the spring is not.
#pragma once

struct ElasticLaw {
  static constexpr bool linear = true;  ///< lets kernels leave out a division

  template <class Real>
  static Real force(Real stiffness, Real elongation) {
    return stiffness * elongation;
  }
  template <class Real>
  static Real energy(Real stiffness, Real elongation) {
    return stiffness * elongation * elongation / 2;
  }
};
