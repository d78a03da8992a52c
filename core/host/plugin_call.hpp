// Calls between the host and its plugins. No exception crosses this boundary: the plugin's library
// turns its exceptions into sentences (plain.hpp), and exceptions of the host wait in the
// PluginCall until the plugin's function has returned.
#pragma once

#include <base/errors.hpp>

#include <hyperlattice/plain.hpp>

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace hyperlattice {

/// A request or a value of a plugin that the host cannot use: a sentence in which "it" is the
/// plugin.
class PluginMistake : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Returns the OutsideError for a plugin's failure. `place`: JSON pointer of the stage in the
/// scene; may be empty.
OutsideError plugin_failure(std::string_view name, std::string_view place, std::string_view library,
                            std::string_view function, std::string_view sentence);

/// A call of a plugin's function on the present thread, from construction to destruction. If the
/// thread crashes during the call, the last line of the program names the plugin (crash.hpp).
class PluginCall {
 public:
  /// `name`: the component; `library`: its file; `function`: the function called; `place`: as for
  /// plugin_failure(). All of them outlive the call. Empty name and null library: code of the host
  /// that reports errors as a plugin does.
  PluginCall(std::string_view name, const char* library, const char* function,
             std::string_view place = {}) noexcept;
  PluginCall(const PluginCall&) = delete;
  PluginCall& operator=(const PluginCall&) = delete;
  ~PluginCall();

  /// Returns the Complaint to pass to the plugin's function.
  const Complaint& why() const { return why_; }
  /// Returns null if the function succeeded (`done`), otherwise the plugin's sentence, visible and
  /// in one line. Call it after the function has returned. Rethrows what functions of the host
  /// threw during the call. If memory ran out, throws OutsideError for a plugin and std::bad_alloc
  /// for code of the host.
  const std::string* failure(bool done);

  /// Runs code of the host that a plugin has called; every function that a plugin gets uses it. An
  /// exception waits in the call, and the plugin gets `otherwise`.
  template <class Result, class Code>
  static Result answer(Result otherwise, Code&& code) noexcept {
    const HostCode running;
    try {
      return code();
    } catch (...) {
      // the plugin called from a thread of its own; terminate prints the message
      if (running.caller == nullptr) std::terminate();
      running.caller->keep(std::current_exception());
      return otherwise;
    }
  }
  template <class Code>
  static void answer(Code&& code) noexcept {
    answer(true, [&] {
      code();
      return true;
    });
  }

  /// Returns the call of a plugin that this thread executes; null while the thread runs code of the
  /// host.
  static const PluginCall* running() noexcept;
  std::string_view name() const { return name_; }
  const char* library() const { return library_; }
  const char* function() const { return function_; }

 private:
  /// Marks, while it exists, that this thread runs code of the host.
  struct HostCode {
    HostCode() noexcept;
    ~HostCode();
    PluginCall* const caller;
  };
  void keep(std::exception_ptr thrown) noexcept {
    if (!thrown_) thrown_ = std::move(thrown);
  }

  std::string_view name_, place_;
  const char *library_, *function_;
  PluginCall* const before_;
  Complaint why_;
  std::string sentence_;
  std::exception_ptr thrown_;
};

}  // namespace hyperlattice
