// The waves of the infinite lattice. With q the wave vector and theta = q . (dx, dy, dz) for a neighbour, a base spring contributes
//   4 k sin^2(theta/2) n n^T,                                 n = r / |r|,
// and a cross spring, to whose length the heights of its two ends ADD,
//   4 k_c w w^T,   w = (r sin(theta/2), Delta cos(theta/2)) / sqrt(r^2 + Delta^2)
// (the height taken a quarter of a period late, which makes the Hermitian matrix a real one); alpha contributes 2 k_alpha to the height.
#include <model/critical_step.hpp>

#include <Eigen/Dense>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <numbers>

namespace hyperlattice {

namespace {

constexpr double pi = std::numbers::pi;
constexpr int grid = 24;            // waves along an axis of the zone; even, so that 0 and pi are among them
constexpr int refined = 6;          // how many of the best are followed to their peak
constexpr double round_off = 1e-9;  // relative to the stiffest wave

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 4, 4>;
using Modes = Eigen::SelfAdjointEigenSolver<Matrix>;

bool has_cross(const InfiniteLattice& lattice) { return lattice.membrane != KernelChoice::Membrane::none; }
bool moves_in_height(const InfiniteLattice& lattice) { return lattice.membrane == KernelChoice::Membrane::free; }

/// m omega^2 and motions of the waves of vector q.
Modes modes(const InfiniteLattice& lattice, Vec3 q) {
  Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
  for (const NeighbourGeometry& n : lattice.neighbours) {
    const SpringConstants& spring = lattice.springs[n.site.spring_class];
    const double half = (q.x * n.site.dx + q.y * n.site.dy + q.z * n.site.dz) / 2, sine = std::sin(half), cosine = std::cos(half);
    const Eigen::Vector4d base = Eigen::Vector4d(n.rest.x, n.rest.y, n.rest.z, 0) * (sine / n.rest_length);
    sum += 4 * spring.stiffness * base * base.transpose();
    if (!has_cross(lattice)) continue;
    const Eigen::Vector4d cross =
        Eigen::Vector4d(n.rest.x * sine, n.rest.y * sine, n.rest.z * sine, lattice.membrane_distance * cosine) / n.cross_rest_length;
    sum += 4 * spring.cross_stiffness * cross * cross.transpose();
  }
  sum(3, 3) += 2 * lattice.alpha;
  const int size = moves_in_height(lattice) ? 4 : 3;
  return Modes(sum.topLeftCorner(size, size));
}

/// One of the waves found, with its sign chosen so that the largest part of its motion is positive.
Wave wave(const Modes& found, Vec3 q, Eigen::Index mode) {
  Eigen::VectorXd motion = found.eigenvectors().col(mode);
  Eigen::Index largest = 0;
  motion.cwiseAbs().maxCoeff(&largest);
  if (motion(largest) < 0) motion = -motion;
  return {q, found.eigenvalues()(mode), {motion(0), motion(1), motion(2)}, motion.size() == 4 ? motion(3) : 0};
}

/// The wave vector where `value` is largest: the zone on a grid, then each of the best climbed by halved steps.
template <class Value>
Vec3 peak(const Value& value) {
  struct Candidate {
    double value;
    Vec3 q;
  };
  std::vector<Candidate> best;
  const auto above = [](const Candidate& a, const Candidate& b) { return a.value > b.value; };
  const double spacing = 2 * pi / grid;
  for (int i = 0; i <= grid / 2; ++i)  // the other half of the zone is its mirror image, q -> -q
    for (int j = -grid / 2 + 1; j <= grid / 2; ++j)
      for (int k = -grid / 2 + 1; k <= grid / 2; ++k) {
        const Vec3 q{spacing * i, spacing * j, spacing * k};
        const Candidate candidate{value(q), q};
        if (best.size() == refined && candidate.value <= best.back().value) continue;
        best.insert(std::upper_bound(best.begin(), best.end(), candidate, above), candidate);
        if (best.size() > refined) best.pop_back();
      }
  for (Candidate& candidate : best)
    for (double step = spacing / 2; step > 1e-7;) {
      Candidate next = candidate;
      for (const Vec3 direction : face_normals) {
        const Vec3 q = candidate.q + step * direction;
        if (const double here = value(q); here > next.value) next = {here, q};
      }
      if (next.value > candidate.value)
        candidate = next;
      else
        step /= 2;
    }
  return std::min_element(best.begin(), best.end(), above)->q;
}

/// Energy of homogeneous strains (xx, yy, zz, 2 yz, 2 xz, 2 xy) and of a common height (in units of l), per site: its 7 x 7 matrix.
Eigen::MatrixXd homogeneous(const InfiniteLattice& lattice) {
  using Vector7 = Eigen::Matrix<double, 7, 1>;
  Eigen::Matrix<double, 7, 7> sum = Eigen::Matrix<double, 7, 7>::Zero();
  double length = 0;
  for (const NeighbourGeometry& n : lattice.neighbours) length = std::max(length, n.rest_length);
  for (const NeighbourGeometry& n : lattice.neighbours) {
    const SpringConstants& spring = lattice.springs[n.site.spring_class];
    const auto [x, y, z] = n.rest;
    Vector7 stretch;
    stretch << x * x, y * y, z * z, y * z, x * z, x * y, 0;
    sum += spring.stiffness / (n.rest_length * n.rest_length) * stretch * stretch.transpose();
    if (!has_cross(lattice)) continue;
    stretch(6) = 2 * lattice.membrane_distance * length;
    sum += spring.cross_stiffness / (n.cross_rest_length * n.cross_rest_length) * stretch * stretch.transpose();
  }
  sum(6, 6) += 2 * lattice.alpha * length * length;
  const int size = moves_in_height(lattice) ? 7 : 6;
  return sum.topLeftCorner(size, size) / (length * length);
}

}  // namespace

Wave stiffest_wave(const InfiniteLattice& lattice) {
  const auto last = [](const Modes& found) { return found.eigenvalues().size() - 1; };
  const Vec3 q = peak([&](Vec3 at) {
    const Modes found = modes(lattice, at);
    return found.eigenvalues()(last(found));
  });
  const Modes found = modes(lattice, q);
  return wave(found, q, last(found));
}

std::optional<std::string> instability(const InfiniteLattice& lattice) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> strains(homogeneous(lattice));
  const double largest = strains.eigenvalues().cwiseAbs().maxCoeff();
  if (strains.eigenvalues()(0) < -round_off * largest) {
    static constexpr std::array<const char*, 7> names{"xx", "yy", "zz", "yz", "xz", "xy", "height"};
    std::string mode;
    for (Eigen::Index n = 0; n < strains.eigenvalues().size(); ++n)
      if (const double share = strains.eigenvectors()(n, 0); std::abs(share) > 0.01)
        mode += fmt::format("{}{} {:.3g}", mode.empty() ? "" : ", ", names[static_cast<std::size_t>(n)], share);
    return fmt::format("a homogeneous deformation (wave vector 0; {}) releases energy and grows", mode);
  }

