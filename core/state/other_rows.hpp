// Rows whose springs the kernel of the first law does not compute. A row of one law goes to the
// kernel of this law. A row with springs of several laws, or of several sets of constants, is
// computed here, one spring after another, as the theory states it (kernels/reference.hpp). The
// forces of nodal volumes, of soft springs and of local steps join those of a row here.
#pragma once

#include <state/block_set.hpp>
#include <state/damage_field.hpp>
#include <state/local_steps.hpp>
#include <state/nodal_pressures.hpp>
#include <state/spring_review.hpp>

namespace hyperlattice {

class OtherRows {
 public:
  OtherRows(const BlockSet& blocks, const SpringReview& review, const NodalPressures& pressures,
            const DamageField& damage, const LocalForces& local)
      : blocks_(blocks),
        model_(blocks.model()),
        review_(review),
        pressures_(pressures),
        damage_(damage),
        local_(local) {}

  /// Computes a row's forces and its energies. A measurement changes nothing but the forces and
  /// Block::other_sums.
  void compute(Block& block, const KernelRequest& request, const RowPlace& place,
               bool measures) const;

 private:
  template <class Real>
  double add_volumes(const Block& block, const KernelRequest& request, const Row& row) const;
  template <class Real, class Source>
  double add_forces(const Source& source, const Block& block, const KernelRequest& request,
                    const RowPlace& place) const;
  RowEnergies several_laws_of_grid(Block& block, const KernelRequest& request,
                                   const RowPlace& place, bool measures) const;
  RowEnergies several_laws_of_list(Block& block, const KernelRequest& request,
                                   const RowPlace& place, bool measures) const;

  const BlockSet& blocks_;
  const Model& model_;
  const SpringReview& review_;
  const NodalPressures& pressures_;
  const DamageField& damage_;
  const LocalForces& local_;
};

}  // namespace hyperlattice
