// The tangents of nodal volumes. A place i of a list has the volume V_i, a quarter of each of its
// tetrahedra, and the pressure p_i(V_i). With the gradients g of a volume by the places of its
// corners, the stiffness is
//   K = sum_i dp_i/dV_i grad V_i (x) grad V_i + sum_t p_t d2V_t/dx2,   p_t = mean of p_i,
// the first part of rank one for each place, which joins all places around it, the second from the
// pressures. Lengths are in lattice constants, so that all numbers are N/m.
#pragma once

#include <equilibrium/numerics.hpp>

#include <hyperlattice/statics.hpp>

#include <vector>

namespace hyperlattice::equilibrium {

/// A block of 3 x 3 numbers between two places, N/m, row by row.
using VolumeBlock = std::array<double, 9>;

class VolumeTangents {
 public:
  /// `problem` must outlive the object.
  explicit VolumeTangents(const StaticProblem& problem);

  bool empty() const { return tetrahedra_.empty(); }
  /// Returns the places at the tetrahedra of a place, itself included, ascending. None if the place
  /// has no tetrahedron.
  std::span<const std::int64_t> around(std::int64_t place) const {
    const auto p = static_cast<std::size_t>(place);
    return std::span(around_).subspan(first_[p], first_[p + 1] - first_[p]);
  }
  /// Lets a response write its tangents into this object. The object must not be empty.
  void receive(SpringTangents& tangents) {
    tangents.volume_stiffness = stiffness_.data();
    tangents.volume_pressure = pressure_.data();
  }
  /// Calls visit with each array of the tangents received last.
  template <class Visit>
  void for_numbers(Visit& visit) {
    visit(stiffness_);
    visit(pressure_);
  }
  /// Calls add(a, b, block) for the blocks of the tangents received last, at the displacement of
  /// that response. Pairs of places come several times: their blocks add up.
  template <class Add>
  void for_blocks(const Field& displacement, const Add& add) const {
    std::vector<Vec3> gradients(around_.size());
    for (const StaticTetrahedron& tetrahedron : tetrahedra_) {
      const std::array<Vec3, 4> corners = places_of(tetrahedron, displacement);
      add_gradients(tetrahedron, corners, gradients);
      const double pressure = mean_pressure(tetrahedron);
      for (std::size_t m = 0; m < 4 && pressure != 0; ++m)
        for (std::size_t n = 0; n < 4; ++n)
          if (m != n)
            add(tetrahedron[m], tetrahedron[n], second_derivative(corners, m, n, pressure));
    }
    for (std::size_t p = 0; p < stiffness_.size(); ++p) {
      const auto stiffness = static_cast<double>(stiffness_[p]);
      if (stiffness == 0) continue;
      for (std::size_t m = first_[p]; m < first_[p + 1]; ++m)
        for (std::size_t n = first_[p]; n < first_[p + 1]; ++n) {
          VolumeBlock block;
          for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b)
              block[3 * a + b] = stiffness * gradients[m][a] * gradients[n][b];
          add(around_[m], around_[n], block);
        }
    }
  }

 private:
  std::array<Vec3, 4> places_of(const StaticTetrahedron& tetrahedron,
                                const Field& displacement) const;
  void add_gradients(const StaticTetrahedron& tetrahedron, const std::array<Vec3, 4>& corners,
                     std::vector<Vec3>& gradients) const;
  double mean_pressure(const StaticTetrahedron& tetrahedron) const;
  static VolumeBlock second_derivative(const std::array<Vec3, 4>& corners, std::size_t m,
                                       std::size_t n, double pressure);

  const StaticProblem& problem_;
  std::span<const StaticTetrahedron> tetrahedra_;
  std::vector<std::size_t> first_;    ///< of each place in around_, and its size at the end
  std::vector<std::int64_t> around_;  ///< the places around each place
  Floats stiffness_, pressure_;       ///< of each place; see SpringTangents
};

}  // namespace hyperlattice::equilibrium
