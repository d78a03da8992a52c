// Compiled once for each instruction set; see rows.hpp.
#include "rows.hpp"

namespace hyperlattice::statics::HYPERLATTICE_INSTRUCTIONS {

namespace {

constexpr std::int64_t chunk = 64;  // springs whose forces are found before they are added: both ends may lie in one row

template <bool Heights, bool Deformed>
void springs_of(const RowOfSprings& s, const SpringProduct& product) {
  constexpr int components = Heights ? 4 : 3;
  const std::int64_t step = s.step;
  for (std::int64_t first = 0; first < s.count; first += chunk) {
    const std::int64_t count = s.count - first < chunk ? s.count - first : chunk;
    double force[4][chunk], both[chunk];
    const float *axial = s.axial + first, *cross_axial = Heights ? s.cross_axial + first : nullptr;
    const float *pull = Deformed ? s.pull + first : nullptr, *cross_pull = Deformed && Heights ? s.cross_pull + first : nullptr;
    const double *vx = product.in[0] + first, *vy = product.in[1] + first, *vz = product.in[2] + first,
                 *vh = Heights ? product.in[3] + first : nullptr;
    const float *ux = nullptr, *uy = nullptr, *uz = nullptr, *uh = nullptr;
    if constexpr (Deformed) {
      ux = s.moved[0] + first;
      uy = s.moved[1] + first;
      uz = s.moved[2] + first;
      if constexpr (Heights) uh = s.moved[3] + first;
    }
    for (std::int64_t t = 0; t < count; ++t) {
      double rx = static_cast<double>(s.rest[0]), ry = static_cast<double>(s.rest[1]), rz = static_cast<double>(s.rest[2]);
      if constexpr (Deformed) {
        rx += static_cast<double>(ux[t + step] - ux[t]);
        ry += static_cast<double>(uy[t + step] - uy[t]);
        rz += static_cast<double>(uz[t + step] - uz[t]);
      }
      const double dx = vx[t + step] - vx[t], dy = vy[t + step] - vy[t], dz = vz[t + step] - vz[t];
      const double along = rx * dx + ry * dy + rz * dz;
      if constexpr (Heights) {
        const double dh = vh[t + step] - vh[t], sh = vh[t + step] + vh[t];
        double difference = 0, total = static_cast<double>(s.membrane_distance);
        if constexpr (Deformed) {
          difference = static_cast<double>(uh[t + step] - uh[t]);
          total += static_cast<double>(uh[t + step] + uh[t]);
        }
        const double base = static_cast<double>(axial[t]) * (along + difference * dh),
                     cross = static_cast<double>(cross_axial[t]) * (along + total * sh);
        double straight = 0;
        force[3][t] = base * difference;
        both[t] = cross * total;
        if constexpr (Deformed) {
          straight = static_cast<double>(pull[t]) + static_cast<double>(cross_pull[t]);
          force[3][t] += static_cast<double>(pull[t]) * dh;
          both[t] += static_cast<double>(cross_pull[t]) * sh;
        }
        const double sum = base + cross;
        force[0][t] = sum * rx + straight * dx;
        force[1][t] = sum * ry + straight * dy;
        force[2][t] = sum * rz + straight * dz;
      } else {
        const double base = static_cast<double>(axial[t]) * along;
        double straight = 0;
        if constexpr (Deformed) straight = static_cast<double>(pull[t]);
        force[0][t] = base * rx + straight * dx;
        force[1][t] = base * ry + straight * dy;
        force[2][t] = base * rz + straight * dz;
      }
    }
    for (int c = 0; c < components; ++c) {
      double *own = product.out[c] + first, *other = own + step;
      for (std::int64_t t = 0; t < count; ++t) own[t] -= force[c][t];
      for (std::int64_t t = 0; t < count; ++t) other[t] += force[c][t];
    }
    if constexpr (Heights) {  // cross springs press both heights the same way
      double *own = product.out[3] + first, *other = own + step;
      for (std::int64_t t = 0; t < count; ++t) own[t] += both[t];
      for (std::int64_t t = 0; t < count; ++t) other[t] += both[t];
    }
  }
}

void springs(const RowOfSprings& s, int components, const SpringProduct& product) {
  const bool deformed = s.pull != nullptr;
  if (components == 4)
    deformed ? springs_of<true, true>(s, product) : springs_of<true, false>(s, product);
  else
    deformed ? springs_of<false, true>(s, product) : springs_of<false, false>(s, product);
}

typedef double Four __attribute__((vector_size(32)));
typedef double Block __attribute__((vector_size(128)));

template <class Vector>
Vector load(const double* from) {
  Vector v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
Block tiled(Four x) { return __builtin_shufflevector(x, x, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3); }
Block repeated(Four x) { return __builtin_shufflevector(x, x, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3); }

void stencil(const StencilProduct& s) {
  const std::int64_t stride = 16 * (1 + s.neighbours);
  for (std::int64_t t = 0; t < s.count; ++t) {
    const double *blocks = s.blocks + t * stride, *x = s.in + 4 * t;
    Block rows = load<Block>(blocks) * tiled(load<Four>(x)), columns{};
    for (int n = 0; n < s.neighbours; ++n) {
      const std::int64_t step = s.steps[n];
      rows += load<Block>(blocks + 16 * (n + 1)) * tiled(load<Four>(x + 4 * step));
      columns += load<Block>(blocks - step * stride + 16 * (n + 1)) * repeated(load<Four>(x - 4 * step));
    }
    for (int a = 0; a < 4; ++a)
      s.out[4 * t + a] = ((rows[4 * a] + rows[4 * a + 1]) + (rows[4 * a + 2] + rows[4 * a + 3])) +
                         ((columns[a] + columns[4 + a]) + (columns[8 + a] + columns[12 + a]));
  }
}

void add_spring(double* blocks, const CoarsePart* parts, int count, const double* base, const double* cross) {
  const Block of_base = load<Block>(base), of_cross = load<Block>(cross);
  for (int n = 0; n < count; ++n) {
    double* block = blocks + parts[n].block;
    const Block sum = load<Block>(block) + of_base * load<Block>(parts[n].base) + of_cross * load<Block>(parts[n].cross);
    __builtin_memcpy(block, &sum, sizeof sum);
  }
}

void add_block(double* block, double factor, const double* other) {
  const Block sum = load<Block>(block) + factor * load<Block>(other);
  __builtin_memcpy(block, &sum, sizeof sum);
}

}  // namespace

void diagonal(const RowOfSprings& springs, int components, const Triangles& blocks);  // diagonal.cpp
void invert(std::int64_t count, int components, const std::uint8_t* free, const Triangles& blocks);

extern const RowKernels kernels;
const RowKernels kernels{&springs, &diagonal, &invert, &stencil, &add_spring, &add_block};

}  // namespace hyperlattice::statics::HYPERLATTICE_INSTRUCTIONS
