// The loads of a model and what they declared for particles.
#pragma once

#include <model/component_pointer.hpp>

#include <hyperlattice/load.hpp>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hyperlattice {

/// All that a load declared for one particle.
struct LoadedParticle {
  Particle particle = 0;
  Vec3 force;                      ///< amplitude of the force, N
  Axes displaced = 0, driven = 0;  ///< axes with a prescribed displacement, velocity
  Vec3 displacement, velocity;     ///< amplitudes, m and m/s
};
struct WatchedParticle {
  Particle particle = 0;
  bool answered = true;  ///< false: the load reads the motion but exerts no force
  LoadStiffnessBound reaction;
};
struct Load {
  const Stage* stage = nullptr;
  ComponentPointer component;
  std::vector<LoadedParticle> particles;  ///< ascending, each once
  std::vector<WatchedParticle> watched;   ///< in the order in which the load named them
  std::vector<double> corners;  ///< times of kinks and jumps of the factor, s; ascending, each once
  std::uint64_t memory = 0;     ///< how many numbers the load keeps from one step to the next
  double frequency = 0;  ///< highest frequency at which the factor oscillates, Hz; 0: none declared
  Vec3 acceleration;
  // Each of these functions throws OutsideError if the load throws. They do not check for NaN; the
  // run does.
  double factor(double time) const;
  /// Returns the factor at `time`; if `time` is a corner of the load, the value just after it.
  double after(double time) const;
  /// Returns the mean of the factor in [from, to]; exact between corners for polynomials up to
  /// degree 9.
  double mean(double from, double to) const;
  /// Returns the integral of the factor over an interval of any length, s, to about 1e-12.
  double integral(double from, double to) const;
  /// Value and slope, 1/s, of the factor just after `time`, or just before it if `reach` is
  /// negative. They are computed from samples within |reach| seconds, up to a corner.
  struct Limit {
    double value = 0, slope = 0;
  };
  Limit limit(double time, double reach) const;
  /// Returns whether prepare() must be called before the answers to a motion.
  bool prepares() const {
    return !watched.empty() && stage->functions<LoadFunctions>().prepare != nullptr;
  }
  void prepare(const WatchedMotion& motion) const;
  /// Advances the load's memory after the answers to a motion.
  void update(const WatchedMotion& motion, std::span<double> kept) const;
  /// Returns the force on the n-th watched particle, N.
  Vec3 answer(const WatchedMotion& motion, std::size_t n) const;

  /// Returns the particles that the load pushes or moves, ascending; a body acceleration acts on
  /// all `particles` of the body.
  std::vector<Particle> acts_on(std::uint64_t particles) const;
};

/// Start velocity, m/s, of each of `count` particles from `first` on.
struct StartVelocity {
  Particle first = 0;
  std::uint64_t count = 0;
  Vec3 velocity;
};

/// All loads, in the order of the scene, and what they set together. It reads as a list of loads.
struct LoadSet {
  std::vector<Load> all;
  std::vector<StartVelocity> start_velocities;  ///< ascending, each particle at most once
  std::vector<double> corners;                  ///< s; ascending, each once
  Vec3 acceleration;       ///< sum of the body accelerations of all loads, m/s2
  bool answering = false;  ///< whether a load watches the motion

  std::size_t size() const { return all.size(); }
  const Load& operator[](std::size_t n) const { return all[n]; }
  std::vector<Load>::const_iterator begin() const { return all.begin(); }
  std::vector<Load>::const_iterator end() const { return all.end(); }
};

}  // namespace hyperlattice
