// An endless lattice: any grid's neighbours, or a list's sample, with the springs that a material's
// constants make of them.
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
  std::shared_ptr<const Listed>
      listed;         ///< in place of neighbours; null: the lattice is structured
  double volume = 0;  ///< m3, of the list's own particles
};

LatticeGeometry geometry_from(const Grid& grid);
/// The list, if there is one, stays the body's, which must outlive the geometry.
LatticeGeometry geometry_from(const Body& body);

class SpringLattice {
 public:
  SpringLattice(LatticeGeometry geometry, const MaterialConstants& constants);

  const LatticeGeometry& geometry() const { return geometry_; }
  const MaterialConstants& constants() const { return constants_; }
  double base_stiffness() const { return constants_.base_stiffness; }  ///< k, N/m
  /// As the wave analysis sees it, which only structured lattices have; points into this object.
  InfiniteLattice endless() const;

 private:
  LatticeGeometry geometry_;
  std::vector<SpringConstants> springs_;
  MaterialConstants constants_;
  double alpha_;
  KernelChoice::Membrane membrane_;
};

/// What a material may ask about a geometry, which must outlive the facts; those of the body are
/// left empty.
LatticeFacts facts_of(const LatticeGeometry& geometry);

}  // namespace hyperlattice
