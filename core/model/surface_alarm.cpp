// The strains of all springs of a particle lie between -c and e. With one uniform strain E around
// the particle that is -c <= n.E.n <= e for each direction n of the springs: a polytope of six
// dimensions. A convex ratio has its maximum at a corner of it, so that corners are enough. The
// ratio is homogeneous, so only c / e matters: with the maximum M for e = 1, the stretch 1 / M is
// the alarm.
#include <model/surface_alarm.hpp>

#include <Eigen/Dense>

#include <algorithm>
#include <bit>
#include <vector>

namespace hyperlattice {

namespace {

using Strain = Eigen::Matrix<double, 6, 1>;  // xx, yy, zz, 2 yz, 2 xz, 2 xy
using Strains = Eigen::Matrix<double, 6, 6>;

/// Six directions of springs, as bits, and the strains that their stretches give.
struct Corner {
  std::uint32_t directions = 0;
  Strains by_stretch;
};

class Polytope {
 public:
  explicit Polytope(std::span<const NeighbourGeometry> springs) {
    directions_.resize(static_cast<Eigen::Index>(springs.size()), Eigen::NoChange);
    for (std::size_t n = 0; n < springs.size(); ++n) {
      const Vec3 d = (1 / springs[n].rest_length) * springs[n].rest;
      directions_.row(static_cast<Eigen::Index>(n)) << d.x * d.x, d.y * d.y, d.z * d.z, d.y * d.z,
          d.x * d.z, d.x * d.y;
    }
    for (std::uint32_t bits = 0; bits < 1U << springs.size(); ++bits)
      if (std::popcount(bits) == 6) add(bits);
  }

  /// Returns the corners for stretches from -shortened to 1.
  std::vector<Strain> corners(double shortened) const {
    std::vector<Strain> found;
    const double nearly = 1e-9 * (1 + shortened);
    for (const Corner& corner : corners_)
      for (std::uint32_t signs = 0; signs < 1U << 6; ++signs) {
        Strain stretches;
        for (int n = 0; n < 6; ++n) stretches(n) = (signs >> n & 1) != 0 ? -shortened : 1;
        const Strain strain = corner.by_stretch * stretches;
        const Eigen::VectorXd all = directions_ * strain;
        if (all.maxCoeff() <= 1 + nearly && all.minCoeff() >= -shortened - nearly)
          found.push_back(strain);
      }
    return found;
  }

 private:
  void add(std::uint32_t bits) {
    Strains chosen;
    Eigen::Index filled = 0;
    for (Eigen::Index n = 0; n < directions_.rows(); ++n)
      if ((bits >> n & 1) != 0) chosen.row(filled++) = directions_.row(n);
    const Eigen::FullPivLU<Strains> solved(chosen);
    if (solved.isInvertible()) corners_.push_back({bits, solved.inverse()});
  }

  Eigen::Matrix<double, Eigen::Dynamic, 6> directions_;
  std::vector<Corner> corners_;
};

PrincipalStress principal(const ElasticConstants& of, const Strain& strain) {
  const double trace = strain.head<3>().sum();
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();
  for (Eigen::Index n = 0; n < 3; ++n)
    stress(n, n) = of.C12 * trace + (of.C11 - of.C12) * strain(n);
  stress(2, 1) = of.C44 * strain(3);
  stress(2, 0) = of.C44 * strain(4);
  stress(1, 0) = of.C44 * strain(5);
  // Only the lower triangle is read; the values ascend.
  const Eigen::Vector3d values =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(stress, Eigen::EigenvaluesOnly).eigenvalues();
  return {values(2), values(1), values(0)};
}

}  // namespace

SurfaceAlarm surface_alarm(std::span<const NeighbourGeometry> springs,
                           const ElasticConstants& constants, const SurfaceRatios& ratios) {
  const Polytope polytope(springs);
  const auto largest = [&](double shortened) {
    std::vector<PrincipalStress> stresses;
    const std::vector<Strain> corners = polytope.corners(shortened);
    stresses.reserve(corners.size());
    for (const Strain& corner : corners) stresses.push_back(principal(constants, corner));
    std::vector<double> found(stresses.size());
    ratios(stresses, found.data());
    if (found.empty()) return infinity;
    return *std::max_element(found.begin(), found.end());
  };
  // A larger shortening costs stretch. Waves stretch and shorten alike, so a moderate one is
  // enough.
  constexpr double most = 0x1p14, dearest = 1.5;
  const double tension = largest(1);
  double shortened = 1, reached = tension;
  while (shortened < most) {
    const double next = largest(2 * shortened);
    if (!(next <= dearest * tension)) break;
    shortened *= 2;
    reached = next;
  }
  // Stresses grow with the length of stretched springs; the strain is uniform only about so.
  constexpr double caution = 0.9;
  const double stretch = caution / reached / (1 + 3 / reached);
  return {stretch, shortened < most ? stretch * shortened : infinity};
}

}  // namespace hyperlattice
