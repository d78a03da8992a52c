// The field of damage of cohesive materials (docs/theory/cohesive.md). A particle has the damage
// d, of which omega(d) of its stiffness remains. A spring is two half springs in series, so that
// the harmonic mean of its ends' omega remains of it: of a base spring if it is stretched, of a
// cross spring always.
//
// A spring with an end of omega < 1 is handed over: its bit in Block::alive is cleared, so that
// kernels skip it with its cross springs, and the field computes it. What kernels cost stays as it
// is, and the field costs what lies near cracks. Likewise a cell with a volumetric energy
// (damage_cells.hpp).
#pragma once

#include <state/clock.hpp>
#include <state/crack_surface.hpp>
#include <state/damage_cells.hpp>
#include <state/damage_equations.hpp>
#include <state/damage_records.hpp>
#include <state/soft_cell.hpp>
#include <state/soft_spring.hpp>

#include <hyperlattice/kernel_request.hpp>

#include <optional>
#include <vector>

namespace hyperlattice {

/// Damage at rest.
struct SettledDamage {
  double factor =
      1;  ///< the largest between the bounds at which damage grew by most_growth or less
  double change = 0;                ///< largest change of a particle's damage since the last search
  std::vector<SoftSpring> springs;  ///< in the order of their first ends and neighbours
  std::vector<SoftParticle> particles;
  std::vector<SoftCell> cells;  ///< in the order of their lowest corners
};

class DamageField {
 public:
  DamageField(BlockSet& blocks, const Clock& clock)
      : blocks_(blocks), model_(blocks.model()), clock_(clock), records_(blocks) {}

  /// Returns whether no material is cohesive. All other functions need one.
  bool empty() const { return model_.cohesive.empty(); }

  // A step of length `time_step`, s, calls these in turn.
  /// Computes the forces of the present state, then lets damage grow. Must be called before blocks
  /// exchange: other blocks copy the bits of springs.
  void update(double time_step);
  /// Notes particles beside springs that are shortened beyond the alarm. Must be called after
  /// blocks exchanged.
  void watch_shortening(Block& block) const;
  /// Hands over the springs that became soft, and follows the particles that were noted.
  void finish();

  // Between states of rest (damage_at_rest.cpp).
  /// Finds the damage at rest for the present displacements, at least that of the last accepted
  /// state. The damage of the field stays; the next search begins with the result.
  SettledDamage settle(const DamageBounds& bounds);
  /// Forgets the results of searches.
  void forget_search() {
    settled_.clear();
    searches_ = 0;
  }
  /// Notes the elongations of springs before the displacements change, and lets damage become that
  /// of the last search, at `time`, s. finish() must follow.
  void accept_search(double time);
  /// Lets damage grow at the end of an implicit step of the length `time_step`, s, as after an
  /// explicit one. `forward`: the part of the step at which its forces lay. Returns the largest
  /// growth of a particle's damage, or how far it lags behind its stress if that is more.
  double grow_after_implicit(double time_step, double forward);

  /// Computes the forces and energies of the present state, and what the last step dissipated.
  void evaluate();
  /// Notes the ends of springs above their alarm. Each block's thread may call it.
  void note(Block& block, const AlarmRow& springs) const;

  /// Brings the field up to date in every rank. All ranks must call it; BlockSet::gather() and
  /// gather_in_first() do the same for the motion.
  void gather();

  /// Returns the records of a row, with the results of the last evaluation.
  template <class Visit>
  void for_row(const Block& block, std::uint32_t row, const Visit& visit) const {
    for (const std::uint32_t record : records_.of_row(block.number, row)) visit(records_[record]);
  }
  /// Sets the damage of the particles of cohesive materials, and leaves the others.
  void copy_damage(std::vector<double>& values) const;
  /// Computes the fields crack_opening, m, and crack_time, s, of all particles. Without cohesive
  /// materials they are 0 and NaN.
  void copy_openings(std::vector<double>& values) const;
  void copy_crack_times(std::vector<double>& values) const;
  /// Returns the energy and the area of the cracks.
  CrackSurface surface() const;
  /// Calls visit(particle, damage, rate) for the particles with damage in their order.
  template <class Visit>
  void for_damaged(const Visit& visit) const {
    for (const std::uint32_t record : records_.order())
      if (records_.damage(record) > 0)
        visit(records_[record].particle, records_.damage(record), records_[record].rate);
  }
  /// Returns the factor of a spring, given its first end, if it is handed over.
  std::optional<double> factor(Particle first, std::uint32_t neighbour) const;
  /// Returns the springs that are handed over, in the order of their first ends and neighbours.
  std::vector<SoftSpring> soft_springs() const;
  std::vector<SoftParticle> soft_particles() const;
  /// Returns the factor of a cell, given its lowest corner, if it is handed over.
  std::optional<double> cell_factor(Particle lowest) const;
  /// Returns the cells that are handed over, in the order of their lowest corners.
  std::vector<SoftCell> soft_cells() const;

