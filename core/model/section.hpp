// A plane section of the body at rest.
#pragma once

#include <model/model.hpp>

#include <array>
#include <span>
#include <vector>

namespace hyperlattice {

/// A base spring from particle a to particle b, a < b in the order of the lattice, that a plane
/// cuts.
struct CutSpring {
  Particle a = 0, b = 0;
  std::uint32_t neighbour = 0;  ///< see Model::spring_properties
  bool a_is_before = true;      ///< whether a is the end before the plane
};

/// A cell with a volumetric energy that a plane cuts.
struct CutCell {
  std::array<Particle, 8> corners{};  ///< in the order of CellCorners
  double modulus = 0;                 ///< K_v times the cell's share, Pa
  std::uint8_t before = 0;            ///< bit n: corner n is before the plane
};

/// A tetrahedron of nodal volumes that a plane cuts.
struct CutTetrahedron {
  std::uint32_t number = 0;  ///< in NodalVolumes::tetrahedra()
  std::uint8_t before = 0;   ///< bit n: corner n is before the plane
};

/// The springs, cells and tetrahedra that a plane cuts, and their area, m2. A plane of the area A,
/// with the unit normal n, through an infinite lattice whose springs of class 0 have cubic
/// symmetry, cuts springs of class 0 with
///   sum share R = A m n,   m = (1 / 3V) sum share R^2,
/// where R leads from the end before the plane to the end beyond it, and m is a sum over all
/// springs of class 0 in the volume V. This gives the area: N l^2 for a plane normal to an axis
/// that cuts N whole orthogonal springs of the cubic lattice, and the area of the cells if they
/// have shares.
struct PlaneSection {
  std::vector<CutSpring> springs;
  std::vector<CutCell> cells;
  std::vector<CutTetrahedron> tetrahedra;
  double area = 0;
};

/// Returns m of PlaneSection, 1/m: a spring of class 0 stands for the area share |R| / m of a crack
/// that it crosses.
double crossing_factor(const Model& model);

/// Cuts the body of the particles `among`, which are ascending, by a plane through `point`, m, with
/// a normal of any length. Particles on the plane are before it, up to 1e-9 of the spacing. The
/// springs are in the order of their ends before the plane.
PlaneSection cut(const Model& model, Vec3 point, Vec3 normal, std::span<const Particle> among);

}  // namespace hyperlattice
