// The force through a plane section: the sum over the springs that the plane cuts of their pull on
// the end before the plane, and over the cells and tetrahedra with a volumetric energy of their
// forces on the corners before the plane. It is what the part beyond does to the part before, exact
// to round-off, because springs and cells on one side of the plane cancel.
#pragma once

#include <model/section.hpp>
#include <state/block_set.hpp>
#include <state/clock.hpp>
#include <state/damage_field.hpp>
#include <state/nodal_pressures.hpp>

#include <hyperlattice/output.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace hyperlattice {

class SectionForces {
 public:
  /// Follows the springs of the section that still exist.
  SectionForces(const BlockSet& blocks, const Clock& clock, const NodalPressures& pressures,
                const DamageField& damage, const PlaneSection& section);

  /// Whether the pressures must be updated before sum() for the present state.
  bool asks_pressures() const { return !tetrahedra_.empty(); }
  /// Returns the force in the present state, with the moment about a point, m. A law with a memory
  /// gives the force that it has after a step to the present elongation, as a measurement does.
  Resultant sum(Vec3 about) const;

 private:
  struct End {
    Particle particle = 0;
    const Block* block = nullptr;
    std::uint64_t index = 0;
  };
  /// A spring, named as kernels of the block of its end a do.
  struct Spring {
    End a, b;
    std::uint32_t row = 0, number = 0;
    std::int32_t site = 0;
    std::uint32_t neighbour = 0;  ///< see Model::spring_properties
    bool a_is_before = true;
  };
  /// A cell with a volumetric energy; the bit cell_bit of its first corner says whether it acts.
  struct Cell {
    std::array<End, 8> corners;
    double modulus = 0;       ///< K_v times the cell's share, Pa
    std::uint8_t before = 0;  ///< bit n: corner n is before the plane
  };
  End end_of(Particle particle) const;
  static Vec3 moved(const End& end);
  void add(const Cell& cell, Vec3 about, Resultant& sum) const;
  void add(const Spring& spring, double remains, Vec3 about, Resultant& sum) const;
  std::optional<double> remaining(const Spring& spring) const;
  void add(const CutTetrahedron& cut, Vec3 about, Resultant& sum) const;

  const BlockSet& blocks_;
  const Model& model_;
  const Clock& clock_;
  const NodalPressures& pressures_;
  const DamageField& damage_;
  std::vector<Spring> springs_;
  /// First spring of each piece of a sum, and the number of springs. Pieces are ranges of all
  /// springs of the section: they do not depend on which of these exist.
  std::vector<std::size_t> pieces_;
  std::vector<Cell> cells_;
  std::vector<CutTetrahedron> tetrahedra_;
};

}  // namespace hyperlattice
