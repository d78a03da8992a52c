// Log messages of the core, kept until Python takes them: only a thread that holds Python's lock
// may give them to Python.
#pragma once

#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace hyperlattice::python {

/// A message, and its level as a number of Python's `logging`.
using LogLine = std::pair<int, std::string>;

/// The messages of one piece of work. All members are safe to call from several threads.
class LogQueue {
 public:
  void add(LogLine line);
  /// Returns the messages since the last call, in their order.
  std::vector<LogLine> take();

 private:
  std::mutex mutex_;
  std::vector<LogLine> lines_;
};

/// Sends the messages of the thread that makes it to a queue, during its life.
class LogScope {
 public:
  explicit LogScope(LogQueue& queue);
  LogScope(const LogScope&) = delete;
  LogScope& operator=(const LogScope&) = delete;
  ~LogScope();
};

/// Replaces the log of the core by one that fills the queues. Messages of threads without a queue
/// go to standard error.
void catch_log();

}  // namespace hyperlattice::python
