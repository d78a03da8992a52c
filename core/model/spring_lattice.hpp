// An infinite lattice, from the neighbours of a grid or from the sample of a list, with the springs
// that follow from the constants of a material.
#pragma once

#include <model/waves.hpp>

#include <memory>

namespace hyperlattice {

struct LatticeGeometry {
  std::vector<NeighbourGeometry> neighbours;
  std::uint32_t spring_classes = 1;
  double spacing = 0;            ///< l, metres
  double site_volume = 0;        ///< m3
  double membrane_distance = 0;  ///< Delta, metres
  Basis basis = cubic_basis;     ///< in units of the spacing
  std::array<double, max_spring_classes> class_stiffness{1, 1, 1, 1};
  /// The list, in place of neighbours; null if the lattice is structured.
  std::shared_ptr<const Listed> listed;
  double volume = 0;  ///< volume of the particles of the list, m3
};

LatticeGeometry geometry_from(const Grid& grid);
/// For a listed body the geometry refers to the body's list, so the body must outlive it.
LatticeGeometry geometry_from(const Body& body);

class SpringLattice {
 public:
  SpringLattice(LatticeGeometry geometry, const MaterialConstants& constants);

  const LatticeGeometry& geometry() const { return geometry_; }
  const MaterialConstants& constants() const { return constants_; }
  double base_stiffness() const { return constants_.base_stiffness; }  ///< k, N/m
  /// Returns the lattice for the wave analysis, structured lattices only; it points into this
  /// object.
  InfiniteLattice endless() const;

 private:
  LatticeGeometry geometry_;
  std::vector<SpringConstants> springs_;
  MaterialConstants constants_;
  double alpha_;
  KernelChoice::Membrane membrane_;
};

/// Returns the stiffness of a material's stiffest springs, those of the membrane included, times
/// the squared spacing, J.
double largest_energy(const MaterialConstants& constants, double spacing);
/// J; the sums of more would not be finite.
constexpr double most_energy = 1e290;

/// Returns the facts that a material may ask about a geometry, which must outlive them. Facts about
/// the body stay empty.
LatticeFacts facts_of(const LatticeGeometry& geometry);

}  // namespace hyperlattice
