// What a crack of any normal takes from the lattice: a chain of its layers in uniaxial strain, with
// the equations of docs/theory/cohesive.md for springs and stresses, and the damage at rest of
// state/damage_equations.hpp. A crack of the normal n takes at most 1 + t / (pi b) of G, with t the
// thickness of the layers that every spring across it meets. The numbers expected are those of an
// independent program of the same equations in slow motion, over the 0.990 of its weak layers.
#include <model/cohesive.hpp>
#include <state/damage_equations.hpp>
#include <state/damage_growth.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace layers_of_a_crack_test {
using namespace hyperlattice;

/// Springs of a particle to a layer: units are the spacing, C11 = 3 and the strength 1.
struct Spring {
  int to = 0;         ///< layers beyond the particle's own
  double cosine = 0;  ///< between spring and normal
  double length = 0;  ///< sqrt(2) of a diagonal
  double spread = 0;  ///< weight of the Laplacian
  std::array<double, 3> r{};
};

class Chain {
 public:
  Chain(std::array<int, 3> normal, double length) : length_(length) {
    const double size = std::hypot(normal[0], normal[1], normal[2]);
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) {
          const int squares = i * i + j * j + k * k;
          if (squares != 1 && squares != 2) continue;
          Spring spring;
          spring.to = i * normal[0] + j * normal[1] + k * normal[2];
          spring.length = std::sqrt(squares);
          spring.cosine = spring.to / size / spring.length;
          spring.spread = squares == 1 ? 1.0 / 3 : 1.0 / 6;
          spring.r = {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
          reach_ = std::max(reach_, spring.to);
          springs_.push_back(spring);
        }
    half_ = static_cast<int>(std::ceil(3 * length * size));
    thickness_ = 1 / size;
    damage_.assign(static_cast<std::size_t>(2 * half_ + 1), 0);
    u_.assign(damage_.size(), 0);
  }

  double peak = 0, work = 0;

  /// Pulls the chain until its stress is 0.004 of the strength.
  void pull() {
    double stress = 0, extension = 0;
    for (int state = 0; state < 200; ++state) {
      const double top = *std::max_element(damage_.begin(), damage_.end()),
                   load = advance(state == 0 ? 0.002 : std::min(0.1, 0.3 * (1 - top)));
      const double next = load * unit_stress_;
      work += 0.5 * (stress + next) * (load - extension);
      stress = next, extension = load;
      peak = std::max(peak, stress);
      if (stress < 0.004 * peak) return;
    }
    ADD_FAILURE() << "the chain does not come apart";
  }

 private:
  static constexpr double toughness_ratio_ = 3.6;  // l_ch / b, with C11 G = 3.6 b

  bool is_end(int layer) const { return std::abs(layer) > half_ - reach_; }
  std::size_t at(int layer) const { return static_cast<std::size_t>(layer + half_); }
  double shape(int layer) const {
    const double strength = strength_of(layer);
    return 2 * toughness_ratio_ / std::numbers::pi / (strength * strength);
  }
  static double strength_of(int layer) { return std::abs(layer) <= 1 ? 0.995 : 1; }
  double left(int layer) const {
    return remaining(damage_[at(layer)], 2 * toughness_ratio_ / std::numbers::pi);
  }

