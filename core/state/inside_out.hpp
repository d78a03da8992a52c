// Where a lattice has folded through itself: central springs resist shortening, but not that a cell
// is turned inside out.
//
// A cell of a structured lattice spans eight sites with a particle each. It is inside out if, at
// one of its corners, the three edges no longer lie round each other as they do at rest. A list has
// no cells: three springs of each particle, as far from one plane as may be, stand for them.
#pragma once

#include <state/simulation.hpp>

#include <array>
#include <span>
#include <string>

namespace hyperlattice {

/// A plain record: part of the checkpoint.
struct InsideOut {
  std::uint64_t all = 0;          ///< cells, or particles of a list with three such springs
  std::uint64_t number = 0;       ///< of these, inside out when last looked
  std::uint64_t most = 0;         ///< the largest number so far
  double first_time = 0;          ///< s, when one was first seen
  Vec3 first_place;               ///< m, at rest, of the one that was seen first
  std::uint64_t last_looked = 0;  ///< step
  std::uint64_t has_looked = 0;   ///< 1 once it has
};

class CellWatch {
 public:
  explicit CellWatch(const Model& model) : body_(model.body) {}

  /// Looks at the present state, on one thread, in about the time of a step on one thread. Cells
  /// and particles next to a broken spring are not judged. Returns whether the first one was seen
  /// now.
  bool look(const Simulation& simulation);
  /// Whether the steps since the last look make another one cheap.
  bool is_due(std::uint64_t step) const;

  /// Bytes that a look takes at most, with what stays between looks.
  static double bytes(const Model& model);

  /// A sentence about what was seen; "" if nothing was.
  std::string sentence() const;
  InsideOut& seen() { return seen_; }

 private:
  using Triple = std::array<std::uint32_t, 3>;  ///< the springs' other ends; all 0: none

  void look_at_cells(const Simulation& simulation);
  void look_at_row(std::int32_t j, std::int32_t k);
  void look_at_list();
  void find_triples();
  void count(bool is_inside_out, Particle particle);

  const Body& body_;
  InsideOut seen_;
  std::vector<double> moved_;  ///< m, x y z of the particles from first_ on
  Particle first_ = 0;
  Particle found_ = 0;  ///< the first one that is inside out in this look
  std::vector<bool>
      is_torn_;  ///< of each particle, whether a spring of it is broken; empty: none is
  std::vector<Triple> triples_;  ///< of each particle of a list
};

}  // namespace hyperlattice
