// What the program still says when a plugin ends it: by a signal, by exit(), or by never returning
// from its loading. The last line names the plugin, and the exit code is that of a failed plugin.
#pragma once

namespace hyperlattice {

/// Names the plugin that is running when the program gets a signal of a crash, exit() is called, or
/// an exception for lack of memory cannot be caught. Called once, before any plugin is loaded:
/// handlers registered first run last. Other handlers of these signals, as of sanitizers, run after
/// it.
void report_crashes();

/// A library's loading, which must end within so many seconds: HYPERLATTICE_LOAD_SECONDS in the
/// environment, 60 by default. Ends the program if not.
class LoadWatch {
 public:
  explicit LoadWatch(const char* library);  ///< outlives the watch
  LoadWatch(const LoadWatch&) = delete;
  LoadWatch& operator=(const LoadWatch&) = delete;
  ~LoadWatch();
};

}  // namespace hyperlattice
