// checkpoint.bin: a run at a point from which it can go on, so that nothing tells that it was ever cut off. It belongs to one scene, one version of
// the program and its plugins, and one number of threads.
#pragma once

#include <plan/plan.hpp>
#include <run/archive.hpp>

#include <filesystem>

namespace hyperlattice {

inline constexpr const char* checkpoint_file = "checkpoint.bin";

/// What stands before the state.
struct CheckpointHead {
  std::uint64_t identity = 0;  ///< of the resolved scene, the program and the plugins
  std::int32_t threads = 1;
  bool at_start = false;  ///< nothing was done yet that is worth keeping
};

/// The head for this plan.
CheckpointHead checkpoint_head(const Plan& plan, bool at_start);

/// Of the checkpoint in a folder. InputError if there is none, or none of this plan.
CheckpointHead read_checkpoint_head(const Plan& plan, const std::filesystem::path& directory);

using Visit = std::function<void(Archive&)>;
/// Writes head and state; the file stands under its name only when it is whole. std::runtime_error if the disk refuses.
void write_checkpoint(const std::filesystem::path& directory, const CheckpointHead& head, const Visit& state);
/// Restores the state. std::runtime_error if the file is cut off or damaged.
void read_checkpoint(const std::filesystem::path& directory, const Visit& state);

}  // namespace hyperlattice
