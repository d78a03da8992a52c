// The product of the tangents of cells and a field (cell_tangent.hpp), eight cells at a time. This
// file is compiled once for each instruction set; see rows.hpp.
#include <equilibrium/rows.hpp>

#include <hyperlattice/kernels/simd.hpp>
#include <hyperlattice/volumetric_cell.hpp>

namespace hyperlattice::equilibrium::HYPERLATTICE_INSTRUCTIONS {

namespace simd = hyperlattice::HYPERLATTICE_INSTRUCTIONS;

void cells(const CellProduct& product);

namespace {

using simd::load_as;
using simd::Pack;

/// Sets sum[d] to the sum over the corners of one component of a field times their signs along d.
template <class Number>
HYPERLATTICE_INLINE void sum_over_corners(const CellProduct& s, const Number* field,
                                          Pack (&sum)[3]) {
  Pack low[4], high[4];  // at both ends of the edges along x
  for (int r = 0; r < 4; ++r) {
    const Number* row = field + (r & 1) * s.row + (r >> 1) * s.plane;
    low[r] = load_as<double>(row);
    high[r] = load_as<double>(row + 1);
  }
  sum[0] = ((high[0] - low[0]) + (high[1] - low[1])) + ((high[2] - low[2]) + (high[3] - low[3]));
  sum[1] = ((low[1] - low[0]) + (high[1] - high[0])) + ((low[3] - low[2]) + (high[3] - high[2]));
  sum[2] = ((low[2] - low[0]) + (high[2] - high[0])) + ((low[3] - low[1]) + (high[3] - high[1]));
}

/// Adds one component of the forces of cells to the corners: sum over d of stress[d] times the
/// corner's sign along d.
HYPERLATTICE_INLINE void add_to_corners(const CellProduct& s, const Pack (&stress)[3],
                                        double* out) {
  const Pack along = stress[2] + stress[1], across = stress[2] - stress[1];
  const auto add = [&](int r, const Pack& low, const Pack& high) {
    double* row = out + (r & 1) * s.row + (r >> 1) * s.plane;
    simd::store(row, simd::load(row) + low);
    simd::store(row + 1, simd::load(row + 1) + high);
  };
  add(0, -along - stress[0], stress[0] - along);
  add(1, -across - stress[0], stress[0] - across);
  add(2, across - stress[0], across + stress[0]);
  add(3, along - stress[0], along + stress[0]);
}

/// Returns component (c, d) of the derivative of the cofactors of f along g.
HYPERLATTICE_INLINE Pack turned(const Pack (&f)[3][3], const Pack (&g)[3][3], int c, int d) {
  const int y = (c + 1) % 3, z = (c + 2) % 3, first = (d + 1) % 3, second = (d + 2) % 3;
  return (f[y][first] * g[z][second] - f[z][first] * g[y][second]) +
         (g[y][first] * f[z][second] - g[z][first] * f[y][second]);
}

/// Returns the tangents of a vector of cells from cell t on; 0 beyond the row, where the next row's
/// cells follow.
HYPERLATTICE_INLINE Pack tangents(const CellProduct& s, const float* of_row, std::int64_t t) {
  if (t + lanes <= s.count) return load_as<double>(of_row + t);
  float last[lanes] = {};
  for (std::int64_t n = 0; n < s.count - t; ++n) last[n] = of_row[t + n];
  return load_as<double>(last);
}

template <bool Deformed>
void cells_of(const CellProduct& s) {
  for (std::int64_t t = 0; t < s.count; t += lanes) {
    bool any_cell = false;
    for (std::int64_t n = t; n < t + lanes && n < s.count; ++n) any_cell |= s.stiffness[n] != 0;
    if (!any_cell) continue;
    Pack moved[3][3];
    for (int c = 0; c < 3; ++c) sum_over_corners(s, s.in[c] + t, moved[c]);
    const Pack a = tangents(s, s.stiffness, t);
    if constexpr (Deformed) {
      Pack gradient[3][3], cofactors[3][3];
      for (int c = 0; c < 3; ++c) {
        sum_over_corners(s, s.moved[c] + t, gradient[c]);
        for (int d = 0; d < 3; ++d) gradient[c][d] *= 0.25;
      }
      set_cofactors(gradient, cofactors);
      for (int c = 0; c < 3; ++c) gradient[c][c] += 1;
      Pack growth = 0;
      for (int c = 0; c < 3; ++c)
        for (int d = 0; d < 3; ++d) growth += cofactors[c][d] * moved[c][d];
      growth *= a;
      const Pack b = tangents(s, s.pressure, t);
      for (int c = 0; c < 3; ++c) {
        Pack stress[3];
        for (int d = 0; d < 3; ++d)
          stress[d] = growth * cofactors[c][d] + b * turned(gradient, moved, c, d);
        add_to_corners(s, stress, s.out[c] + t);
      }
    } else {
      const Pack growth = a * (moved[0][0] + moved[1][1] + moved[2][2]);
      for (int c = 0; c < 3; ++c) {
        Pack stress[3] = {0, 0, 0};
        stress[c] = growth;
        add_to_corners(s, stress, s.out[c] + t);
      }
    }
  }
}

}  // namespace

void cells(const CellProduct& product) {
  product.pressure != nullptr ? cells_of<true>(product) : cells_of<false>(product);
}

}  // namespace hyperlattice::equilibrium::HYPERLATTICE_INSTRUCTIONS
