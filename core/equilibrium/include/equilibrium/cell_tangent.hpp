// The tangent of the volumetric energy of one cell (<hyperlattice/volumetric_cell.hpp>). With the
// motion x_a of its corners and G = sum x_a (x) s_a it is the second derivative
//   G.K.G' = a (cof F : G) (cof F : G') + b d2J/dF2 (G, G'),   a = p' l / 16,  b = p l / 16,
//   d2J / dF_cd dF_c'd' = e_cc'e e_dd'f F_ef,
// the first part of rank one, the second from the pressure.
#pragma once

namespace hyperlattice::equilibrium {

/// The derivatives of G[c][d] by the displacement c of one corner, or of one coarse site.
struct CellMode {
  double by[3][3] = {};
};

struct CellTangent {
  double stiffness = 0, pressure = 0;  ///< a and b, N/m
  double gradient[3][3] = {};          ///< F
  double cofactors[3][3] = {};         ///< of F

  /// Adds the block between two modes to a block of 4 x 4 numbers, row by row.
  void add_block(const CellMode& from, const CellMode& to, double* block) const {
    double growth_from[3] = {}, growth_to[3] = {};
    for (int c = 0; c < 3; ++c)
      for (int d = 0; d < 3; ++d) {
        growth_from[c] += cofactors[c][d] * from.by[c][d];
        growth_to[c] += cofactors[c][d] * to.by[c][d];
      }
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        block[4 * a + b] += stiffness * growth_from[a] * growth_to[b];
        if (a == b || pressure == 0) continue;
        const int e = 3 - a - b;
        const double sign = (a + 1) % 3 == b ? 1 : -1;
        const double *x = from.by[a], *y = to.by[b], *f = gradient[e];
        block[4 * a + b] +=
            sign * pressure *
            (f[0] * (x[1] * y[2] - x[2] * y[1]) + f[1] * (x[2] * y[0] - x[0] * y[2]) +
             f[2] * (x[0] * y[1] - x[1] * y[0]));
      }
  }
};

}  // namespace hyperlattice::equilibrium
