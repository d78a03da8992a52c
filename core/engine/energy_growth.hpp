// Finds motions that feed on nothing: kinetic or stored energy that grows from record to record far
// beyond all energy that was put in.
//
// Without errors kinetic energy is never more than the energy at the start, the work of the loads
// that did positive work, and what stored energy below zero gave. An unstable mode of central
// differences keeps the balance: its stored energy grows as its kinetic energy v(n-1/2).M.v(n+1/2)
// falls below zero. So the balance does not show it, and this ratio does. Stable steps of r
// critical ones may store 1 / (1 - r^2) times the energy of a linear motion.
#pragma once

#include <state/energy_balance.hpp>

#include <cstdint>
#include <span>

namespace hyperlattice {

/// A plain record: part of the checkpoint.
class EnergyGrowth {
 public:
  /// Takes a record of the balance, with the work of each load, J. `step_ratio`: the step over the
  /// stable one, below 1; 0 for implicit steps. Returns whether the energy runs away beyond `limit`
  /// times what was put in; never for a `limit` of 0.
  bool runs_away(const EnergyBalance& balance, std::span<const double> work, double step_ratio,
                 double limit);
  /// Returns the largest energy of the last record over all that was put in; 0: nothing was.
  double ratio() const { return ratio_; }

 private:
  double ratio_ = 0;
  double put_in_ = 0;        ///< the most so far, J: loads may take back what they gave
  std::uint64_t grown_ = 0;  ///< records in a row in which the ratio grew
};

}  // namespace hyperlattice
