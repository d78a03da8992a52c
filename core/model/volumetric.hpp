// The volumetric energies of the cells of a body (<hyperlattice/volumetric_cell.hpp>): which cells
// have one, and their K_v. A cell stands between the sites (i, j, k) and (i + 1, j + 1, k + 1).
// In a body of cells it has one material, and a partial cell counts by its share. With boundary
// "particles" every cell counts whose eight corners are particles, in full; between several
// materials its K_v is joined as the stiffness of their springs is.
#pragma once

#include <model/body.hpp>
#include <model/particle_kinds.hpp>

#include <array>
#include <vector>

namespace hyperlattice {

class Volumetric {
 public:
  /// The cells of a body in which none has a volumetric energy.
  Volumetric() = default;
  /// `of_materials`: K_v of each material, Pa. `body` and `kinds` must outlive the object.
  Volumetric(const Body& body, const ParticleKinds& kinds, std::vector<double> of_materials);

  /// Returns whether no cell has a volumetric energy.
  bool empty() const { return of_materials_.empty(); }
  /// Returns whether all cells that have a volumetric energy have the same modulus().
  bool uniform() const { return of_materials_.size() == 1 && !body_->cells.has_partial(); }
  /// Returns the largest and least K_v of the materials, Pa.
  double largest() const;
  double least() const;

  /// Returns the cells of row (j, k), ascending and disjoint, by the sites of their lowest corners.
  std::vector<Range> row(std::int32_t j, std::int32_t k) const;
  /// Returns whether the cell is one of them. Its site may be outside the grid.
  bool holds(Site cell) const;
  /// Returns K_v times the cell's share, Pa, of an existing cell; 0 if one of its springs was cut
  /// from the start.
  double modulus(Site cell) const;
  /// Calls visit(cell, modulus) for each cell of the body whose modulus is not 0.
  template <class Visit>
  void for_cells(const Visit& visit) const {
    for (std::int32_t k = 0; !empty() && k < body_->grid.sites[2]; ++k)
      for (std::int32_t j = 0; j < body_->grid.sites[1]; ++j)
        for (const Range& range : row(j, k))
          for (Site cell{range.begin, j, k}; cell.i < range.end; ++cell.i)
            if (const double own = modulus(cell); own != 0) visit(cell, own);
  }
  /// Returns the corners of a cell, in the order of CellCorners; Body::no_particle where the body
  /// has none.
  std::array<Particle, 8> corners(Site cell) const;

 private:
  void find_cut_cells();
  /// Returns K_v of an existing cell, Pa.
  double whole_modulus(Site cell) const;

  const Body* body_ = nullptr;
  const ParticleKinds* kinds_ = nullptr;
  std::vector<double> of_materials_;
  std::vector<Particle> cut_;  ///< lowest corners of the cells that lack a spring, ascending
};

}  // namespace hyperlattice