  /// Sets displacements at rest, and the stress, for an extension of 1.
  void find_displacements() {
    const auto band = static_cast<std::size_t>(reach_) + 1;
    const std::size_t count = u_.size();
    std::vector<double> a(count * band, 0), b(count, 0);  // a[i * band + k]: entry (i, i - k)
    std::vector<double> w(count);
    for (int layer = -half_; layer <= half_; ++layer) w[at(layer)] = left(layer);
    for (int layer = -half_; layer <= half_; ++layer) {
      const std::size_t row = at(layer);
      if (is_end(layer)) {
        a[row * band] = 1;
        b[row] = layer > 0 ? 0.5 : -0.5;
        continue;
      }
      for (const Spring& spring : springs_) {
        const int other = layer + spring.to;
        const double k = in_series(w[row], w[at(other)]) * spring.cosine * spring.cosine;
        a[row * band] += k;
        if (is_end(other))
          b[row] += k * (other > 0 ? 0.5 : -0.5);
        else if (other < layer)
          a[row * band + static_cast<std::size_t>(layer - other)] -= k;
      }
    }
    for (std::size_t i = 0; i < count; ++i)  // Cholesky without roots, in the band
      for (std::size_t k = std::min(i, band - 1) + 1; k-- > 0;) {
        double sum = a[i * band + k];
        for (std::size_t m = k + 1; m < band && m <= i; ++m)
          sum -= a[i * band + m] * a[(i - k) * band + m - k] * a[(i - m) * band];
        a[i * band + k] = k == 0 ? sum : sum / a[(i - k) * band];
      }
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 1; k < band && k <= i; ++k) b[i] -= a[i * band + k] * b[i - k];
    for (std::size_t i = 0; i < count; ++i) b[i] /= a[i * band];
    for (std::size_t i = count; i-- > 0;)
      for (std::size_t k = 1; k < band && k <= i; ++k) b[i - k] -= a[i * band + k] * b[i];
    u_ = b;
    // The force through the middle, over its area: sites have the volume 1.
    unit_stress_ = 0;
    for (int layer = -reach_; layer <= 0; ++layer)
      for (const Spring& spring : springs_)
        if (layer + spring.to > 0)
          unit_stress_ += thickness_ * in_series(w[at(layer)], w[at(layer + spring.to)]) *
                          spring.cosine * spring.cosine *
                          (u_[at(layer + spring.to)] - u_[at(layer)]);
  }

  /// The largest principal stress of a layer's particles over what is left of them.
  double stress_of(int layer) const {
    Symmetric s{};
    const double own = left(layer);
    for (const Spring& spring : springs_) {
      const double other = left(layer + spring.to), sum = own + other,
                   e = sum > 0 ? 2 * other / sum : 1,
                   pull = 0.5 * e * spring.cosine * (u_[at(layer + spring.to)] - u_[at(layer)]) /
                          spring.length;
      const auto& r = spring.r;
      s[0] += pull * r[0] * r[0], s[1] += pull * r[1] * r[1], s[2] += pull * r[2] * r[2];
      s[3] += pull * r[1] * r[2], s[4] += pull * r[0] * r[2], s[5] += pull * r[0] * r[1];
    }
    return principal_values(s).first;
  }

  /// Lets damage grow by at most `growth`, at rest with the displacements. Returns the extension.
  double advance(double growth) {
    const std::vector<double> start = damage_;
    double load = load_;
    for (int n = 0; n < 400; ++n) {
      find_displacements();
      std::vector<double> found = damage_;
      DamageEquations equations(found);
      for (int layer = -half_; layer <= half_; ++layer) {
        if (is_end(layer)) continue;
        const double ratio = load * stress_of(layer) / strength_of(layer);
        equations.add(
            {static_cast<std::uint32_t>(at(layer)), start[at(layer)], shape(layer), ratio * ratio});
        for (const Spring& spring : springs_)
          equations.add_other(static_cast<std::uint32_t>(at(layer + spring.to)),
                              length_ * length_ * spring.spread);
      }
      const double factor = equations.solve({0.2, 1e3, growth});
      double change = std::abs(factor - 1);
      for (std::size_t i = 0; i < found.size(); ++i)
        change = std::max(change, std::abs(found[i] - damage_[i]));
      load *= factor;
      damage_ = found;
      if (change < 1e-4) break;
    }
    find_displacements();
    return load_ = load;
  }

  double length_;
  int half_ = 0, reach_ = 0;
  double thickness_ = 1;  ///< of a layer
  double unit_stress_ = 0, load_ = 1;
  std::vector<Spring> springs_;
  std::vector<double> damage_, u_;
};

struct Case {
  std::array<int, 3> normal;
  int ratio;        ///< b / h
  double expected;  ///< energy over G
};
class LayersOfACrack : public testing::TestWithParam<Case> {};

TEST_P(LayersOfACrack, TakeTheEnergyOfTheirDirection) {
  const auto& [n, ratio, expected] = GetParam();
  Chain chain(n, ratio);
  chain.pull();
  // C11 is 3, the strength 1, and G = 3.6 b / C11.
  const double taken = chain.work / (3.6 * ratio / 3), size = std::hypot(n[0], n[1], n[2]),
               most = n[0] + n[1];
  const double thickness = most / size - 1 / size;  // springs reach n[0] + n[1] layers
  std::printf("%d%d%d, b/h %d: peak %.4f, energy %.4f, expected %.3f, at most %.4f\n", n[0], n[1],
              n[2], ratio, chain.peak, taken, expected, 1 + thickness / (std::numbers::pi * ratio));
  EXPECT_NEAR(chain.peak, 0.996, 0.004);
  EXPECT_NEAR(taken, expected, 0.007);
  EXPECT_LT(taken, 1.005 * (1 + thickness / (std::numbers::pi * ratio)));
}
INSTANTIATE_TEST_SUITE_P(None, LayersOfACrack,
                         testing::Values(Case{{1, 0, 0}, 5, 1.001}, Case{{1, 1, 0}, 5, 1.046},
                                         Case{{1, 1, 1}, 5, 1.026}, Case{{2, 1, 1}, 5, 1.037},
                                         Case{{3, 2, 1}, 5, 1.048}, Case{{1, 1, 0}, 10, 1.024}));

}  // namespace layers_of_a_crack_test
