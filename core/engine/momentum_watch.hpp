// Watches the momentum of a body that only given forces act on:
//   p(t) = p(t0) + sum over loads of force times the integral of its factor + mass g (t - t0).
// Where a load prescribes motion or answers to it, or damping acts, the momentum that goes out is
// not known from outside of the state, and nothing is watched.
#pragma once

#include <model/model.hpp>
#include <state/archive.hpp>
#include <state/energy_balance.hpp>

#include <vector>

namespace hyperlattice {

class MomentumWatch {
 public:
  explicit MomentumWatch(const Model& model);

  /// Starts anew at the next record. `damps`: whether damping or added mass acts in the stage.
  void start(bool damps) {
    go_on(damps);
    now_.known = 0;
  }
  /// Goes on from the records before, in a run that is resumed in the middle of a stage.
  void go_on(bool damps) { watches_ = acts_alone_ && !damps; }
  /// Takes a record at `time`, s. Returns the error of the momentum over the gross momentum: the
  /// larger of the gross impulse so far and sqrt(2 M kinetic energy), the most that particles with
  /// this energy can have. 0 if nothing is watched, and where the balance began anew.
  double error_of(const EnergyBalance& balance, double time);
  void archive(Archive& archive) { archive(now_); }

 private:
  /// A plain record: part of the checkpoint.
  struct Now {
    double time = 0;          ///< of the last record, s
    Vec3 expected;            ///< momentum then, N s
    double gross = 0;         ///< sum of the magnitudes of impulses, N s
    double largest = 0;       ///< sqrt(2 M kinetic energy) so far, N s
    double start_energy = 0;  ///< of the balance, J: another one means that it began anew
    std::uint64_t known = 0;  ///< 1 from the first record on
  };

  const Model& model_;
  bool acts_alone_ = true;  ///< whether loads only push with forces that are given
  bool watches_ = false;
  double mass_ = 0;                  ///< of the body, kg
  std::vector<Vec3> force_;          ///< amplitude of each load, summed, N
  std::vector<double> force_gross_;  ///< and of the magnitudes, N
  Now now_;
};

}  // namespace hyperlattice