  void archive(Archive& archive) {
    records_.archive(archive);
    if (archive.restores()) is_whole_ = true;
  }

 private:
  struct Motion;
  Motion motion_of(const Block& block, std::uint64_t index) const;
  double elongation(const DamageDirection& direction, std::size_t cross, const Motion& here,
                    const Motion& there) const;
  /// What remains of a spring or cell, and its elongation.
  struct Softened {
    double factor = 1, elongation = 0;
  };
  /// Returns the energy, J, that a spring of the stiffness 1 dissipates from one state to the next.
  /// `factor_at`: of the new state, for any elongation.
  template <class FactorAt>
  double lost(Softened before, Softened now, const FactorAt& factor_at) const {
    if (forward_ == 0)
      return 0.5 * (before.factor - now.factor) * before.elongation * now.elongation;
    // The force of statics/soft_springs.cpp: energies at the start count by the new factor.
    const auto stored = [](double factor, double u) { return 0.5 * factor * u * u; };
    const double late = 2 * forward_ - 1, u = now.elongation, start = before.elongation,
                 now_stored = stored(now.factor, u),
                 mean_work = now_stored - stored(factor_at(start), start),
                 work = (1 - late) * mean_work + late * now.factor * u * (u - start);
    return work - (now_stored - stored(before.factor, start));
  }
  /// What compute() computes: all, or the stress alone, which leaves the energies as they are.
  enum class Part { all, stress };
  void compute(std::uint32_t number, Part part = Part::all);
  void compute(std::span<const std::uint32_t> records);
  void count_dissipation();
  // soft_cells.cpp
  void compute_cells(Part part);
  void compute(DamageCell& cell, Part part) const;
  bool is_mine(const DamageCell& cell) const;
  CellResponse response(const DamageCell& cell) const;
  double stiffness_of(const DamageCell& cell) const;
  double factor(const DamageCell& cell) const;
  double add_cells(std::uint32_t number, Part part);
  void note_extensions();
  void hand_over_cells(const DamageRecord& record);
  /// Calls visit(particle) for the opposite corners of the cells around a record's particle.
  template <class Visit>
  void for_opposite(const DamageRecord& record, const Visit& visit) const {
    for (std::size_t n = 0; n < 8; ++n)
      if (record.cells.numbers[n] != DamageCells::none)
        visit(records_.cells()[record.cells.numbers[n]].corners[7 - n]);
  }

  void find_ratios(std::span<const std::uint32_t> records, std::vector<double>& ratios) const;
  void note_elongations(std::uint32_t number);
  void set_damages(const std::vector<double>& damages, double time);
  void follow_noted();
  void watch_all();
  void watch(Block& block, double stretch, double shortening) const;
  void grow(std::span<const std::uint32_t> records, double time_step);
  void share_growth();
  void note_gone();
  void surround(const std::vector<std::uint32_t>& damaged);
  void remove_idle();
  void note(Block& block, Particle particle) const;
  /// Returns whether the particle needs no evaluation in this step: its stress was far below the
  /// surface a few steps ago, and no damage is near.
  bool rests(std::uint32_t number) const {
    return clock_.steps() < records_.note(number).rests_until;
  }
  bool rests(const DamageCell& cell) const;
  bool touches_damage(const DamageRecord& record) const;
  double opening(std::uint32_t number) const;

  /// A particle without damage is followed this long after its last note.
  static constexpr std::uint64_t steps_followed = 64;

  BlockSet& blocks_;
  const Model& model_;
  const Clock& clock_;
  DamageRecords records_;
  std::vector<double> next_;          // damage of each record after the step
  std::vector<std::uint32_t> soft_;   // records whose omega fell below 1 in this step
  std::vector<std::uint32_t> ended_;  // records whose omega became 0 in this step
  std::vector<double> settled_;       // damage of each record after the last search; empty: none
  int searches_ = 0;                  // since the last accepted state of rest
  bool is_whole_ = true;              // whether all records are up to date in every rank
  double forward_ = 0;                // of an implicit step whose dissipation is not counted yet
};

}  // namespace hyperlattice
