// Compiled once for each instruction set; see rows.hpp.
#include "rows.hpp"

namespace hyperlattice::statics::HYPERLATTICE_INSTRUCTIONS {

namespace {

constexpr std::int64_t chunk = 64;  // springs whose forces are found before they are added: both ends may lie in one row

template <class Real, bool Heights, bool Deformed>
void springs_of(const SpringProduct<Real>& s) {
  constexpr int components = Heights ? 4 : 3;
  const std::int64_t step = s.step;
  for (std::int64_t first = 0; first < s.count; first += chunk) {
    const std::int64_t count = s.count - first < chunk ? s.count - first : chunk;
    Real force[4][chunk], both[chunk];
    const float *axial = s.axial + first, *cross_axial = Heights ? s.cross_axial + first : nullptr;
    const float *pull = Deformed ? s.pull + first : nullptr, *cross_pull = Deformed && Heights ? s.cross_pull + first : nullptr;
    const Real *vx = s.in[0] + first, *vy = s.in[1] + first, *vz = s.in[2] + first, *vh = Heights ? s.in[3] + first : nullptr;
    const float *ux = nullptr, *uy = nullptr, *uz = nullptr, *uh = nullptr;
    if constexpr (Deformed) {
      ux = s.moved[0] + first;
      uy = s.moved[1] + first;
      uz = s.moved[2] + first;
      if constexpr (Heights) uh = s.moved[3] + first;
    }
#pragma GCC ivdep
    for (std::int64_t t = 0; t < count; ++t) {
      Real rx = static_cast<Real>(s.rest[0]), ry = static_cast<Real>(s.rest[1]), rz = static_cast<Real>(s.rest[2]);
      if constexpr (Deformed) {
        rx += static_cast<Real>(ux[t + step] - ux[t]);
        ry += static_cast<Real>(uy[t + step] - uy[t]);
        rz += static_cast<Real>(uz[t + step] - uz[t]);
      }
      const Real dx = vx[t + step] - vx[t], dy = vy[t + step] - vy[t], dz = vz[t + step] - vz[t];
      const Real along = rx * dx + ry * dy + rz * dz;
      if constexpr (Heights) {
        const Real dh = vh[t + step] - vh[t], sh = vh[t + step] + vh[t];
        Real difference = 0, total = static_cast<Real>(s.membrane_distance);
        if constexpr (Deformed) {
          difference = static_cast<Real>(uh[t + step] - uh[t]);
          total += static_cast<Real>(uh[t + step] + uh[t]);
        }
        const Real base = static_cast<Real>(axial[t]) * (along + difference * dh), cross = static_cast<Real>(cross_axial[t]) * (along + total * sh);
        Real straight = 0;
        force[3][t] = base * difference;
        both[t] = cross * total;
        if constexpr (Deformed) {
          straight = static_cast<Real>(pull[t]) + static_cast<Real>(cross_pull[t]);
          force[3][t] += static_cast<Real>(pull[t]) * dh;
          both[t] += static_cast<Real>(cross_pull[t]) * sh;
        }
        const Real sum = base + cross;
        force[0][t] = sum * rx + straight * dx;
        force[1][t] = sum * ry + straight * dy;
        force[2][t] = sum * rz + straight * dz;
      } else {
        const Real base = static_cast<Real>(axial[t]) * along;
        Real straight = 0;
        if constexpr (Deformed) straight = static_cast<Real>(pull[t]);
        force[0][t] = base * rx + straight * dx;
        force[1][t] = base * ry + straight * dy;
        force[2][t] = base * rz + straight * dz;
      }
    }
    for (int c = 0; c < components; ++c) {
      Real *own = s.out[c] + first, *other = own + step;
      for (std::int64_t t = 0; t < count; ++t) own[t] -= force[c][t];
      for (std::int64_t t = 0; t < count; ++t) other[t] += force[c][t];
    }
    if constexpr (Heights) {  // cross springs press both heights the same way
      Real *own = s.out[3] + first, *other = own + step;
      for (std::int64_t t = 0; t < count; ++t) own[t] += both[t];
      for (std::int64_t t = 0; t < count; ++t) other[t] += both[t];
    }
  }
}

template <class Real>
void springs(const SpringProduct<Real>& s, int components) {
  const bool deformed = s.pull != nullptr;
  if (components == 4)
    deformed ? springs_of<Real, true, true>(s) : springs_of<Real, true, false>(s);
  else
    deformed ? springs_of<Real, false, true>(s) : springs_of<Real, false, false>(s);
}

typedef float Four __attribute__((vector_size(16)));
typedef float Block __attribute__((vector_size(64)));

template <class Vector>
Vector load(const float* from) {
  Vector v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
Block tiled(Four x) { return __builtin_shufflevector(x, x, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3); }
Block repeated(Four x) { return __builtin_shufflevector(x, x, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3); }

void stencil(const StencilProduct& s) {
  const std::int64_t stride = 16 * (1 + s.neighbours);
  for (std::int64_t t = 0; t < s.count; ++t) {
    const float *blocks = s.blocks + t * stride, *x = s.in + 4 * t;
    Block rows = load<Block>(blocks) * tiled(load<Four>(x)), columns{};
    for (int n = 0; n < s.neighbours; ++n) {
      const std::int64_t step = s.steps[n];
      rows += load<Block>(blocks + 16 * (n + 1)) * tiled(load<Four>(x + 4 * step));
      columns += load<Block>(blocks - step * stride + 16 * (n + 1)) * repeated(load<Four>(x - 4 * step));
    }
    for (int a = 0; a < 4; ++a)
      s.out[4 * t + a] =
          ((rows[4 * a] + rows[4 * a + 1]) + (rows[4 * a + 2] + rows[4 * a + 3])) + ((columns[a] + columns[4 + a]) + (columns[8 + a] + columns[12 + a]));
  }
}

void add_block(float* block, float factor, const float* other) {
  const Block sum = load<Block>(block) + factor * load<Block>(other);
  __builtin_memcpy(block, &sum, sizeof sum);
}

}  // namespace

extern const RowKernels kernels;
const RowKernels kernels{&springs<float>, &springs<double>, &stencil, &add_block};

}  // namespace hyperlattice::statics::HYPERLATTICE_INSTRUCTIONS
