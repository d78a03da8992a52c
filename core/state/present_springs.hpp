// The springs of a body at the present time and their forces, from the law whatever it is. For
// fields and probes: nothing here changes the state, and a state that no output asks about is not
// copied.
#pragma once

#include <model/spring_calls.hpp>
#include <state/simulation.hpp>
#include <state/soft_cell.hpp>
#include <state/soft_spring.hpp>

#include <functional>
#include <utility>
#include <vector>

namespace hyperlattice {

/// What to compute of each spring besides the motion of its ends.
enum class Asked { motion, forces, energies };  ///< energies: forces too

/// A base spring that is not broken, with its cross springs. Force and energy are those of a whole
/// spring; a surface counts `share` of them.
struct PresentSpring {
  Particle a = 0, b = 0;
  std::uint32_t neighbour = 0;  ///< see Model::spring_properties
  Vec3 rest;                    ///< from a to b at rest, m
  Vec3 apart;                   ///< displacement of b less that of a, m
  double share = 1;             ///< fraction of a whole spring
  double pull = 0;              ///< force over length, N/m: the force on a is pull (rest + apart)
  double energy = 0;            ///< J
};

/// Force over length, N/m, and energy, J, of the springs that start in one plane of a structured
/// body: [neighbour * count + particle - first]. Zero: there is no spring, or it is broken.
struct PlaneSprings {
  Particle first = 0;  ///< first particle of the plane
  std::uint64_t count = 0;
  std::vector<double> pull, energy;  ///< empty if not asked for

  std::size_t index(std::uint32_t neighbour, Particle particle) const {
    return neighbour * count + (particle - first);
  }
};

/// A copy of the displacements and living springs of the present state.
class PresentSprings {
 public:
  PresentSprings(const Model& model, const Simulation& simulation);

  const Model& model() const { return model_; }
  const Simulation& simulation() const { return simulation_; }
  Vec3 displacement(Particle particle) const {
    const double* u = &displacements_[3 * particle];
    return {u[0], u[1], u[2]};
  }
  std::span<const double> displacements() const { return displacements_; }  ///< x y z, m
  /// Returns 0 without a free membrane.
  double height(Particle particle) const { return heights_.empty() ? 0 : heights_[particle]; }
  /// Returns whether the spring from a particle of a structured body to a neighbour exists.
  bool lives(Particle particle, std::uint32_t neighbour) const {
    return (alive_[particle] >> neighbour & 1U) != 0;
  }
  /// Returns whether the volumetric energy acts of the cell whose lowest corner is this particle of
  /// a structured body.
  bool has_volumetric_energy(Particle lowest) const {
    return (alive_[lowest] & (cell_bit | soft_cell_bit)) != 0;
  }
  /// Returns what damage leaves of its tension.
  double remaining_tension(Particle lowest) const { return factor_of(lowest, soft_cells_); }
  /// Returns what damage leaves of the alpha spring of a particle.
  double remaining_alpha(Particle particle) const { return factor_of(particle, soft_alphas_); }

  /// Visits all springs that are not broken. Calls for springs that have a particle in common
  /// follow each other in an order that no number of threads changes; other calls may be at the
  /// same time. So a visitor may add to numbers of both ends. It must not ask the simulation for
  /// parallel work, such as a measurement.
  void for_springs(Asked asked, const std::function<void(const PresentSpring&)>& visit) const;

  /// Computes the springs that start in plane k of a structured body, to the neighbours whose bits
  /// are set. Any thread may call it.
  PlaneSprings plane(std::int32_t k, Asked asked, std::uint32_t neighbours = ~0U) const;
  /// Returns the pull of the part that one material has in a spring of a structured body between
  /// cells of several materials, as that of a whole spring of this material.
  SpringPull part_of(Particle a, Particle b, std::uint32_t neighbour, std::uint8_t material) const;

 private:
  /// Consecutive particles with springs to as many others.
  struct Piece {
    std::uint32_t neighbour = 0;
    Particle a = 0, b = 0;
    std::uint64_t count = 0;
  };
  class Row;

  template <class Visit>
  void for_pieces(std::int32_t k, std::uint32_t neighbours, const Visit& visit) const;
  void compute(const Piece& piece, Asked asked, Row& row, PlaneSprings& springs) const;
  void visit_plane(std::int32_t k, Asked asked,
                   const std::function<void(const PresentSpring&)>& visit) const;
  void visit_list(Asked asked, const std::function<void(const PresentSpring&)>& visit) const;
  /// `first`: place in the memory of the first number that the law keeps. `remains`: see pull_of().
  SpringPull ask(const SpringProperties& properties, Particle a, Particle b,
                 const Layout::Memory (&memory)[2], std::uint32_t first = 0,
                 double remains = 1) const;
  std::span<const SoftSpring> soft_in(const Piece& piece) const;
  /// Factors of some particles, ascending; the others have 1.
  using Factors = std::vector<std::pair<Particle, double>>;
  static double factor_of(Particle particle, const Factors& factors);
  void find_memory(Particle a, std::uint32_t neighbour, Layout::Memory (&memory)[2]) const;

  const Model& model_;
  const Simulation& simulation_;
  std::vector<double> displacements_, heights_;  ///< m
  std::vector<std::uint16_t> alive_;             ///< of a structured body, see KernelRequest
  /// [neighbour]: springs that damage has softened, ascending by their first ends
  std::vector<std::vector<SoftSpring>> soft_;
  Factors soft_cells_, soft_alphas_;              ///< by the cells' lowest corners, by particle
  std::vector<std::uint8_t> broken_;              ///< of a listed body; empty: no spring is
  std::vector<Simulation::SpringMemory> memory_;  ///< of a listed body whose laws keep some
};

}  // namespace hyperlattice
