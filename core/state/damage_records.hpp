// The particles near cracks. Damage is stored only for particles that have some, for their
// neighbours, and for particles whose stress may reach the surface; all others have d = 0.
//
// Every rank has the records of all ranks. The damage of each is always that of its own rank; what
// else a record holds is up to date in its own rank only, until spread().
#pragma once

#include <model/cohesive.hpp>
#include <state/archive.hpp>
#include <state/block_set.hpp>
#include <state/damage_cells.hpp>
#include <state/tensor.hpp>

#include <array>
#include <deque>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace hyperlattice {

/// A spring seen from one of its ends, of index 0 base and 1 cross.
struct DamageSpring {
  Particle to = 0;
  std::uint64_t index = 0;     ///< of the other end in the arrays of its block
  std::uint32_t block = 0;     ///< that stores the other end
  std::uint8_t neighbour = 0;  ///< number of the spring among those of its first end
  bool forward = true;         ///< whether the record's particle is the first end
  bool present = true;         ///< false: a criterion has removed it
  bool handed_over = false;    ///< whether the field computes it, not the kernel
  double stiffness[2] = {};    ///< with the share, N/m
  double spread = 0;           ///< weight in the Laplacian over the particle's share
  double elongation[2] = {};   ///< in the last evaluation, m
  double factor[2] = {1, 1};   ///< of its stiffness, likewise
};

/// What the springs of one direction have in common, seen from one of their ends.
struct DamageDirection {
  Vec3 rest;                   ///< to the other end, m
  double rest_length[2] = {};  ///< base and cross, m
};

/// What loops over all records read of one. It stands apart from the record, whose springs take
/// more memory than a cache has.
struct DamageNote {
  Particle particle = 0;
  std::uint32_t block = 0, row = 0;
  std::uint64_t marked = 0;       ///< step in which a spring was last above its alarm
  std::uint64_t rests_until = 0;  ///< step of the next evaluation, see DamageField
  double dissipated = 0;          ///< half of what its springs lost since the evaluation before, J
};

/// Turns the virial of a particle whose cells are not symmetric into the stress, for small strains
/// of one value around the particle.
struct VirialCorrection {
  std::array<double, 36> strains{};  ///< for the part of strains: 6 x 6, row by row
  /// For the part of heights: stress over the sum xx + yy + zz of the virial.
  Symmetric heights{};
};

/// A particle whose damage is followed.
struct DamageRecord {
  static constexpr std::size_t most_springs = 18;
  /// Damage from which on a particle counts as cracked. The traction is then a tenth of the
  /// strength in the middle of a crack that opens slowly.
  static constexpr double cracked = 0.9;

  Particle particle = 0;
  std::uint32_t block = 0, row = 0;
  std::int32_t site = 0;
  std::uint64_t index = 0;
  const Cohesive* material = nullptr;  ///< null: damage stays 0
  double volume = 0;                   ///< m3
  double strength = 0;                 ///< of this particle, Pa
  double shape = 1;                    ///< A
  double alpha = 0;                    ///< of the alpha spring, N/m
  double rate = 0;                     ///< of damage in the last step, 1/s
  double lag = 0;                      ///< how far its damage is from rest, see damage_lag()
  /// Time, s, of the state in which damage first reached `cracked`; NaN: it has not.
  double crack_time = std::numeric_limits<double>::quiet_NaN();
  /// For a particle whose cells are not symmetric; null: its virial is its stress.
  std::unique_ptr<const VirialCorrection> correction;

  CellsOfParticle cells;

  // results of the last evaluation
  double height = 0, alpha_factor = 1;  ///< m
  Symmetric stress{};                   ///< Pa
  double spread = 0;                    ///< b^2 times the Laplacian of damage
  std::array<double, 4> force{};        ///< of springs that are handed over, N
  double stored = 0;                    ///< half of their energies, J

  std::uint32_t count = 0;
  std::array<DamageSpring, most_springs> all;
  std::span<DamageSpring> springs() { return {all.data(), count}; }
  std::span<const DamageSpring> springs() const { return {all.data(), count}; }
};

class DamageRecords {
 public:
  /// The records of one row of a block: a range of order().
  struct RowOfRecords {
    std::uint32_t block, row, begin, end;
  };

  explicit DamageRecords(BlockSet& blocks);

  static constexpr std::uint32_t none = ~std::uint32_t{0};
  /// Memory for every particle of the body, bytes; records take more near cracks.
  static constexpr std::size_t bytes_of_particle = sizeof(std::uint32_t);
  /// Returns the number of a particle's record, or none.
  std::uint32_t of(Particle particle) const { return index_[particle]; }
  DamageRecord& operator[](std::uint32_t record) { return records_[record]; }
  const DamageRecord& operator[](std::uint32_t record) const { return records_[record]; }
  /// Asks for the memory of a record before it is needed.
  void prefetch(std::uint32_t record) const {
    constexpr std::size_t line = 64;
    const char* const memory = reinterpret_cast<const char*>(&records_[record]);
    for (std::size_t n = 0; n < sizeof(DamageRecord); n += line) __builtin_prefetch(memory + n);
  }
  DamageNote& note(std::uint32_t record) { return notes_[record]; }
  const DamageNote& note(std::uint32_t record) const { return notes_[record]; }
  const DamageDirection& direction(const DamageSpring& spring) const {
    return directions_[2U * spring.neighbour + (spring.forward ? 1 : 0)];
  }
  /// Returns the numbers of all records in the order of their particles.
  std::span<const std::uint32_t> order() const { return order_; }
  /// Returns those of the particles that this rank computes.
  std::span<const std::uint32_t> mine() const {
    return blocks_.ranks().is_alone() ? order() : of_rank(blocks_.ranks().rank());
  }
  /// Returns those of the particles that a rank computes.
  std::span<const std::uint32_t> of_rank(int rank) const;
  /// Returns those of one row of a block.
  std::span<const std::uint32_t> of_row(std::size_t block, std::uint32_t row) const {
    const auto [begin, end] = rows_[block][row];
    return order().subspan(begin, end - begin);
  }
  /// Returns the rows that have records, in the order of their particles.
  std::span<const RowOfRecords> rows() const { return filled_rows_; }

