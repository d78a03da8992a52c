// An endless lattice to be analysed: any lattice plugin's neighbours, with the springs that a material's constants make of them.
#pragma once

#include <model/waves.hpp>

namespace hyperlattice {

struct LatticeGeometry {
  std::vector<NeighbourGeometry> neighbours;
  std::uint32_t spring_classes = 1;
  double spacing = 0;            ///< l, metres
  double site_volume = 0;        ///< m3
  double membrane_distance = 0;  ///< Delta, metres
};

LatticeGeometry geometry_from(const Grid& grid);

/// That of a lattice plugin with spacing 1 m, by building a small body. InputError at --lattice if there is no such lattice, or if it is not one
/// that a spacing and a shape describe; OutsideError if its library is refused.
LatticeGeometry load_lattice(Host& host, const std::string& type);

class SpringLattice {
 public:
  SpringLattice(LatticeGeometry geometry, const MaterialConstants& constants);

  const LatticeGeometry& geometry() const { return geometry_; }
  double base_stiffness() const { return base_stiffness_; }  ///< k, N/m
  /// As the wave analysis sees it; points into this object.
  InfiniteLattice endless() const { return {geometry_.neighbours, springs_, alpha_, geometry_.membrane_distance, membrane_}; }

 private:
  LatticeGeometry geometry_;
  std::vector<SpringConstants> springs_;
  double base_stiffness_, alpha_;
  KernelChoice::Membrane membrane_;
};

}  // namespace hyperlattice
