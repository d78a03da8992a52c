// Evaluations of all forces: damage, ghost planes, loads, nodal volumes, local steps, then the
// kernel on every block.
#pragma once

#include <state/acting_loads.hpp>
#include <state/added_mass.hpp>
#include <state/array_criteria.hpp>
#include <state/block_set.hpp>
#include <state/local_steps.hpp>
#include <state/other_rows.hpp>
#include <state/spring_review.hpp>

namespace hyperlattice {

class Sweeps {
 public:
  Sweeps(BlockSet& blocks, ActingLoads& loads, ArrayCriteria& arrays, const SpringReview& review,
         NodalPressures& pressures, DamageField& damage, LocalForces& local, AddedMass& added,
         const OtherRows& other_rows);

  /// Sets the damping: `alpha` of local damping and the rate of damping in proportion to mass, 1/s.
  void set_damping(double alpha, double rate);
  double damping() const { return damping_; }  ///< alpha
  bool damps() const { return damping_ != 0 || damping_rate_ != 0; }
  /// Advances all blocks by a step and counts the work of the loads. Returns the largest number of
  /// springs that broke in a rank; 0 if there is one rank. Throws RunError if a load is not a
  /// number.
  std::int64_t step(const Sweep& sweep);
  /// Returns the sums of the present state, in the order of the rows for any number of blocks.
  /// Changes nothing but the results in rows and boundary particles.
  RowSums measure(const Sweep& sweep);
  /// Sets the loads of the blocks' boundary particles as measure() does, and nothing else.
  void set_loads(const Sweep& sweep);
  /// Throws RunError if a load was not a number in the last evaluation.
  void check_loads() const;

  void archive(Archive& archive);

 private:
  using Kernel = decltype(KernelSet::step);

  void read_motion();
  LocalForces::Taken local_steps(const Sweep& sweep, bool breaks);
  /// Calls a kernel for a block. `back` and `forward`: durations of its kick before and after the
  /// present time, s.
  [[gnu::always_inline]] void run_kernel(Kernel kernel, Block& block, double back, double forward,
                                         bool measures) const;
  KernelRequest request_for(Block& block, double back, double forward) const;

  BlockSet& blocks_;
  const Model& model_;
  ActingLoads& loads_;
  ArrayCriteria& arrays_;
  const SpringReview& review_;
  NodalPressures& pressures_;
  DamageField& damage_;
  LocalForces& local_;
  AddedMass& added_;
  const OtherRows& other_rows_;
  double damping_ = 0, damping_rate_ = 0;  // local; in proportion to mass, 1/s
  const bool exact_;                       // whether kernels take exact springs
};

}  // namespace hyperlattice
