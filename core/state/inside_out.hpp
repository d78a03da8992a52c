// Detects where a lattice has folded through itself: central springs resist shortening, but do not
// prevent that a cell turns inside out.
//
// A cell of a structured lattice has eight sites with a particle each. It is inside out if the
// three edges at one of its corners lose the orientation (sign of the triple product) that they
// have at rest. A list has no cells: three springs of each particle, chosen far from coplanar,
// replace them.
#pragma once

#include <state/simulation.hpp>

#include <array>
#include <span>
#include <string>

namespace hyperlattice {

/// A plain record: part of the checkpoint.
struct InsideOut {
  std::uint64_t all = 0;          ///< cells, or particles of a list with three such springs
  std::uint64_t number = 0;       ///< number of these that were inside out at the last look
  std::uint64_t most = 0;         ///< the largest number so far
  double first_time = 0;          ///< of the look that found the first one, s
  Vec3 first_place;               ///< place at rest of the first one, m
  std::uint64_t last_looked = 0;  ///< step of the last look
  std::uint64_t has_looked = 0;   ///< 1 after the first look
  double least_volume = 1;  ///< least J of volumetric cells at the last look, over that at rest
  double least_time = 0;    ///< of that look, s
  Vec3 least_place;         ///< place at rest of this cell, m
};

class CellWatch {
 public:
  explicit CellWatch(const Model& model)
      : body_(model.body), is_volumetric_(!model.volumetric.empty()) {}

  /// Looks at the present state on one thread, in about the time of a step on one thread. Skips
  /// cells and particles at a broken spring. Returns whether this look found the first one inside
  /// out. All ranks call it; of a grid only the first one sees the cells.
  bool look(const Simulation& simulation);
  /// Returns whether enough steps have passed since the last look to make another one cheap.
  bool is_due(std::uint64_t step) const;

  /// Returns the most bytes that a look takes, with the data kept between looks.
  static double bytes(const Model& model);

  /// Returns a warning about folded cells; "" if none was seen.
  std::string sentence() const;
  /// Returns why steps may have become too long, if cells with a volumetric energy were much
  /// compressed at the last look; else "".
  std::string stiffened() const;
  InsideOut& seen() { return seen_; }

 private:
  using Triple = std::array<std::uint32_t, 3>;  ///< other ends of three springs; all 0: none

  void look_at_cells(const Simulation& simulation);
  void look_at_row(std::int32_t j, std::int32_t k);
  void look_at_list();
  void find_triples();
  void count(bool is_inside_out, Particle particle);
  void measure(const std::array<Vec3, 8>& moved, Particle particle);

  const Body& body_;
  bool is_volumetric_;
  double least_growth_ = 0;  ///< least J - 1 in this look
  Particle least_ = 0;       ///< first corner of this cell
  InsideOut seen_;
  std::vector<double> moved_;  ///< displacements x y z of the particles from first_ on, m
  Particle first_ = 0;
  Particle found_ = 0;  ///< the first one that is inside out in this look
  /// Whether each particle has a broken spring; empty: none has.
  std::vector<bool> is_torn_;
  std::vector<Triple> triples_;  ///< per particle of a list
};

}  // namespace hyperlattice
