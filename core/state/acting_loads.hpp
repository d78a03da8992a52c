// Loads at the present time: the mean of their factors over the interval in which forces act, their
// answers to the motion, and the velocities of the particles that they move.
#pragma once

#include <state/block_set.hpp>
#include <state/clock.hpp>

#include <vector>

namespace hyperlattice {

/// One evaluation of all forces at the present time, and its purpose.
struct Sweep {
  /// The time, s, before and after the present time over which the forces act. Loads act by their
  /// mean over this interval.
  double before = 0, after = 0;
  /// The length, s, of the step in which prescribed particles move. 0: they have the limit of their
  /// velocity from before the present time.
  double step = 0;
  /// Half the duration, s, of the kick that a measurement computes from the acceleration.
  double measured = 0;

  /// Returns the measurement of the state after a step of this length, s.
  static Sweep present(double last_step) { return {last_step / 2, 0, 0, last_step / 2}; }
};

class ActingLoads {
 public:
  ActingLoads(BlockSet& blocks, const Clock& clock);

  /// Sets the factors of all loads. watch() fills in the motion that they watch.
  void prepare(const Sweep& sweep);
  /// Copies the motion of the block's watched particles to the loads.
  void watch(const Block& block);
  /// Copies that motion between the ranks, after watch() of their own blocks.
  void share_watched();
  /// Lets loads prepare their answers, after watch() of all blocks.
  void prepare_answers();
  /// Lets loads advance their memory, after the answers of a step.
  void update_memory();
  std::span<double> memory(std::size_t load) { return acting_[load].memory; }
  /// Calls visit(number) for each number that loads keep, in the order of the loads.
  template <class Visit>
  void for_memory(const Visit& visit) const {
    for (const Acting& load : acting_)
      for (const double number : load.memory) visit(number);
  }
  /// Sets the external forces on the block's boundary particles, and the velocities of those that
  /// loads move.
  void set_supports(Block& block, const Sweep& sweep) const;

  /// Gives the particles that a load moves the load's velocity, before a step of length `step`, s,
  /// that starts from rest. Returns whether this changed the state at the run's start; later it is
  /// the work of an impulse.
  bool start_motion(double step);
  /// Sets the goals of driven particles: the places where they will be at `time`, s.
  void set_goals(double time);

  /// Lets loads act with these factors, and body accelerations with this fraction, until the next
  /// step: those of a state of rest on the way of a static stage.
  void rest(std::vector<double> factors, double gravity);
  /// Ends this; loads act by their own factors.
  void leave_rest() { rest({}, 1); }
  /// Returns the fraction with which body accelerations act in the present state.
  double gravity() const { return gravity_; }
  void archive(Archive& archive);

  /// Throws RunError if a load factor is not a number, at the present time or in the sweep.
  void check_factors() const;
  /// Throws RunError if a load's answer to a sound motion is not finite.
  void check_answers() const;

 private:
  /// A load during a sweep, and the motion that it watches.
  struct Acting {
    double mean = 0;          ///< of the load factor over the sweep's interval
    double next = 0;          ///< load factor at the step's end
    double mean_of_step = 0;  ///< of the load factor from the present time to the step's end
    Load::Limit now;          ///< of the load factor at the present time
    bool moves = false;       ///< whether the load prescribes motion
    std::vector<Vec3> displacement, velocity;
    std::vector<double> memory;
    WatchedMotion motion;
  };

  void apply_forces(Block& block) const;
  double prescribed_velocity(const Block& block, const Contribution& part, int axis,
                             const Sweep& sweep) const;

  BlockSet& blocks_;
  const Model& model_;
  const Clock& clock_;
  std::vector<Acting> acting_;                        // one per load
  std::vector<std::vector<Block::Watched>> watched_;  // of each rank
  std::vector<double> rest_factors_;                  // one per load in a state of rest, else empty
  double gravity_ = 1;
};

}  // namespace hyperlattice
