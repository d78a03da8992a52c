// The volumetric energy of one row of cells (volumetric_cell.hpp), a vector of cells at a time.
//
// A cell belongs to the row of its lowest corner. Its corners are in this row, in the next rows
// along y and along z, and in the one after both. When a sweep reaches the row, none of these has
// moved, so the forces join those that the rows receive from earlier springs: no second pass.
#pragma once

#include <hyperlattice/kernel_request.hpp>
#include <hyperlattice/kernels/simd.hpp>
#include <hyperlattice/volumetric_cell.hpp>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

/// Stored: precision of displacements; Real: of forces; Energy: whether energies are wanted.
template <class Stored, class Real, bool Energy>
class CellRow {
  using Pack = PackOf<Real>;
  static constexpr int width = lanes_of<Real>;

 public:
  /// The four rows of the corners, in the order of CellCorners. Element t is in the plane of site
  /// begin + t of the first row.
  struct Rows {
    const Stored* displacement[4][3];
    Real* received[4][3];
    const std::uint16_t* alive;  ///< of the first row
    const double* moduli;        ///< of the first row; null: all are alike
  };

  /// Adds the forces of the cells at `count` sites, padded to whole vectors, to all four rows.
  /// Returns the cells' energies, J; 0 without Energy.
  [[gnu::noinline]] static Pack add(const VolumetricCells& cells, const Rows& rows, int count) {
    const double spacing = cells.spacing;
    Pack stored = 0;
    Pack last[3][4] = {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}};
    bool carries = false;  // whether `last` has forces on the next vector's first site
    for (int t = 0; t < count; t += width) {
      const auto bits = load_bits<Real>(rows.alive + t);
      const bool any_cell = has(bits, cell_bit);
      if (!any_cell && !carries) continue;
      carries = any_cell;
      const LanesOf<Real> there = lanes_with<Real>(bits, cell_bit);
      Pack h[3][3], cofactors[3][3];
      set_gradient(rows, t, 1 / (4 * spacing), h);
      set_cofactors(h, cofactors);
      const Pack growth = where(there, volume_growth(h));
      Pack modulus = cells.modulus;
      if (rows.moduli != nullptr) modulus = load_as<Real>(rows.moduli + t);
      const Response response = respond(growth);
      if constexpr (Energy)
        stored += where(there, modulus * (spacing * spacing * spacing) * response.energy);
      const Pack quarter = modulus * (spacing * spacing / 4) * response.pressure;
      for (std::size_t c = 0; c < 3; ++c) {
        const Pack x = where(there, quarter * cofactors[c][0]),
                   y = where(there, quarter * cofactors[c][1]),
                   z = where(there, quarter * cofactors[c][2]);
        // Forces on both ends of the edges along x; the ends opposite through the cell's centre
        // have the opposite forces.
        const Pack now[4] = {(z + y) + x, (z + y) - x, (z - y) + x, (z - y) - x};
        const auto shifted = [&](int n) { return one_further(last[c][n], now[n]); };
        add_to(rows.received[0][c] + t, now[0] + shifted(1));
        add_to(rows.received[1][c] + t, now[2] + shifted(3));
        add_to(rows.received[2][c] + t, -(now[3] + shifted(2)));
        add_to(rows.received[3][c] + t, -(now[1] + shifted(0)));
        for (int n = 0; n < 4; ++n) last[c][n] = now[n];
      }
    }
    return stored;
  }

 private:
  /// Pressure and energy density over K_v.
  struct Response {
    Pack pressure, energy;
  };

  static void add_to(Real* target, const Pack& value) { store(target, load(target) + value); }

  template <class Bits>
  static bool has(const Bits& bits, std::uint16_t bit) {
    std::uint64_t words[sizeof bits / 8], joined = 0;
    __builtin_memcpy(words, &bits, sizeof bits);
    for (const std::uint64_t word : words) joined |= word;
    return (joined & 0x0001000100010001U * bit) != 0;
  }

  /// Sets the mean gradients of a vector of cells from the differences along their edges.
  HYPERLATTICE_INLINE static void set_gradient(const Rows& rows, int t, double factor,
                                               Pack (&h)[3][3]) {
    for (std::size_t c = 0; c < 3; ++c) {
      Pack low[4], high[4];  // at both ends of the edges along x
      for (std::size_t r = 0; r < 4; ++r) {
        low[r] = load_as<Real>(rows.displacement[r][c] + t);
        high[r] = load_as<Real>(rows.displacement[r][c] + t + 1);
      }
      h[c][0] = factor * (((high[0] - low[0]) + (high[1] - low[1])) +
                          ((high[2] - low[2]) + (high[3] - low[3])));
      h[c][1] = factor * (((low[1] - low[0]) + (high[1] - high[0])) +
                          ((low[3] - low[2]) + (high[3] - high[2])));
      h[c][2] = factor * (((low[2] - low[0]) + (high[2] - high[0])) +
                          ((low[3] - low[1]) + (high[3] - high[1])));
    }
  }

  /// Finds y = J^(-1/3) by Newton's method from the first terms of its series. In the range, two
  /// steps are exact to rounding for doubles, one step for floats.
  HYPERLATTICE_INLINE static Response respond(const Pack& growth) {
    constexpr Real range = Real{1} / 8;
    constexpr int steps = sizeof(Real) == sizeof(double) ? 2 : 1;
    Outside<Real> outside;
    outside.look(growth, -range, range);
    if (outside) [[unlikely]]
      return lane_by_lane(growth);
    Pack y = 1 + growth * (-1.0 / 3 + growth * (2.0 / 9 - 14.0 / 81 * growth));
    for (int n = 0; n < steps; ++n) y = y + 1.0 / 3 * y * (1 - (1 + growth) * (y * y * y));
    const Pack shrunk = growth * (y * y * y) / (1 + y + y * y);  // 1 - y
    Response response{3 * y * shrunk, 0};
    if constexpr (Energy) {
      const Pack stretch = shrunk / y;
      response.energy = 4.5 * stretch * stretch;
    }
    return response;
  }

  [[gnu::noinline]] static Response lane_by_lane(const Pack& growth) {
    Real of[width], pressure[width], energy[width];
    store(of, growth);
    for (int lane = 0; lane < width; ++lane) {
      const VolumetricResponse response = volumetric_response(static_cast<double>(of[lane]));
      pressure[lane] = static_cast<Real>(response.pressure);
      energy[lane] = static_cast<Real>(response.energy);
    }
    return {load(pressure), load(energy)};
  }
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
