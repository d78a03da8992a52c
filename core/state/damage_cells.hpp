// The cells with a volumetric energy around the particles with records of damage. A cell is four
// pairs of opposite corners. A pair is in series as the halves of a spring, so that
//   f = 1/4 sum 2 omega_a omega_o / (omega_a + omega_o)
// remains of the cell while it is stretched.
#pragma once

#include <state/archive.hpp>
#include <state/block_set.hpp>
#include <state/soft_cell.hpp>

#include <array>
#include <span>
#include <unordered_map>
#include <vector>

namespace hyperlattice {

struct DamageCell {
  std::array<Particle, 8> corners{};  ///< in the order of CellCorners
  std::array<const Block*, 8> blocks{};
  std::array<std::uint64_t, 8> index{};  ///< in the arrays of the blocks
  double modulus = 0;                    ///< K_v times the cell's share, Pa
  int users = 0;                         ///< records of its corners
  bool present = true;                   ///< false: a criterion or the end of damage removed it
  bool handed_over = false;              ///< whether the field computes it, not the kernel

  // results of the last evaluation
  double extension = 0;   ///< +-sqrt(2 U / K_v): 3 (J^(1/3) - 1)
  double factor = 1;      ///< what remained of its energy
  double tension = 0;     ///< J U' of the undamaged cell times its share, Pa
  CellCorners force;      ///< if it is handed over, N
  double stored = 0;      ///< likewise, J
  double dissipated = 0;  ///< since the evaluation before, J

  std::uint16_t& bits() const { return blocks[0]->alive[index[0]]; }
};

/// The cells of a particle: number n has it as its corner n.
struct CellsOfParticle {
  std::array<std::uint32_t, 8> numbers{};
  double share = 0;  ///< sum of the shares of the cells around it; 0: none has a volumetric energy
};

class DamageCells {
 public:
  explicit DamageCells(BlockSet& blocks) : blocks_(blocks), model_(blocks.model()) {}

  static constexpr std::uint32_t none = ~std::uint32_t{0};
  /// Returns whether the body has no volumetric energy. Nothing is followed then.
  bool empty() const { return model_.volumetric.empty(); }
  DamageCell& operator[](std::uint32_t cell) { return cells_[cell]; }
  const DamageCell& operator[](std::uint32_t cell) const { return cells_[cell]; }
  /// Returns how many numbers of cells there are; those without users are unused.
  std::size_t numbers() const { return cells_.size(); }
  /// Returns the number of the cell with this lowest corner, or none.
  std::uint32_t at(Particle lowest) const;

  /// Follows the cells around a particle until release().
  CellsOfParticle follow(Particle particle);
  void release(const CellsOfParticle& cells);

  void archive(Archive& archive);
  /// Brings the cells up to date in every rank. All ranks must call it after a meeting.
  void spread();

 private:
  /// What a cell cannot find again from the model and the bits of the sites.
  struct Kept;
  std::vector<Kept> kept() const;
  void restore(const Kept& kept);
  std::uint32_t number_of(Site cell, Particle lowest);

  BlockSet& blocks_;
  const Model& model_;
  std::vector<DamageCell> cells_;
  std::vector<std::uint32_t> unused_;
  std::unordered_map<Particle, std::uint32_t> by_lowest_;
};

}  // namespace hyperlattice
