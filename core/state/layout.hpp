// How a body is stored: blocks, one a thread, of rows of particles, padded to whole vectors.
// Structured and listed bodies differ in how rows are cut, in what a block copies from others, and
// in how a spring is found again; everything else treats them alike.
#pragma once

#include <model/model.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace hyperlattice {

struct Block;

struct BlockLayout {
  std::vector<Row> rows;  ///< supports not yet filled in
  std::uint32_t first_own = 0,
                last_own =
                    0;  ///< rows first_own <= r < last_own are the block's; others are ghosts
  std::vector<std::uint32_t> weight_sets;  ///< see KernelRequest
  std::uint64_t sites = 0;                 ///< places in each array, with the padding
};

/// Where a particle is stored.
struct Place {
  std::size_t block = 0;
  std::uint32_t row = 0;    ///< in the block's rows
  std::int32_t site = 0;    ///< in the row's own count
  std::uint64_t index = 0;  ///< in the block's arrays
};

/// Particles that follow each other, in memory too.
struct Stretch {
  std::size_t block = 0;
  std::uint64_t index = 0;
  Particle first = 0;
  std::uint64_t count = 0;
};

/// The spring that a kernel means.
struct SpringEnds {
  Particle a = 0, b = 0;        ///< a stands first
  std::uint32_t neighbour = 0;  ///< see Model::spring_properties
  bool is_first =
      true;  ///< the kernel came to it from a: a spring that kernels meet twice counts once
};

class Layout {
 public:
  virtual ~Layout() = default;
  Layout(const Layout&) = delete;
  Layout& operator=(const Layout&) = delete;

  std::vector<BlockLayout> blocks;

  virtual Place place(Particle particle) const = 0;
  /// All particles in their order.
  virtual void for_stretches(const std::function<void(const Stretch&)>& visit) const = 0;
  /// Of a spring that exists: see AlarmRow.
  virtual SpringEnds spring(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                            std::int32_t site) const = 0;
  /// Where the numbers that the law keeps of a spring begin, and how far they are apart; of its
  /// cross springs if `cross`.
  struct Memory {
    double* first = nullptr;
    std::uint64_t stride = 0;
  };
  virtual Memory memory(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                        std::int32_t site, bool cross) const = 0;
  /// Where the spring's other end stands in the arrays of the same block, its own or a ghost. Not
  /// of a listed body.
  virtual std::uint64_t other_end(std::size_t block, std::uint32_t row, std::uint32_t neighbour,
                                  std::int32_t site) const = 0;
  virtual std::uint64_t alive_bits(const Block& block, std::uint64_t index)
      const = 0;  ///< which springs of a particle exist, for hashes

  /// Fills the block's arrays of what exists: springs, materials. Displacements and velocities are
  /// there already.
  virtual void fill(Block& block) const = 0;
  /// Copies what the block sees of others, and of itself at the step's start.
  virtual void exchange(const std::vector<Block>& all, Block& block) const = 0;
  /// What a kernel is told of the arrangement.
  virtual void describe(const Block& block, KernelRequest& request) const = 0;

  virtual double state_bytes() const = 0;  ///< displacement, velocity, springs, materials, weights:
                                           ///< exactly what is allocated
  virtual std::size_t scratch_numbers() const = 0;  ///< of one block
  double scratch_bytes() const {
    return static_cast<double>(scratch_numbers() * sizeof(double) * blocks.size());
  }

 protected:
  explicit Layout(const Model& model) : model_(model) {}
  /// Numbers that laws keep of a base spring and its cross spring.
  std::size_t kept_numbers() const {
    return (model_.choice.membrane == KernelChoice::Membrane::none ? 1 : 2) *
           std::size_t{model_.kernels.memory};
  }

  /// Sets what the law keeps of a new spring between a and b. `index`: see
  /// Model::spring_properties.
  void start_memory(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                    std::int32_t site, Particle a, Particle b, std::uint32_t index) const;

  const Model& model_;
};

std::unique_ptr<Layout> make_layout(const Model& model, int threads);

}  // namespace hyperlattice
