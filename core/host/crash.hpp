// Last message of a program that a plugin ends: by a signal, by exit(), or by loading for too long.
// The last line names the plugin, and the exit code is that of a failed plugin.
#pragma once

namespace hyperlattice {

/// Installs handlers that name the running plugin after a crash signal, a call of exit(), or an
/// uncaught exception for lack of memory. Call it once, before any plugin is loaded: exit handlers
/// that are registered first run last. Earlier handlers of these signals, for example of
/// sanitizers, run afterwards.
void report_crashes();

/// Limits the time for loading a library: HYPERLATTICE_LOAD_SECONDS in the environment, 60 s by
/// default. Ends the program after that time.
class LoadWatch {
 public:
  explicit LoadWatch(const char* library);  ///< `library` outlives the watch
  LoadWatch(const LoadWatch&) = delete;
  LoadWatch& operator=(const LoadWatch&) = delete;
  ~LoadWatch();
};

}  // namespace hyperlattice
