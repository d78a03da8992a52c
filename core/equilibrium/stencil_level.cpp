#include <equilibrium/stencil_level.hpp>

#include <unordered_map>

namespace hyperlattice::equilibrium {

namespace {

GridLayout layout_of(const std::array<std::int64_t, 3>& sites, std::int64_t reach) {
  GridLayout layout;
  layout.sites = sites;
  layout.row = sites[0] + reach;
  layout.plane = layout.row * (sites[1] + reach);
  layout.origin = reach * (1 + layout.row + layout.plane);
  layout.places = layout.place(sites[0] - 1, sites[1] - 1, sites[2] - 1) + layout.origin + 1;
  layout.of_place = 4;
  layout.of_component = 1;
  return layout;
}

/// Inverts a symmetric positive block by Gauss-Jordan elimination. Rows without stiffness become 0.
void invert_block(const double* block, double* inverse) {
  constexpr int size = 4;
  // A component has no stiffness if its pivot is below 1e-7 of the largest diagonal entry. Heights
  // may be 1e9 times stiffer or softer than displacements, so both have their own limit.
  double a[4][8] = {};
  const double in_space = std::max({block[0], block[5], block[10]}), of_heights = block[15];
  for (int i = 0; i < size; ++i) {
    for (int j = 0; j < size; ++j) a[i][j] = block[i * size + j];
    a[i][4 + i] = 1;
  }
  bool empty[4] = {};
  for (int p = 0; p < size; ++p) {
    if (!(a[p][p] > 1e-7 * std::max(p < 3 ? in_space : of_heights, 0.0))) {
      empty[p] = true;
      continue;
    }
    const double pivot = 1 / a[p][p];
    for (double& value : a[p]) value *= pivot;
    for (int i = 0; i < size; ++i) {
      if (i == p || a[i][p] == 0) continue;
      const double factor = a[i][p];
      for (int j = 0; j < 8; ++j) a[i][j] -= factor * a[p][j];
    }
  }
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < size; ++j) inverse[i * size + j] = empty[i] || empty[j] ? 0 : a[i][4 + j];
}

}  // namespace

StencilLevel::StencilLevel(const std::array<std::int64_t, 3>& sites, int reach,
                           const Signatures& signatures, int threads)
    : GridLevel(layout_of(sites, reach), threads), reach_(reach) {
  constexpr std::int64_t few =
      16384;  // places; for fewer, waiting of threads takes longer than their work
  if (layout_.places < few) threads_ = 1;
  // Forward neighbours in the order of neighbour(): every one with a number above 0.
  for (std::int64_t dk = 0; dk <= reach; ++dk)
    for (std::int64_t dj = -reach; dj <= reach; ++dj)
      for (std::int64_t di = -reach; di <= reach; ++di)
        if (neighbour(di, dj, dk) > 0) steps_.push_back(di + dj * layout_.row + dk * layout_.plane);
  kind_.assign(static_cast<std::size_t>(layout_.places), 0);
  making_.assign(kind_.size(), -1);
  std::unordered_map<std::uint64_t, std::int32_t> kinds;
  const std::uint64_t* signature = signatures.data();
  layout_.for_sites([&](std::int64_t i, std::int64_t j, std::int64_t k) {
    const auto place = static_cast<std::size_t>(layout_.place(i, j, k));
    const auto [found, is_new] =
        kinds.try_emplace(*signature++, static_cast<std::int32_t>(kinds.size() + 1));
    kind_[place] = found->second;
    if (is_new) making_[place] = found->second;
  });
  kinds_ = 1 + kinds.size();
  blocks_.assign(16 * kinds_ * stride(), 0);
}

Signatures StencilLevel::signatures() const {
  Signatures all;
  layout_.for_sites([&](std::int64_t i, std::int64_t j, std::int64_t k) {
    all.push_back(
        static_cast<std::uint64_t>(kind_[static_cast<std::size_t>(layout_.place(i, j, k))]));
  });
  return all;
}

void StencilLevel::finish() {
  inverse_.assign(16 * kinds_, 0);
  in_pieces(kinds_, threads_, [&](std::size_t first, std::size_t last) {
    for (std::size_t kind = first; kind < last; ++kind)
      invert_block(blocks_.data() + at(static_cast<std::int32_t>(kind), 0),
                   inverse_.data() + 16 * kind);
  });
  largest_eigenvalue_ = power_iteration();
}

void StencilLevel::multiply(const double* x, double* y) const {
  const RowKernels& kernels = row_kernels();
  const auto rows = layout_.sites[1] * layout_.sites[2];
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::int64_t r = 0; r < rows; ++r) {
    const std::int64_t first = layout_.place(0, r % layout_.sites[1], r / layout_.sites[1]);
    kernels.stencil({layout_.sites[0], static_cast<int>(steps_.size()), steps_.data(),
                     blocks_.data(), kind_.data() + first, x + 4 * first, y + 4 * first});
  }
}

void StencilLevel::divide(std::size_t first, std::size_t last, const double* r, double* z) const {
  for (std::size_t p = first; p < last; ++p) {
    const double *inverse = inverse_.data() + 16 * static_cast<std::size_t>(kind_[p]),
                 *in = r + 4 * p;
    double* out = z + 4 * p;
    for (int a = 0; a < 4; ++a)
      out[a] = inverse[a] * in[0] + inverse[4 + a] * in[1] + inverse[8 + a] * in[2] +
               inverse[12 + a] * in[3];
  }
}

}  // namespace hyperlattice::equilibrium
