// Watches the momentum of a body that only given forces act on:
//   p(t) = p(t0) + sum over loads of force times the integral of its factor + mass g (t - t0).
// Where a load prescribes motion or answers to it, or damping acts, the momentum that goes out is
// not known from outside of the state, and nothing is watched. In single precision round-off of
// many equal steps may add up to a drift, and nothing is watched either.
#pragma once

#include <model/model.hpp>
#include <state/archive.hpp>
#include <state/energy_balance.hpp>

#include <vector>

namespace hyperlattice {

class MomentumWatch {
 public:
  explicit MomentumWatch(const Model& model);

  /// Starts anew at the next record.
  void start() { now_.known = 0; }
  /// Takes a record at `time`, s. Returns the error of the momentum over the gross momentum: the
  /// larger of the gross impulse so far and sqrt(2 M E), the most that particles of the mass M with
  /// the largest energy so far can have. 0 if nothing is watched, and where motion was set, stopped
  /// or damped since the record before.
  double error_of(const EnergyBalance& balance, double time);
  void archive(Archive& archive) { archive(now_); }

 private:
  /// A plain record: part of the checkpoint.
  struct Now {
    double time = 0;                  ///< of the last record, s
    Vec3 expected;                    ///< momentum then, N s
    double gross = 0;                 ///< sum of the magnitudes of impulses, N s
    std::uint64_t interventions = 0;  ///< EnergyBalance::interventions
    std::uint64_t known = 0;          ///< 1 from the first record on
  };

  const Model& model_;
  bool watches_;                     ///< loads only push with forces that are given
  double mass_ = 0;                  ///< of the body, kg
  std::vector<Vec3> force_;          ///< amplitude of each load, summed, N
  std::vector<double> force_gross_;  ///< and of the magnitudes, N
  Now now_;
};

}  // namespace hyperlattice