  /// Returns how many numbers of records there are, used or not.
  std::size_t numbers() const { return records_.size(); }
  /// Damage of a record; both are 0 and 1 without damage.
  double damage(std::uint32_t record) const { return damages_[record]; }
  double remaining(std::uint32_t record) const { return remaining_[record]; }
  void set_damage(std::uint32_t record, double damage);
  /// Sets the damage that a record has from the state at `time`, s, on.
  void grow_to(std::uint32_t record, double damage, double time);
  /// Returns them for any particle.
  double damage_of(Particle particle) const {
    return index_[particle] == none ? 0 : damages_[index_[particle]];
  }
  double remaining_of(Particle particle) const {
    return index_[particle] == none ? 1 : remaining_[index_[particle]];
  }

  /// The cells with a volumetric energy around the particles with records.
  DamageCells& cells() { return cells_; }
  const DamageCells& cells() const { return cells_; }

  /// Returns whether damage can grow at a particle.
  bool has_field(Particle particle) const;
  /// Makes records of those particles that have none. Returns the numbers of the new ones.
  std::vector<std::uint32_t> add(std::vector<Particle> particles);
  /// Removes the records for whose numbers `removes` is true. Several threads call it.
  template <class Removes>
  void remove_if(const Removes& removes) {
    std::vector<std::uint8_t> gone(order_.size());
    for_indices(order_.size(), [&](std::size_t n) { gone[n] = removes(order_[n]) ? 1 : 0; });
    std::vector<std::uint32_t> left;
    left.reserve(order_.size());
    for (std::size_t n = 0; n < order_.size(); ++n)
      if (gone[n] != 0)
        forget(order_[n]);
      else
        left.push_back(order_[n]);
    if (left.size() == order_.size()) return;
    order_ = std::move(left);
    find_rows();
  }
  /// Returns whether the bit of the first end says that the spring exists.
  bool exists(const DamageRecord& record, const DamageSpring& spring) const {
    const Block& block = blocks_[spring.forward ? record.block : spring.block];
    return (block.alive[spring.forward ? record.index : spring.index] >> spring.neighbour & 1U) !=
           0;
  }
  void clear_bit(const DamageRecord& record, const DamageSpring& spring);

  /// Calls work(record number) for these records on the threads of the run.
  template <class Work>
  void for_each(std::span<const std::uint32_t> records, const Work& work) const {
    for_indices(records.size(), [&](std::size_t n) { work(records[n]); });
  }
  /// Calls work(n) for n below `size` on the threads of the run.
  template <class Work>
  void for_indices(std::size_t size, const Work& work) const {
    blocks_.team().for_each((size + piece - 1) / piece, [&](std::size_t part) {
      for (std::size_t n = part * piece; n < std::min(size, (part + 1) * piece); ++n) work(n);
    });
  }
  /// Calls work(record numbers) for pieces of these records.
  template <class Work>
  void for_pieces(std::span<const std::uint32_t> records, const Work& work) const {
    blocks_.team().for_each((records.size() + piece - 1) / piece, [&](std::size_t n) {
      work(records.subspan(n * piece, std::min(piece, records.size() - n * piece)));
    });
  }

  void archive(Archive& archive);
  /// Brings the records up to date in every rank. All ranks must call it after a meeting.
  void spread();

 private:
  static constexpr std::size_t piece = 64;  // records that a thread takes at once

  /// What a record cannot find again from the model.
  struct Kept;
  Kept kept(std::uint32_t number) const;
  void restore(const Kept& kept);
  void fill(DamageRecord& record, Particle particle) const;
  void add_spring(DamageRecord& record, const Neighbour& to, std::uint32_t neighbour,
                  bool forward) const;
  void find_correction(DamageRecord& record) const;
  bool has_membrane() const {
    return model_.springs.choice.membrane != KernelChoice::Membrane::none;
  }
  void forget(std::uint32_t record);
  void find_rows();

  BlockSet& blocks_;
  const Model& model_;
  DamageCells cells_;
  std::deque<DamageRecord> records_;
  std::vector<DamageNote> notes_;            // of each record
  std::vector<DamageDirection> directions_;  // [2 neighbour + forward]
  std::vector<double> damages_, remaining_;  // of each record
  std::vector<std::uint32_t> unused_;        // numbers of records
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> index_;  // of each particle
  /// [block][row]: its range in order_
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> rows_;
  std::vector<RowOfRecords> filled_rows_;
};

}  // namespace hyperlattice
