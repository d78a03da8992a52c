// The progress of a run on standard error: one line that is rewritten on a terminal, else a line
// every few seconds, or JSON lines for programs (HYPERLATTICE_PROGRESS=json).
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace hyperlattice {

class Progress {
 public:
  Progress(std::uint64_t steps, bool quiet);
  ~Progress();  ///< ends the line on a terminal

  /// Shows the state if the last update was long enough ago. `residual`: of a search for rest, or
  /// below 0 if there is none.
  void update(std::uint64_t step, double time, double time_step, std::uint64_t broken,
              double residual = -1);

 private:
  using Clock = std::chrono::steady_clock;
  enum class Form { none, terminal, lines, json };

  std::uint64_t steps_;
  Form form_ = Form::none;
  Clock::time_point start_ = Clock::now(), shown_ = start_;
  Clock::duration pause_{};
  bool line_open_ = false;
};

/// "1:02:03", "4:05", "0:12".
std::string clock_time(double seconds);

}  // namespace hyperlattice
