// Saves and restores the state of a run, one part after another.
#include <state/state.hpp>

namespace hyperlattice {

void Simulation::prepare_to_save() const { state_->damage.gather(); }
void Simulation::pass_to_first() { state_->blocks.pass_to_first(); }

void Simulation::archive(Archive& archive) {
  if (!archive.restores()) prepare_to_save();
  state_->blocks.archive(archive);
  state_->added.archive(archive);
  state_->sweeps.archive(archive);
  state_->clock.archive(archive);
  state_->loads.archive(archive);
  state_->failures.archive(archive);
  state_->energy.archive(archive);
  if (!state_->damage.empty()) state_->damage.archive(archive);
}

void Simulation::archive_body(Archive& archive) {
  if (!archive.restores()) gather_in_first();
  state_->blocks.archive_body(archive);
  state_->added.archive(archive);
  state_->sweeps.archive(archive);
  state_->clock.archive(archive);
  state_->failures.archive(archive);
  state_->energy.archive(archive);
  if (archive.restores()) state_->energy.forget_start();
  if (!state_->damage.empty()) state_->damage.archive(archive);
}

}  // namespace hyperlattice
