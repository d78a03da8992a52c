// Runs the tasks that a writer gives to Snapshot::for_each.
#pragma once

#include <process/team.hpp>

#include <cstdint>

namespace hyperlattice {

/// Calls task(work, n) for each n below `count` on the threads of the team, for the plugin that the
/// caller's thread runs. Errors of the host wait in its PluginCall.
void run_writer_tasks(Team& team, std::uint64_t count, void* work,
                      void (*task)(void* work, std::uint64_t n) noexcept);

}  // namespace hyperlattice
