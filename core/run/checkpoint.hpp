// checkpoint.bin: a run at a point from which it can go on, so that nothing tells that it was ever
// cut off. It belongs to one scene, one version of the program and its plugins, and one number of
// threads. The checkpoint before it stays beside it, for the case that the newest is damaged.
#pragma once

#include <plan/file_names.hpp>
#include <plan/plan.hpp>
#include <run/folder.hpp>
#include <state/archive.hpp>

#include <filesystem>

namespace hyperlattice {

/// What stands before the state.
struct CheckpointHead {
  Identity identity;  ///< what the run depends on
  std::int32_t threads = 1;
  bool at_start = false;          ///< nothing was done yet that is worth keeping
  std::vector<TableMark> tables;  ///< what the run had written
};

struct Checkpoint {
  std::filesystem::path file;
  CheckpointHead head;
};

/// The head for this plan, without tables.
CheckpointHead checkpoint_head(const Plan& plan, bool at_start);

/// The newest checkpoint in a folder of which every byte is as it was written. Says so if that is
/// not the newest of all. InputError if there is none, or none of this plan.
Checkpoint find_checkpoint(const Plan& plan, const std::filesystem::path& directory);

/// InputError if a folder has no checkpoint, or no list of the run's files.
void must_be_resumable(const std::filesystem::path& directory);

/// Whether a checkpoint is there that is worth keeping; a damaged one is.
bool holds_progress(const std::filesystem::path& directory);

using Visit = std::function<void(Archive&)>;
/// Writes head and state. When this returns, the checkpoint is on the disk under its name, and the
/// one before it under the other. std::runtime_error if the disk refuses: the newest of the
/// checkpoints before is then there, under one of the two names.
void write_checkpoint(const std::filesystem::path& directory, const CheckpointHead& head,
                      const Visit& state);
/// Restores the state. std::runtime_error if the checkpoint does not fit.
void read_checkpoint(const Checkpoint& checkpoint, const Visit& state);
/// Removes both. OutsideError if the system refuses.
void remove_checkpoints(const std::filesystem::path& directory);

}  // namespace hyperlattice
