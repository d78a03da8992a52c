// The record of all springs that failed, and of the energy lost with them.
#pragma once

#include <state/block_set.hpp>
#include <state/breakage.hpp>
#include <state/clock.hpp>
#include <state/nodal_pressures.hpp>

#include <cstdint>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace hyperlattice {

class FailureRecord {
  /// The places where the ends of a broken spring are stored, and what else says whether its
  /// failure is open: counts read this alone.
  struct Ends {
    std::uint64_t a, b;              ///< in the arrays of their blocks
    std::uint32_t block_a, block_b;  ///< numbers of the blocks
    std::uint32_t neighbour = 0;     ///< see Model::spring_properties
    bool counts = true;              ///< false if the breakage is Breakage::again
  };

 public:
  /// Bytes that the record takes for each failure, while its arrays have no room to spare.
  static constexpr std::size_t bytes_each = sizeof(Breakage) + 2 * sizeof(Ends);

  FailureRecord(BlockSet& blocks, const Clock& clock, NodalPressures& pressures)
      : blocks_(blocks), clock_(clock), pressures_(pressures) {}

  /// Takes the breakages of a step of length `step`, s, from the blocks. The record does not depend
  /// on the number of threads: blocks are in the order of their particles, and each block's list is
  /// in the order of its rows. `in_ranks`: some were found by a rank in its own blocks only.
  void collect(double step, bool in_ranks = false);

  /// Returns the failures in the order of their steps.
  const std::vector<Breakage>& breakages() const { return breakages_; }
  /// Returns the energy, J, that was lost with springs that criteria removed, and with cells and
  /// nodal volumes that lost a spring.
  double energy() const { return energy_; }
  /// Returns the present elongation, m, of a broken spring: above 0 if the failure is open.
  double elongation_now(std::size_t breakage) const;
  /// Returns the number of springs that failed.
  std::uint64_t springs() const { return breakages_.size() - again_; }
  /// Returns the number of springs whose failure is open; those of all others are closed.
  std::uint64_t open();

  void archive(Archive& archive);

 private:
  struct Growth {
    double of_square, rest_length;
  };

  void note(const Breakage& breakage, Ends ends);
  Ends find_ends(Particle a, Particle b) const;
  Ends ends_of(const Block& block, const Block::Broken& broken) const;
  void share(std::vector<double>& numbers) const;
  Growth growth_now(const Ends& where) const;
  void arrange();
  /// Returns the number of open failures of this rank's blocks.
  std::uint64_t count_open(std::span<const Ends> failures) const;
  double energy_of(const Block& block, const Block::Broken& broken, const Ends& where,
                   double step) const;

  BlockSet& blocks_;
  const Clock& clock_;
  NodalPressures& pressures_;
  std::vector<Breakage> breakages_;
  std::vector<Ends> ends_;      // of each breakage
  std::vector<Ends> by_place_;  // of the first breakages, in the order of their places
  std::set<std::pair<Particle, std::uint32_t>> softened_;  // first end and neighbour
  std::uint64_t again_ = 0;  // breakages of springs that had softened before
  double energy_ = 0;        // J
};

}  // namespace hyperlattice
