// The launcher that started this process, if it started several for one run.
#pragma once

#include <memory>
#include <string>

namespace hyperlattice {

class Host;
class Ranks;

/// A launcher's word on how many processes it started.
struct Launcher {
  std::string variable;  ///< of the environment
  int processes = 1;
};

/// Returns what the environment says; one process if no known launcher started this one.
Launcher launcher();

/// Throws OutsideError if a launcher started several processes: for a command that runs in one, and
/// of which each process would write the same files.
void must_be_one_process(const std::string& command);

/// The word for no engine.
inline constexpr const char* no_engine = "none";

/// Joins the processes that a launcher started. `engine`: its type without the family, or "none";
/// empty: mpi if a launcher started several processes, else none. Throws OutsideError if the
/// launcher started several and there is no engine for them: each would run the whole scene.
std::unique_ptr<Ranks> join_ranks(Host& host, const std::string& engine);

}  // namespace hyperlattice
