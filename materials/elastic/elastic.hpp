// The law of a linear elastic spring: f = k u, with the elongation u and the energy k u^2 / 2. The
// spring is linear; the geometry of large displacements makes the body nonlinear.
#pragma once

struct ElasticLaw {
  static constexpr bool linear = true;  ///< kernels of a linear law need one division less

  template <class Real>
  static Real force(Real stiffness, Real elongation) {
    return stiffness * elongation;
  }
  template <class Real>
  static Real energy(Real stiffness, Real elongation) {
    return stiffness * elongation * elongation / 2;
  }
};
