// Nodal volumes: the volumetric energy of a listed body. Its particles are the corners of
// tetrahedra (geometry/delaunay.hpp). With the volumes V_t of the tetrahedra of a particle and its
// volume at rest V_i0,
//   V_i = sum V_t / 4,   J_i = V_i / V_i0,   energy = sum V_i0 K_v U(J_i),   p_i = K_v U'(J_i)
//   f_a = - sum over its tetrahedra of (mean of p over their corners) dV_t/dx_a
// with U of volumetric_cell.hpp. A uniform pressure pulls on no particle inside. Every sum over the
// tetrahedra of a particle has one order. See docs/theory/volumetric.md.
#pragma once

#include <model/listed.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace hyperlattice {

/// Corners of a tetrahedron, with a positive volume up to rounding.
using Corners = std::array<std::uint32_t, 4>;

/// Returns the volume of a tetrahedron, m3, from the vectors from its first corner to the others.
inline double volume_of(const std::array<Vec3, 3>& edges) {
  return dot(edges[0], cross(edges[1], edges[2])) / 6;
}
/// Returns the derivatives of this volume by the places of the corners, m2.
std::array<Vec3, 4> volume_gradients(const std::array<Vec3, 3>& edges);

/// The tetrahedra of a list of points, and those of each point.
class Tetrahedra {
 public:
  Tetrahedra() = default;
  Tetrahedra(std::size_t points, std::vector<Corners> corners);

  std::size_t size() const { return corners_.size(); }
  const Corners& operator[](std::size_t tetrahedron) const { return corners_[tetrahedron]; }
  std::span<const Corners> all() const { return corners_; }
  /// A tetrahedron of a point, and the number of the point among its corners.
  struct Use {
    std::uint32_t tetrahedron : 30, corner : 2;
  };
  std::span<const Use> of(std::size_t point) const {
    return std::span(uses_).subspan(first_[point], first_[point + 1] - first_[point]);
  }
  double bytes() const;

 private:
  std::vector<Corners> corners_;
  std::vector<std::uint32_t> first_;  ///< [point]: its first use; one more at the end
  std::vector<Use> uses_;
};

/// Returns the tetrahedra of a body. Those with an edge longer than 2.5 springs of mean length lie
/// outside: they fill cavities and dents. So do flat ones, with a volume below 0.004 of the cube of
/// their longest edge, that have a face at the outside.
Tetrahedra tetrahedra_of(const Listed& listed);

/// The derivative of the volume of a particle by the place of one around it.
struct VolumeDerivative {
  std::uint32_t particle = 0;
  Vec3 gradient;  ///< m2
};
/// Adds a derivative to those of a volume, of which each particle has one.
void add_derivative(std::vector<VolumeDerivative>& derivatives, std::uint32_t particle,
                    Vec3 gradient);

/// The volumes of the particles of a periodic sample at rest, m3, and their derivatives.
struct SampleVolumes {
  std::vector<double> volumes;
  std::vector<std::vector<VolumeDerivative>> derivatives;
};
/// Returns them for the sample of a list. Throws std::invalid_argument if the sample is not a
/// periodic cube.
SampleVolumes volumes_of_sample(const Listed& listed);

/// The volumes of all particles at given displacements.
struct VolumeState {
  std::vector<Vec3> moved;                  ///< displacements, m
  std::vector<std::uint8_t> ended;          ///< 1: the particle has lost its energy
  std::vector<double> growths;              ///< of the volumes of the tetrahedra, m3
  std::vector<double> pressures, energies;  ///< of the particles, Pa and J; 0 where ended
};

class NodalVolumes {
 public:
  /// `moduli`: K_v of each particle, Pa. `listed` must outlive the object.
  NodalVolumes(const Listed& listed, Tetrahedra tetrahedra, std::vector<double> moduli);

  const Tetrahedra& tetrahedra() const { return tetrahedra_; }
  double bytes() const;
  std::size_t particles() const { return volumes_.size(); }
  /// Returns V_i0, m3; 0: the particle has no tetrahedron.
  double rest_volume(std::size_t particle) const { return volumes_[particle]; }
  /// Returns K_v, Pa; 0 of a particle without a volume.
  double modulus(std::size_t particle) const { return moduli_[particle]; }
  /// Returns the derivatives of the volume of a particle at rest.
  std::vector<VolumeDerivative> derivatives(std::size_t particle) const;

  /// Returns the state without displacements.
  VolumeState state() const;
  /// Finds growths, pressures and energies from the displacements. for_each(size, work) calls
  /// work(n) for all n below `size`, in any order.
  template <class ForEach>
  void evaluate(VolumeState& state, const ForEach& for_each) const {
    for_each(state.growths.size(),
             [&](std::size_t n) { state.growths[n] = growth(n, state.moved); });
    for_each(state.pressures.size(), [&](std::size_t particle) {
      if (state.ended[particle] != 0) return;
      const Response of = response(particle, state.growths);
      state.pressures[particle] = of.pressure;
      state.energies[particle] = of.energy;
    });
  }

  // The passes of an evaluation. `moved`: displacements of all particles, m.
  /// Returns the growth of the volume of a tetrahedron, m3, without cancellation.
  double growth(std::size_t tetrahedron, std::span<const Vec3> moved) const;
  /// What the volume of a particle gives.
  struct Response {
    double pressure = 0;   ///< p_i, Pa, positive if the volume grew
    double stiffness = 0;  ///< derivative of p_i by J_i, Pa
    double energy = 0;     ///< J
  };
  /// Returns the response to the growths of all tetrahedra, m3. All is 0 of a particle without an
  /// energy.
  Response response(std::size_t particle, std::span<const double> growths) const;
  /// Returns the force on a particle, N. `pressures`: of all particles, Pa.
  Vec3 force(std::size_t particle, std::span<const Vec3> moved,
             std::span<const double> pressures) const;
  /// Returns the derivatives of the volume of a tetrahedron by the places of its corners, m2.
  std::array<Vec3, 4> gradients(std::size_t tetrahedron, std::span<const Vec3> moved) const;
  /// Returns the mean pressure over the corners of a tetrahedron, Pa.
  double pressure(std::size_t tetrahedron, std::span<const double> pressures) const;

  /// Calls visit(particle) for each particle whose energy ends when the spring from a to b breaks:
  /// its ends, and the corners of the tetrahedra with this edge. May visit a particle more than
  /// once.
  template <class Visit>
  void for_ended_by(Particle from, Particle to, const Visit& visit) const {
    const auto a = static_cast<std::uint32_t>(from), b = static_cast<std::uint32_t>(to);
    visit(a);
    visit(b);
    for (const Tetrahedra::Use use : tetrahedra_.of(a)) {
      const Corners& corners = tetrahedra_[use.tetrahedron];
      for (const std::uint32_t end : corners)
        if (end == b)
          for (const std::uint32_t corner : corners) visit(corner);
    }
  }

 private:
  std::array<Vec3, 3> edges_at_rest(const Corners& corners) const;
  std::array<Vec3, 3> edges(const Corners& corners, std::span<const Vec3> moved) const;

  const Listed* listed_;
  Tetrahedra tetrahedra_;
  std::vector<double> volumes_;  ///< V_i0, m3
  std::vector<double> moduli_;   ///< K_v, Pa
};

}  // namespace hyperlattice
