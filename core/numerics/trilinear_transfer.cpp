#include <numerics/trilinear_transfer.hpp>

namespace hyperlattice::numerics {

namespace {

constexpr std::int64_t shortest = 4;  // smallest number of sites along an axis that is halved

/// Fine sites that are interpolated from a coarse site along an axis, with their weights.
struct Children {
  int count = 0;
  std::int64_t at[3] = {};
  double weight[3] = {};
};

Children children(const TrilinearTransfer& transfer, int axis, std::int64_t at,
                  std::int64_t sites) {
  Children found;
  const auto add = [&](std::int64_t i, double weight) {
    if (i < 0 || i >= sites) return;
    found.at[found.count] = i;
    found.weight[found.count++] = weight;
  };
  if (!transfer.halved(axis)) {
    add(at, 1);
  } else {
    add(2 * at - 1, 0.5);
    add(2 * at, 1);
    add(2 * at + 1, 0.5);
  }
  return found;
}

}  // namespace

TrilinearTransfer::TrilinearTransfer(const std::array<std::int64_t, 3>& fine) : fine_(fine) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    halved_[axis] = fine[axis] >= shortest;
    coarse_[axis] = halved_[axis] ? fine[axis] / 2 + 1 : fine[axis];
  }
}

void TrilinearTransfer::restrict_to(const GridLevel& coarse, double* to, const GridLevel& fine,
                                    const double* from) const {
  const GridLayout &c = coarse.layout(), &f = fine.layout();
  const std::int64_t rows = coarse_[1] * coarse_[2];
#pragma omp parallel num_threads(fine.threads())
  {
    std::vector<double> sum(static_cast<std::size_t>(4 * (fine_[0] + 2)));
#pragma omp for schedule(static)
    for (std::int64_t r = 0; r < rows; ++r) {
      const std::int64_t J = r % coarse_[1], K = r / coarse_[1];
      std::fill(sum.begin(), sum.end(), 0.0);
      const Children js = children(*this, 1, J, fine_[1]), ks = children(*this, 2, K, fine_[2]);
      for (int b = 0; b < ks.count; ++b)
        for (int a = 0; a < js.count; ++a) {
          const double weight = ks.weight[b] * js.weight[a];
          const std::int64_t first = f.place(0, js.at[a], ks.at[b]) * f.of_place;
          for (int component = 0; component < f.components; ++component) {
            const double* row = from + first + component * f.of_component;
            for (std::int64_t i = 0; i < fine_[0]; ++i)
              sum[static_cast<std::size_t>(4 * (i + 1) + component)] +=
                  weight * row[i * f.of_place];
          }
        }
      double* row = to + 4 * c.place(0, J, K);
      for (std::int64_t I = 0; I < coarse_[0]; ++I)
        for (std::int64_t component = 0; component < 4; ++component) {
          const double* s = sum.data() + 4 * ((halved_[0] ? 2 * I : I) + 1) + component;
          const bool beyond =
              halved_[0] && 2 * I >= fine_[0];  // the last coarse site may be beyond the box
          const double here = beyond ? 0.0 : s[0],
                       right = halved_[0] && !beyond && 2 * I + 1 < fine_[0] ? s[4] : 0.0;
          row[4 * I + component] = halved_[0] ? here + 0.5 * (s[-4] + right) : here;
        }
    }
  }
}

void TrilinearTransfer::prolong_from(const GridLevel& coarse, const double* from,
                                     const GridLevel& fine, double* to) const {
  const GridLayout &c = coarse.layout(), &f = fine.layout();
  const std::int64_t rows = fine_[1] * fine_[2];
#pragma omp parallel num_threads(fine.threads())
  {
    std::vector<double> sum(static_cast<std::size_t>(4 * (coarse_[0] + 1)));
#pragma omp for schedule(static)
    for (std::int64_t r = 0; r < rows; ++r) {
      const std::int64_t j = r % fine_[1], k = r / fine_[1];
      const Parents js = parents(1, j), ks = parents(2, k);
      std::fill(sum.begin(), sum.end(), 0.0);
      for (int b = 0; b < ks.count; ++b)
        for (int a = 0; a < js.count; ++a) {
          const double weight = ks.weight[b] * js.weight[a];
          const double* row = from + 4 * c.place(0, js.at[a], ks.at[b]);
          for (std::int64_t n = 0; n < 4 * coarse_[0]; ++n)
            sum[static_cast<std::size_t>(n)] += weight * row[n];
        }
      const std::int64_t first = f.place(0, j, k) * f.of_place;
      for (int component = 0; component < f.components; ++component) {
        double* row = to + first + component * f.of_component;
        for (std::int64_t i = 0; i < fine_[0]; ++i) {
          const Parents is = parents(0, i);
          row[i * f.of_place] +=
              is.weight[0] * sum[static_cast<std::size_t>(4 * is.at[0] + component)] +
              is.weight[1] * sum[static_cast<std::size_t>(4 * is.at[1] + component)];
        }
      }
    }
  }
  fine.mask(to);
}

}  // namespace hyperlattice::numerics
