#include <host/plugin_call.hpp>
#include <run/writer_tasks.hpp>

namespace hyperlattice {

/// Each thread counts as one that runs the plugin, so that a crash names it.
void run_writer_tasks(Team& team, std::uint64_t count, void* work,
                      void (*task)(void* work, std::uint64_t n) noexcept) {
  const PluginCall* caller = PluginCall::running();
  PluginCall::answer([&] {
    team.for_each(count, [&](std::size_t n) {
      PluginCall part(caller->name(), caller->library(), caller->function());
      task(work, n);
      part.failure(true);
    });
  });
}

}  // namespace hyperlattice
