// Calls between the host and its plugins: who is running, and how errors go both ways. No exception
// crosses: a plugin's becomes a sentence in its own library (plain.hpp), the host's waits in the
// call until the plugin's function has returned.
#pragma once

#include <base/errors.hpp>

#include <hyperlattice/plain.hpp>

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace hyperlattice {

/// What a plugin asked for or handed over cannot be used: a sentence about the plugin as "it".
class PluginMistake : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A plugin's failure as an error of the outside. `place`: of its stage in the scene, as a JSON
/// pointer; may be empty.
OutsideError plugin_failure(std::string_view name, std::string_view place, std::string_view library,
                            std::string_view function, std::string_view sentence);

/// A call of a plugin's function, on the thread that makes it, from its construction to its
/// destruction. While it lasts, a crash on this thread is the plugin's, and the last line of the
/// program names it (crash.hpp).
class PluginCall {
 public:
  /// `name`: of the component; `library`: its file; `function`: what is called; `place`: as for
  /// plugin_failure(). All outlive the call. Null and empty for code of the host's own that answers
  /// as a plugin does.
  PluginCall(std::string_view name, const char* library, const char* function,
             std::string_view place = {}) noexcept;
  PluginCall(const PluginCall&) = delete;
  PluginCall& operator=(const PluginCall&) = delete;
  ~PluginCall();

  /// For the plugin's function.
  const Complaint& why() const { return why_; }
  /// To be asked when the function has returned. Throws what functions of the host threw meanwhile,
  /// and OutsideError if the plugin got no memory, or std::bad_alloc if code of the host's own did
  /// not. Returns the plugin's sentence, visible and in one line, if it has failed, or null.
  const std::string* failure(bool done);

  /// Runs code of the host that a plugin has called; every function that a plugin is given goes
  /// through this. What the code throws waits in the call, and the plugin gets `otherwise`.
  template <class Result, class Code>
  static Result answer(Result otherwise, Code&& code) noexcept {
    const HostCode running;
    try {
      return code();
    } catch (...) {
      if (running.caller == nullptr)
        std::terminate();  // on a thread of the plugin's own; it prints the sentence
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

  /// The plugin that this thread is running; null while it runs code of the host.
  static const PluginCall* running() noexcept;
  std::string_view name() const { return name_; }
  const char* library() const { return library_; }
  const char* function() const { return function_; }

 private:
  /// While it lives, this thread runs the host's code.
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
