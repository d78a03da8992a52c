// The diagonal blocks of the stiffness of springs, and their inverses. This file is compiled once
// for each instruction set; see rows.hpp.
#include <equilibrium/rows.hpp>

namespace hyperlattice::equilibrium::HYPERLATTICE_INSTRUCTIONS {

void diagonal(const RowOfSprings& springs, int components, const Triangles& blocks);
void invert(std::int64_t count, int components, const std::uint8_t* free, const Triangles& blocks);
void divide(const Division& division, int components);

namespace {

constexpr std::int64_t chunk =
    64;  // springs computed before blocks are added, because both ends may lie in one row

/// Adds one number of the tangents of base and cross springs to the blocks of both ends; `sign` is
/// that of cross springs at the near end.
template <int size>
void add(const float (&base)[size], const float (&cross)[size], float sign, std::int64_t count,
         std::int64_t step, float* own) {
  float* other = own + step;
  for (std::int64_t t = 0; t < count; ++t) own[t] += base[t] + sign * cross[t];
  for (std::int64_t t = 0; t < count; ++t) other[t] += base[t] + cross[t];
}

/// Adds the diagonal blocks of springs. A base spring adds the same block at both ends. In a cross
/// spring heights add up while displacements are subtracted, so the numbers that mix a displacement
/// and a height have opposite signs at the two ends.
template <bool Heights, bool Deformed>
void diagonal_of(const RowOfSprings& s, const Triangles& blocks) {
  constexpr int components = Heights ? 4 : 3;
  for (std::int64_t first = 0; first < s.count; first += chunk) {
    const std::int64_t count = s.count - first < chunk ? s.count - first : chunk;
    float r[4][chunk], total[chunk], base[chunk], cross[chunk];
    for (int c = 0; c < components; ++c)
      for (std::int64_t t = 0; t < count; ++t) {
        r[c][t] = c < 3 ? s.rest[c] : 0;
        if constexpr (Deformed) r[c][t] += s.moved[c][first + t + s.step] - s.moved[c][first + t];
      }
    for (std::int64_t t = 0; t < count; ++t) {
      total[t] = s.membrane_distance;
      if constexpr (Deformed && Heights)
        total[t] += s.moved[3][first + t + s.step] + s.moved[3][first + t];
    }
    int number = 0;
    for (int a = 0; a < components; ++a)
      for (int b = a; b < components; ++b, ++number) {
        const float *x = r[a], *y = r[b], *across = b < 3 ? r[b] : total,
                    *along = a < 3 ? r[a] : total;
        for (std::int64_t t = 0; t < count; ++t) {
          base[t] = s.axial[first + t] * x[t] * y[t];
          cross[t] = 0;
          if constexpr (Heights) cross[t] = s.cross_axial[first + t] * along[t] * across[t];
          if constexpr (Deformed) {
            if (a == b) base[t] += s.pull[first + t];
            if (Heights && a == b) cross[t] += s.cross_pull[first + t];
          }
        }
        add(base, cross, (a == 3) == (b == 3) ? 1.0F : -1.0F, count, s.step,
            blocks.numbers[number] + first);
      }
  }
}

/// Returns 1 / pivot, or 0 if the pivot is at most `least`: then the component has no stiffness.
[[gnu::always_inline]] inline double inverse_of(double pivot, double least) {
  return pivot > least ? 1 / pivot : 0.0;
}

[[gnu::always_inline]] inline double larger(double a, double b) { return a > b ? a : b; }

/// Inverts blocks by K = L D L^T and K^-1 = M^T D^-1 M with M = L^-1. A component without stiffness
/// gets zeros in its row and column; the rest is inverted without it.
template <int components>
void invert_each(std::int64_t count, const std::uint8_t* free, const Triangles& blocks) {
  constexpr bool heights = components == 4;
  constexpr int at_xx = 0, at_xy = 1, at_xz = 2, at_xh = 3, at_yy = components, at_yz = at_yy + 1,
                at_yh = at_yy + 2, at_zz = 2 * components - 1, at_zh = at_zz + 1, at_hh = at_zz + 2;
  float* const* n = blocks.numbers;
#pragma omp simd
  for (std::int64_t t = 0; t < count; ++t) {
    const double fx = free[t] & 1, fy = free[t] >> 1 & 1, fz = free[t] >> 2 & 1,
                 fh = heights ? free[t] >> 3 & 1 : 0;
    const double xx = fx * double(n[at_xx][t]), xy = fx * fy * double(n[at_xy][t]),
                 xz = fx * fz * double(n[at_xz][t]), yy = fy * double(n[at_yy][t]),
                 yz = fy * fz * double(n[at_yz][t]), zz = fz * double(n[at_zz][t]);
    double xh = 0, yh = 0, zh = 0, hh = 0;
    if constexpr (heights) {
      xh = fx * fh * double(n[at_xh][t]);
      yh = fy * fh * double(n[at_yh][t]);
      zh = fz * fh * double(n[at_zh][t]);
      hh = fh * double(n[at_hh][t]);
    }
    // Heights may be 1e9 times stiffer or softer than displacements, so both have their own limit.
    const double least = 1e-7 * larger(larger(xx, yy), zz), least_height = 1e-7 * hh;
    const double dx = inverse_of(xx, least), lyx = xy * dx, lzx = xz * dx, lhx = xh * dx;
    const double dy = inverse_of(yy - lyx * xy, least), byz = yz - lyx * xz, byh = yh - lyx * xh,
                 lzy = byz * dy, lhy = byh * dy;
    const double dz = inverse_of(zz - lzx * xz - lzy * byz, least), bzh = zh - lzx * xh - lzy * byh,
                 lhz = bzh * dz;
    const double dh = inverse_of(hh - lhx * xh - lhy * byh - lhz * bzh, least_height);
    const double myx = -lyx, mzy = -lzy, mhz = -lhz, mzx = lzy * lyx - lzx, mhy = lhz * lzy - lhy,
                 mhx = -(lhx + lhy * myx + lhz * mzx);
    n[at_xx][t] = static_cast<float>(dx + dy * myx * myx + dz * mzx * mzx + dh * mhx * mhx);
    n[at_xy][t] = static_cast<float>(dy * myx + dz * mzx * mzy + dh * mhx * mhy);
    n[at_xz][t] = static_cast<float>(dz * mzx + dh * mhx * mhz);
    n[at_yy][t] = static_cast<float>(dy + dz * mzy * mzy + dh * mhy * mhy);
    n[at_yz][t] = static_cast<float>(dz * mzy + dh * mhy * mhz);
    n[at_zz][t] = static_cast<float>(dz + dh * mhz * mhz);
    if constexpr (heights) {
      n[at_xh][t] = static_cast<float>(dh * mhx);
      n[at_yh][t] = static_cast<float>(dh * mhy);
      n[at_zh][t] = static_cast<float>(dh * mhz);
      n[at_hh][t] = static_cast<float>(dh);
    }
  }
}

template <int components>
void divide_each(const Division& s) {
#pragma omp simd
  for (std::int64_t t = 0; t < s.count; ++t) {
    double sum[components] = {};
    int number = 0;
    for (int a = 0; a < components; ++a)
      for (int b = a; b < components; ++b, ++number) {
        const double value = static_cast<double>(s.inverse[number][t]);
        sum[a] += value * s.in[b][t];
        if (b > a) sum[b] += value * s.in[a][t];
      }
    for (int a = 0; a < components; ++a) s.out[a][t] = sum[a];
  }
}

}  // namespace

void diagonal(const RowOfSprings& s, int components, const Triangles& blocks) {
  const bool deformed = s.pull != nullptr;
  if (components == 4)
    deformed ? diagonal_of<true, true>(s, blocks) : diagonal_of<true, false>(s, blocks);
  else
    deformed ? diagonal_of<false, true>(s, blocks) : diagonal_of<false, false>(s, blocks);
}

void divide(const Division& division, int components) {
  components == 4 ? divide_each<4>(division) : divide_each<3>(division);
}

void invert(std::int64_t count, int components, const std::uint8_t* free, const Triangles& blocks) {
  components == 4 ? invert_each<4>(count, free, blocks) : invert_each<3>(count, free, blocks);
}

}  // namespace hyperlattice::equilibrium::HYPERLATTICE_INSTRUCTIONS
