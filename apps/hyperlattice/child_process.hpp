// A process of this program with other arguments, and the signals that ask to stop.
#pragma once

#include <base/descriptor.hpp>

#include <sys/types.h>

#include <chrono>
#include <csignal>
#include <optional>
#include <string>
#include <vector>

namespace hyperlattice {

/// Holds back the signals INT, TERM and HUP, and the one that a child has ended, during its life.
class StopSignals {
 public:
  /// Throws OutsideError if the system refuses.
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Waits until a signal comes, `descriptor` can be read, or the time is over. Returns whether
  /// `descriptor` can be read.
  bool wait(int descriptor, std::chrono::milliseconds time);
  /// Returns whether a signal asked to stop, at any time.
  bool asked_to_stop() const { return asked_; }
  /// Returns whether a signal asked to stop since the last call.
  bool take_request();

 private:
  void read();

  sigset_t before_{};
  Descriptor signals_;
  bool asked_ = false, is_new_ = false;
};

/// A child in a process group of its own, so that Ctrl-C in a terminal reaches only this program,
/// which passes it on once. If this program is killed, the child is interrupted.
class ChildProcess {
 public:
  /// How a child ended.
  struct End {
    int exit_code = 0;
    int signal = 0;  ///< that ended it; 0: none
  };

  /// Starts this program. `words`: its name and its arguments. Throws OutsideError if the system
  /// refuses.
  explicit ChildProcess(const std::vector<std::string>& words);
  /// Kills the child if it has not ended.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  /// Interrupts the child.
  void stop() const { ::kill(process_, SIGINT); }
  /// Returns how the child ended; nothing while it lives.
  std::optional<End> ended();

 private:
  pid_t process_ = -1;
  bool has_ended_ = false;
};

}  // namespace hyperlattice
