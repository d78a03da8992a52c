// Work in a thread of its own, for which Python waits without holding its lock.
#pragma once

#include "log_queue.hpp"

#include <chrono>
#include <functional>
#include <future>
#include <string>
#include <thread>

namespace hyperlattice::python {

/// Work that returns a text.
class Background {
 public:
  explicit Background(std::function<std::string()> work)
      : task_([this, work = std::move(work)] {
          const LogScope scope(log_);
          return work();
        }),
        result_(task_.get_future()),
        thread_([this] { task_(); }) {}
  Background(const Background&) = delete;
  Background& operator=(const Background&) = delete;
  ~Background() { thread_.join(); }

  /// Waits for at most so many seconds. Returns whether the work has ended.
  bool wait(double seconds) const {
    return result_.wait_for(std::chrono::duration<double>(seconds)) == std::future_status::ready;
  }
  /// Returns the text once, or throws what the work threw. Waits for the end of the work.
  std::string result() { return result_.get(); }
  std::vector<LogLine> take_log() { return log_.take(); }

 private:
  LogQueue log_;
  std::packaged_task<std::string()> task_;
  std::future<std::string> result_;
  std::thread thread_;
};

}  // namespace hyperlattice::python
