// checkpoint.bin: the complete state of a run, from which it continues as if it had never stopped.
// A checkpoint belongs to one scene, one version of the program and its plugins, and one number of
// threads. The previous checkpoint stays beside it, in case the newest is damaged.
#pragma once

#include <plan/file_names.hpp>
#include <plan/plan.hpp>
#include <run/folder.hpp>
#include <state/archive.hpp>

#include <filesystem>

namespace hyperlattice {

/// The part of a checkpoint before the state.
struct CheckpointHead {
  Identity identity;  ///< what the run depends on
  std::int32_t blocks = 1;
  bool at_start = false;  ///< the run has made no progress that is worth keeping
  std::uint64_t step = 0;
  double time = 0;                ///< s
  std::vector<TableMark> tables;  ///< the tables that the run had written
};

struct Checkpoint {
  std::filesystem::path file;
  CheckpointHead head;
};

/// Returns the head for this plan, without tables.
CheckpointHead checkpoint_head(const Plan& plan, bool at_start);

/// Returns the newest undamaged checkpoint in a folder. Logs a warning if a newer one is damaged or
/// missing. Throws InputError if there is none, or none of this plan.
Checkpoint find_checkpoint(const Plan& plan, const std::filesystem::path& directory);

/// Throws InputError if a folder has no checkpoint, or no list of the run's files.
void must_be_resumable(const std::filesystem::path& directory);

/// Returns where in the run the folder's newest checkpoint is, as a clause for messages: "step 12,
/// t = 1e-05 s, in checkpoint.bin". Empty if there is none worth keeping, or a damaged one.
std::string place_of_checkpoint(const std::filesystem::path& directory);
/// Returns whether the folder has a checkpoint worth keeping; a damaged one counts.
bool holds_progress(const std::filesystem::path& directory);

using Visit = std::function<void(Archive&)>;
/// Writes head and state. On return the checkpoint is on the disk under its name, and the previous
/// one under the other name. Throws std::runtime_error if the disk refuses; the newest of the
/// earlier checkpoints then exists under one of the two names.
void write_checkpoint(const std::filesystem::path& directory, const CheckpointHead& head,
                      const Visit& state);
/// Restores the state. Throws std::runtime_error if the checkpoint does not fit.
void read_checkpoint(const Checkpoint& checkpoint, const Visit& state);
/// Removes both checkpoints. Throws OutsideError if the system refuses.
void remove_checkpoints(const std::filesystem::path& directory);

}  // namespace hyperlattice
