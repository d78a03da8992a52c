// One base spring of a material, alone, led along a path of elongations: what the checks of laws
// and their pictures are made of.
#pragma once

#include <model/model.hpp>

#include <cstdint>
#include <vector>

namespace hyperlattice::contract {

class LoneSpring {
 public:
  /// A spring of the first class, at rest, whose memory is new.
  explicit LoneSpring(const Model& model);

  SpringAnswer move(double elongation, double time_step);  ///< a step further
  double energy(double elongation) const;  ///< J that it would store there with the memory as it is
  double rest_length() const { return spring_.rest_length; }
  double period() const { return period_; }  ///< sqrt(m / k) of a particle on the spring, s

  /// An elongation at which the law shows what it does: where its force is half or twice that of
  /// the spring as it is at first. One thousandth of its length if that does not happen up to
  /// strains of a fiftieth.
  double reach() const;

 private:
  const Model* model_;
  OneSpring spring_;
  double period_;
  std::vector<double> memory_;
};

/// A spring on its way.
struct PathPoint {
  double elongation = 0;  ///< m
  double force = 0;       ///< N
  double stored = 0;      ///< J
  double work = 0;        ///< J, of the force, since the point before
  double dissipated(const PathPoint& before) const { return work - (stored - before.stored); }
};

/// Through these elongations one after the other, evenly, in pieces of `step` metres and
/// `time_step` seconds. Starts at nothing.
std::vector<double> path_through(const std::vector<double>& turns, double step);
std::vector<PathPoint> follow(LoneSpring spring, const std::vector<double>& elongations,
                              double time_step);

/// Loaded, unloaded, loaded on, compressed, and back: the turns of the path that pictures show.
std::vector<double> usual_turns(double reach);
std::vector<PathPoint> usual_path(const LoneSpring& spring);
std::vector<PathPoint> random_path(const LoneSpring& spring, std::uint64_t seed);

/// Force against elongation as a small SVG; the same bytes on every machine.
std::string picture(const std::string& title, const std::vector<PathPoint>& path);

}  // namespace hyperlattice::contract
