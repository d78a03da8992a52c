// Added mass (model/mass_scaling.hpp) in the steps. Kernels know nothing of it:
//
//   Particles with added mass are boundary particles of their rows. So the kernel, which moves them
//   with their own mass, tells the force on them and their motion before the step. The step of
//   these particles is then made again with the whole mass, and sums of a measurement are amended.
//
// The force includes the weight of the particle's own mass, so weights do not grow.
#pragma once

#include <model/mass_scaling.hpp>
#include <state/block_set.hpp>

#include <vector>

namespace hyperlattice {

class AddedMass {
 public:
  explicit AddedMass(BlockSet& blocks) : blocks_(blocks) {}

  /// Gives the body the critical step `time_step`, s; 0: no mass is added.
  void start(double time_step);
  double time_step() const { return time_step_; }  ///< s
  bool empty() const { return of_blocks_.empty(); }
  /// Returns the added mass of a particle, kg.
  double of(Particle particle) const;

  /// Returns the boundary particles that the kernel shall use: those of the block as they are now,
  /// and those with added mass.
  BoundaryParticle* before_kernel(const Block& block);
  /// Makes a step again of the particles with added mass. `back`, `forward`: see KernelRequest;
  /// `damping`: alpha of local damping.
  void after_step(Block& block, double back, double forward, double damping);
  /// Amends the sums of a measurement whose kick lasts `kick` seconds.
  void after_measurement(Block& block, double kick, double damping);
  /// Adds sign * (1 / m - 1 / (m + added)) times the impulse of `duration` seconds under the forces
  /// of the last measurement to the velocities.
  void kick(double duration, double sign, double damping);

  void archive(Archive& archive);

 private:
  static constexpr std::uint32_t no_support = ~std::uint32_t{0};
  struct Heavy {
    std::uint32_t place = 0;             ///< in OfBlock::all
    std::uint32_t support = no_support;  ///< number among the block's boundary particles
    double own = 0, whole = 0;           ///< mass without and with the added one, kg
  };
  struct OfBlock {
    std::vector<BoundaryParticle> all;  ///< in the order of the rows
    std::vector<std::uint32_t> places;  ///< of the block's boundary particles in `all`
    std::vector<Heavy> heavy;
  };
  void arrange(Block& block);
  void put_back(Block& block) const;
  void return_supports(Block& block) const;

  BlockSet& blocks_;
  double time_step_ = 0;
  std::vector<MassScaling::Heavy> particles_;
  std::vector<OfBlock> of_blocks_;  // empty: no mass is added
};

}  // namespace hyperlattice
