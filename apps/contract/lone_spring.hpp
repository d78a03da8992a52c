// One base spring of a material, moved along a path of elongations. The checks of laws and their
// pictures use such paths.
#pragma once

#include <model/model.hpp>

#include <cstdint>
#include <vector>

namespace hyperlattice::contract {

/// One base spring of a model, without particles, with its own memory.
class LoneSpring {
 public:
  /// Makes a spring of the model's first neighbour, at rest, with new memory.
  explicit LoneSpring(const Model& model);

  /// Takes one step of `time_step` seconds to this elongation, m.
  SpringAnswer move(double elongation, double time_step);
  /// Returns the stored energy, J, at this elongation, m, with the present memory.
  double energy(double elongation) const;
  const std::vector<double>& memory() const { return memory_; }
  double rest_length() const { return spring_.rest_length; }
  double period() const { return period_; }  ///< sqrt(m / k) with the mass m of a particle, s

  /// Returns the first elongation, m, at which the secant stiffness of the law is half or twice its
  /// initial value; L0 / 1000 if that does not happen up to a strain of 1/50.
  double reach() const;

 private:
  const Model* model_;
  OneSpring spring_;
  double period_;
  std::vector<double> memory_;
};

/// One point of a spring's path.
struct PathPoint {
  double elongation = 0;  ///< m
  double force = 0;       ///< N
  double stored = 0;      ///< J
  double work = 0;        ///< work of the force since the point before, J
  double dissipated(const PathPoint& before) const { return work - (stored - before.stored); }
};

/// Returns elongations, m, that begin at 0 and go through all `turns`, evenly in pieces of about
/// `step` metres.
std::vector<double> path_through(const std::vector<double>& turns, double step);
/// Moves the spring through these elongations, m, with one step of `time_step` seconds each.
std::vector<PathPoint> follow(LoneSpring spring, const std::vector<double>& elongations,
                              double time_step);

/// Returns the turns of the path in the pictures: load, unload, load further, compress, back to 0.
std::vector<double> usual_turns(double reach);
std::vector<PathPoint> usual_path(const LoneSpring& spring);
std::vector<PathPoint> random_path(const LoneSpring& spring, std::uint64_t seed);

/// Draws force against elongation as a small SVG; the bytes are the same on every machine.
std::string picture(const std::string& title, const std::vector<PathPoint>& path);

}  // namespace hyperlattice::contract
