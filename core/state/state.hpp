// The parts of a simulation, each after those that it uses.
#pragma once

#include <state/acting_loads.hpp>
#include <state/added_mass.hpp>
#include <state/array_criteria.hpp>
#include <state/block_set.hpp>
#include <state/clock.hpp>
#include <state/damage_field.hpp>
#include <state/energy_account.hpp>
#include <state/failure_record.hpp>
#include <state/force_sums.hpp>
#include <state/kinetic_energy.hpp>
#include <state/law_memory.hpp>
#include <state/local_steps.hpp>
#include <state/nodal_pressures.hpp>
#include <state/other_rows.hpp>
#include <state/simulation.hpp>
#include <state/spring_review.hpp>
#include <state/sweeps.hpp>
#include <state/whole_review.hpp>

namespace hyperlattice {

struct Simulation::State {
  BlockSet blocks;
  Clock clock;
  ActingLoads loads{blocks, clock};
  DamageField damage{blocks, clock};
  ArrayCriteria arrays{blocks, clock};
  SpringReview review{blocks, clock, damage, arrays};
  NodalPressures pressures{blocks};
  LocalForces local{blocks, loads, review};
  AddedMass added{blocks};
  OtherRows other_rows{blocks, review, pressures, damage, local};
  Sweeps sweeps{blocks, loads, arrays, review, pressures, damage, local, added, other_rows};
  WholeReview whole_review{blocks, review, arrays};
  FailureRecord failures{blocks, clock, pressures};
  EnergyAccount energy{blocks, clock, failures, sweeps};
  LawMemory law_memory{blocks, energy};
  KineticEnergy kinetic{blocks};
  ForceSums force_sums{blocks, clock, loads, pressures, damage, sweeps};

  State(const Model& model, int threads, Ranks& ranks, int count)
      : blocks(model, threads, ranks, count) {}

  /// Advances the body by a step of this length, s.
  void step(double length);
  /// Gives the body the critical step `time_step`, s, by added mass, between two steps; 0: none.
  void set_added_mass(double time_step);

 private:
  void change_step(double length);
};

}  // namespace hyperlattice
