// The storage of a body: one block per thread, each with rows of particles that are padded to whole
// vectors. Structured and listed bodies differ in how rows are cut, in what a block copies from
// others, and in how a spring is found; all other code treats them alike.
#pragma once

#include <model/model.hpp>

#include <bitset>
#include <compare>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace hyperlattice {

struct Block;

/// The rows of one block and the size of its arrays.
struct BlockLayout {
  std::vector<Row> rows;  ///< without their boundary particles
  /// The block's own rows are first_own <= r < last_own; the others are ghosts.
  std::uint32_t first_own = 0, last_own = 0;
  std::vector<std::uint32_t> weight_sets;  ///< see KernelRequest
  std::uint64_t sites = 0;                 ///< elements of each array, padding included
};

/// The place where a particle is stored.
struct Place {
  std::size_t block = 0;
  std::uint32_t row = 0;    ///< index in the block's rows
  std::int32_t site = 0;    ///< number in the row, see AlarmRow::sites
  std::uint64_t index = 0;  ///< index in the block's arrays
};

/// A range of consecutive particles that is contiguous in memory.
struct Stretch {
  std::size_t block = 0;
  std::uint64_t index = 0;
  Particle first = 0;
  std::uint64_t count = 0;
};

/// The spring that a kernel names by its place.
struct SpringEnds {
  Particle a = 0, b = 0;        ///< a precedes b
  std::uint32_t neighbour = 0;  ///< see Model::spring_properties
  /// Whether the kernel named the spring from its end a. A spring that kernels meet twice counts
  /// only then.
  bool is_first = true;
};

/// The place of a spring in a block, and its ends.
struct SpringPlace {
  std::uint32_t row = 0, neighbour = 0;  ///< as in AlarmRow
  std::int32_t site = 0;
  SpringEnds ends;
  bool counts = true;  ///< false for copies: in ghost rows, or from the second end
};

/// Growth of the squared length of a spring, m2, between which it is of no interest.
struct GrowthBounds {
  double least = -infinity, most = infinity;
};

/// Row::law of rows whose springs have the first law, and to whose particles the host adds forces:
/// those of volumetric energies (nodal_pressures.hpp), of soft springs (damage_field.hpp) or of
/// local steps (local_steps.hpp).
inline constexpr std::int32_t first_law_and_more = -2;

class Layout {
 public:
  virtual ~Layout() = default;
  Layout(const Layout&) = delete;
  Layout& operator=(const Layout&) = delete;

  std::vector<BlockLayout> blocks;

  virtual Place place(Particle particle) const = 0;
  /// Visits all particles in their order, in contiguous ranges.
  virtual void for_stretches(const std::function<void(const Stretch&)>& visit) const = 0;
  /// Returns the two particles of an existing spring, given its place in a kernel's AlarmRow.
  virtual SpringEnds spring(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                            std::int32_t site) const = 0;
  /// Returns by which number a kernel names a spring (AlarmRow::neighbour), given its first end's
  /// place and its number in the body (SpringEnds::neighbour); nothing if the spring is gone.
  virtual std::optional<std::uint32_t> number_in_row(const Block& block, const Place& first,
                                                     std::uint32_t neighbour) const = 0;
  /// Returns whether a spring that a kernel names so still exists.
  virtual bool exists(const Block& block, const Place& first, std::uint32_t number) const = 0;
  /// Removes a spring that a kernel names so. Of a listed body its other end still names it.
  virtual void remove(Block& block, std::uint32_t row, std::uint32_t neighbour,
                      std::int32_t site) const = 0;
  /// The memory of the law for one spring: its first number, and the distance to the next one.
  struct Memory {
    double* first = nullptr;
    std::uint64_t stride = 0;
  };
  /// Returns the law's memory of a spring, or of its cross spring if `cross`.
  virtual Memory memory(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                        std::int32_t site, bool cross) const = 0;
  /// Returns the index of a spring's other end, an own particle or a ghost, in the arrays of the
  /// same block. Throws std::logic_error for a listed body.
  virtual std::uint64_t other_end(std::size_t block, std::uint32_t row, std::uint32_t neighbour,
                                  std::int32_t site) const = 0;
  /// Returns the rate of growth of a spring, m/s, from the velocities half a step before. The step
  /// has not moved its ends yet. Only if a criterion asks for the rate.
  virtual double rate(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                      std::int32_t site) const = 0;
  /// Visits all springs of a block, those of its ghost rows included. Of a listed body each spring
  /// is visited once from each of its ends in the block.
  virtual void for_springs(const Block& block,
                           const std::function<void(const SpringPlace&)>& visit) const = 0;
  /// Visits the springs of a block whose squared length has grown by less than `least` or by more
  /// than `most`, those of its ghost rows excluded. `bounds`: of each neighbour. Of a listed body
  /// all springs are visited, once from each of their ends in the block.
  virtual void for_springs_beyond(const Block& block, std::span<const GrowthBounds> bounds,
                                  const std::function<void(const SpringPlace&)>& visit) const = 0;
  /// Returns which springs of a particle exist, as bits for hashes.
  virtual std::uint64_t alive_bits(const Block& block, std::uint64_t index) const = 0;

  /// Fills the block's arrays of springs and materials. Displacements and velocities must be
  /// allocated.
  virtual void fill(Block& block) const = 0;
  /// Copies into the block what it reads of other blocks and of its own state at the step's start.
  virtual void exchange(const std::vector<Block>& all, Block& block) const = 0;
  /// Indices begin <= n < end in the arrays of a block.
  struct Borrowed {
    std::size_t block = 0;
    std::uint64_t begin = 0, end = 0;
    auto operator<=>(const Borrowed&) const = default;
  };
  /// Returns the ranges of other blocks that exchange() copies into a block, or that springs of the
  /// block lead to.
  virtual std::vector<Borrowed> borrowed(std::size_t block) const = 0;
  /// Sets the members of a kernel's request that describe the arrangement.
  virtual void describe(const Block& block, KernelRequest& request) const = 0;

  /// Returns the allocated bytes of displacements, velocities, springs, materials and weights.
  virtual double state_bytes() const = 0;
  /// Returns the size of one block's scratch array, in doubles.
  virtual std::size_t scratch_numbers() const = 0;
  double scratch_bytes() const {
    return static_cast<double>(scratch_numbers() * sizeof(double) * blocks.size());
  }

 protected:
  using Materials = std::bitset<256>;

  explicit Layout(const Model& model) : model_(model) {}
  /// Returns how many numbers laws keep for a base spring and its cross spring.
  std::size_t kept_numbers() const {
    return (model_.springs.choice.membrane == KernelChoice::Membrane::none ? 1 : 2) *
           std::size_t{model_.springs.memory};
  }

  /// Returns the law of springs between these materials, by its index in SpringTable::laws; -1 if
  /// they need several laws, or several sets of constants of one law.
  std::int32_t law_between(const Materials& materials) const;

  /// Returns whether the memory of a law does not start at zero.
  bool starts_memory() const;
  /// Initializes the law's memory of a new spring between a and b. `index`: see
  /// Model::spring_properties.
  void start_memory(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                    std::int32_t site, Particle a, Particle b, std::uint32_t index) const;

  const Model& model_;
};

/// Returns the layout of the model's body in at most `threads` blocks.
std::unique_ptr<Layout> make_layout(const Model& model, int threads);

}  // namespace hyperlattice