  // Long waves are always soft; what counts is their stiffness for their length.
  const auto softness = [&](Vec3 q) {
    const double size = 4 - 4 * std::pow(std::cos(q.x / 2) * std::cos(q.y / 2) * std::cos(q.z / 2), 2);
    return size < 1e-6 ? -infinity : -modes(lattice, q).eigenvalues()(0) / size;
  };
  const Vec3 q = peak(softness);
  const Wave softest = wave(modes(lattice, q), q, 0);
  if (softest.stiffness < -round_off * largest) return describe(softest) + ", grows";
  return std::nullopt;
}

std::string describe(const Wave& wave) {
  const auto angle = [](double radians) {
    const double turns = std::remainder(radians / pi, 2.0);  // in units of pi, between -1 and 1
    if (std::abs(turns) < 1e-4) return std::string("0");
    return std::abs(std::abs(turns) - 1) < 1e-4 ? std::string("pi") : fmt::format("{:.3f} pi", turns);
  };
  const auto share = [](double part) { return fmt::format("{:.3g}", std::abs(part) < 1e-4 ? 0 : part); };
  const bool in_space = norm(wave.direction) > 1e-4;
  std::string motion = in_space ? fmt::format("along ({}, {}, {})", share(wave.direction.x), share(wave.direction.y), share(wave.direction.z)) : "";
  if (std::abs(wave.height) > 1e-4)
    motion += in_space ? fmt::format(" and by {} in the fourth dimension", share(wave.height)) : "in the fourth dimension";
  return fmt::format("the wave with vector ({}, {}, {}) a site, moving {}", angle(wave.vector.x), angle(wave.vector.y), angle(wave.vector.z), motion);
}

void StiffnessBound::add(const NeighbourGeometry& neighbour, int side, const SpringConstants& spring, double membrane_distance,
                         KernelChoice::Membrane membrane) {
  const auto add_square = [this](double stiffness, const std::array<double, 4>& n) {
    for (int row = 0, at = 0; row < 4; ++row)
      for (int column = 0; column <= row; ++column)
        sum_[at++] += std::abs(stiffness) * n[static_cast<std::size_t>(row)] * n[static_cast<std::size_t>(column)];
  };
  const auto [x, y, z] = -side * neighbour.rest;  // a particle that goes away from its neighbour lengthens the spring
  const double base = neighbour.rest_length, cross = neighbour.cross_rest_length;
  add_square(spring.stiffness, {x / base, y / base, z / base, 0});
  if (membrane == KernelChoice::Membrane::none) return;
  const double height = membrane == KernelChoice::Membrane::free ? membrane_distance / cross : 0;
  add_square(spring.cross_stiffness, {x / cross, y / cross, z / cross, height});
}

void StiffnessBound::add_alpha(double alpha) { sum_[9] += std::abs(alpha); }

double StiffnessBound::value() const {
  Eigen::Matrix4d sum;
  for (int row = 0, at = 0; row < 4; ++row)
    for (int column = 0; column <= row; ++column) sum(row, column) = sum_[at++];
  return 2 * Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d>(sum, Eigen::EigenvaluesOnly).eigenvalues()(3);  // reads the lower triangle
}

}  // namespace hyperlattice
