#include <host/host.hpp>
#include <ranks/launcher.hpp>
#include <ranks/ranks.hpp>

#include <spdlog/fmt/fmt.h>

#include <charconv>
#include <cstdlib>
#include <string_view>

namespace hyperlattice {

Launcher launcher() {
  // Open MPI; MPICH, Intel MPI and Slurm with PMI; Slurm with PMIx.
  for (const char* variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"}) {
    const char* const text = std::getenv(variable);
    if (text == nullptr) continue;
    const std::string_view word = text;
    int processes = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), processes);
    if (error == std::errc() && end == word.data() + word.size() && processes > 1)
      return {variable, processes};
  }
  return {};
}

void must_be_one_process(const std::string& command) {
  const Launcher started = launcher();
  if (started.processes == 1) return;
  throw OutsideError(
      fmt::format("hyperlattice {} runs in one process, but a launcher started {} ({}={}): each "
                  "would write the "
                  "same files. Start it without the launcher.",
                  command, started.processes, started.variable, started.processes));
}

std::unique_ptr<Ranks> join_ranks(Host& host, const std::string& engine) {
  const Launcher started = launcher();
  if (engine == no_engine || (engine.empty() && started.processes == 1))
    return std::make_unique<Ranks>();
  const std::string type = "engines." + (engine.empty() ? "mpi" : engine);
  if (const Component* const component = host.find(type))
    return std::make_unique<Ranks>(*component);
  throw OutsideError(fmt::format(
      "{} cannot be loaded: {}.{}", type, host.why_not(type),
      started.processes == 1
          ? std::string()
          : fmt::format(" A launcher started {0} processes ({1}={0}). Without an engine each of "
                        "them would run the whole scene, and all would write the same files. "
                        "Install the engine, or say --engine none if this is what you want.",
                        started.processes, started.variable)));
}

}  // namespace hyperlattice
