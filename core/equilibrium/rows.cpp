// Compiled once for each instruction set; see rows.hpp.
#include <equilibrium/rows.hpp>

#include <hyperlattice/kernels/simd.hpp>

namespace hyperlattice::equilibrium::HYPERLATTICE_INSTRUCTIONS {

namespace simd = hyperlattice::HYPERLATTICE_INSTRUCTIONS;

namespace {

using simd::load;
using simd::load_as;
using simd::Pack;
using simd::store;

void add(double* to, const Pack& pack) { store(to, load(to) + pack); }

/// Adds K times a field for eight places at a time and all their springs. The sums of these places
/// stay in registers until the last spring.
template <bool Heights, bool Deformed>
void springs_of(const SpringProduct& s) {
  constexpr std::size_t components = Heights ? 4 : 3;
  const float* tangent = s.tangents;
  const auto next = [&] {
    const Pack pack = load_as<double>(tangent);
    tangent += lanes;
    return pack;
  };
  for (std::int64_t t = 0; t < s.count; t += lanes) {
    Pack here[components], own[components];
    for (std::size_t c = 0; c < components; ++c) {
      here[c] = load(s.in[c] + t);
      own[c] = 0;
    }
    for (const Direction* to = s.to; to < s.to + s.neighbours; ++to) {
      const std::int64_t at = t + to->step;
      const auto moved = [&](std::size_t c) {
        return load_as<double>(s.moved[c] + at) - load_as<double>(s.moved[c] + t);
      };
      Pack r[3] = {to->rest[0], to->rest[1], to->rest[2]}, apart[components];
      for (std::size_t c = 0; c < components; ++c) apart[c] = load(s.in[c] + at) - here[c];
      if constexpr (Deformed)
        for (std::size_t c = 0; c < 3; ++c) r[c] += moved(c);
      const Pack along = r[0] * apart[0] + r[1] * apart[1] + r[2] * apart[2], axial = next();
      Pack sum, straight;  // force along the spring; stiffness (pull) against any motion
      if constexpr (Heights) {
        const Pack cross_axial = next(), together = load(s.in[3] + at) + here[3];
        Pack total = s.membrane_distance,
             both;  // force of the cross spring on the heights, equal at both ends
        if constexpr (Deformed) {
          const Pack pull = next(), cross_pull = next(), rise = moved(3);
          total += load_as<double>(s.moved[3] + at) + load_as<double>(s.moved[3] + t);
          const Pack base = axial * (along + rise * apart[3]),
                     cross = cross_axial * (along + total * together);
          const Pack difference = base * rise + pull * apart[3];
          sum = base + cross;
          straight = pull + cross_pull;
          both = cross * total + cross_pull * together;
          own[3] += both - difference;
          add(s.out[3] + at, both + difference);
        } else {
          const Pack cross = cross_axial * (along + total * together);
          sum = axial * along + cross;
          both = cross * total;
          own[3] += both;
          add(s.out[3] + at, both);
        }
      } else {
        sum = axial * along;
        if constexpr (Deformed) straight = next();
      }
      for (std::size_t c = 0; c < 3; ++c) {
        Pack force = sum * r[c];
        if constexpr (Deformed) force += straight * apart[c];
        own[c] -= force;
        add(s.out[c] + at, force);
      }
    }
    for (std::size_t c = 0; c < components; ++c)
      add(s.out[c] + t, own[c]);  // other places of the row may have added to out meanwhile
  }
}

void springs(const SpringProduct& product, int components) {
  const bool deformed = product.moved[0] != nullptr;
  if (components == 4)
    deformed ? springs_of<true, true>(product) : springs_of<true, false>(product);
  else
    deformed ? springs_of<false, true>(product) : springs_of<false, false>(product);
}

typedef double Four __attribute__((vector_size(32)));
typedef double Block __attribute__((vector_size(128)));

template <class Vector>
Vector take(const double* from) {
  Vector v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
Block tiled(Four x) {
  return __builtin_shufflevector(x, x, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3);
}
Block repeated(Four x) {
  return __builtin_shufflevector(x, x, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
}

void stencil(const StencilProduct& s) {
  const std::int64_t stride = 16 * (1 + s.neighbours);
  for (std::int64_t t = 0; t < s.count; ++t) {
    const double *blocks = s.blocks + s.kind[t] * stride, *x = s.in + 4 * t;
    Block rows = take<Block>(blocks) * tiled(take<Four>(x)), columns{};
    for (int n = 0; n < s.neighbours; ++n) {
      const std::int64_t step = s.steps[n];
      rows += take<Block>(blocks + 16 * (n + 1)) * tiled(take<Four>(x + 4 * step));
      columns += take<Block>(s.blocks + s.kind[t - step] * stride + 16 * (n + 1)) *
                 repeated(take<Four>(x - 4 * step));
    }
    for (int a = 0; a < 4; ++a)
      s.out[4 * t + a] = ((rows[4 * a] + rows[4 * a + 1]) + (rows[4 * a + 2] + rows[4 * a + 3])) +
                         ((columns[a] + columns[4 + a]) + (columns[8 + a] + columns[12 + a]));
  }
}

void add_spring(const BlockSums& sums, const CoarsePart* parts, int count, const double* base,
                const double* cross) {
  const Block of_base = take<Block>(base), of_cross = take<Block>(cross);
  for (int n = 0; n < count; ++n) {
    const std::int32_t kind = sums.making[parts[n].place];
    if (kind < 0) continue;
    double* block = sums.blocks + 16 * (kind * sums.stride + parts[n].neighbour);
    const Block sum = take<Block>(block) + of_base * take<Block>(parts[n].base) +
                      of_cross * take<Block>(parts[n].cross);
    __builtin_memcpy(block, &sum, sizeof sum);
  }
}

void add_block(double* block, double factor, const double* other) {
  const Block sum = take<Block>(block) + factor * take<Block>(other);
  __builtin_memcpy(block, &sum, sizeof sum);
}

}  // namespace

void cells(const CellProduct& product);  // cells.cpp
void diagonal(const RowOfSprings& springs, int components,
              const Triangles& blocks);  // diagonal.cpp
void invert(std::int64_t count, int components, const std::uint8_t* free, const Triangles& blocks);
void divide(const Division& division, int components);

extern const RowKernels kernels;
const RowKernels kernels{&springs, &cells,   &diagonal,   &invert,
                         &divide,  &stencil, &add_spring, &add_block};

}  // namespace hyperlattice::equilibrium::HYPERLATTICE_INSTRUCTIONS
