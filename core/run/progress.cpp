#include <run/progress.hpp>

#include <spdlog/fmt/fmt.h>

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace hyperlattice {

std::string clock_time(double seconds) {
  const auto whole = std::llround(seconds);
  const long long hours = whole / 3600, minutes = whole / 60 % 60, rest = whole % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, rest)
                   : fmt::format("{}:{:02}", minutes, rest);
}

Progress::Progress(std::uint64_t steps, bool quiet) : steps_(steps) {
  using namespace std::chrono_literals;
  const char* wish = std::getenv("HYPERLATTICE_PROGRESS");
  if (quiet)
    form_ = Form::none;
  else if (wish != nullptr && std::string_view(wish) == "json")
    form_ = Form::json;
  else
    form_ = ::isatty(STDERR_FILENO) != 0 ? Form::terminal : Form::lines;
  pause_ = form_ == Form::terminal ? Clock::duration(100ms)
           : form_ == Form::json   ? Clock::duration(500ms)
                                   : Clock::duration(5s);
}

Progress::~Progress() {
  if (line_open_) std::fputc('\n', stderr);
}

void Progress::update(std::uint64_t step, double time, double time_step, std::uint64_t broken,
                      double residual) {
  if (form_ == Form::none) return;
  const auto now = Clock::now();
  if (now - shown_ < pause_ && step != steps_) return;
  shown_ = now;
  const double spent = std::chrono::duration<double>(now - start_).count();
  const double fraction = steps_ > 0 ? static_cast<double>(step) / static_cast<double>(steps_) : 1;
  const double left = step > 0 && fraction < 1
                          ? spent * (1 / fraction - 1)
                          : 0;  // a search for rest may take more steps than planned
  std::string line;
  if (form_ == Form::json) {
    const std::string rest = residual >= 0 ? fmt::format(",\"residual\":{}", residual) : "";
    line = fmt::format(
        "{{\"step\":{},\"steps\":{},\"time\":{},\"time_step\":{},\"eta_seconds\":{:.3f},\"broken_"
        "springs\":{}{}}}\n",
        step, steps_, time, time_step, left, broken, rest);
  } else {
    line = fmt::format("step {}/{} ({:.1f}%)  t {:.4g} s  dt {:.3g} s  ETA {}", step, steps_,
                       100 * fraction, time, time_step, clock_time(left));
    if (residual >= 0) line += fmt::format("  residual {:.2g}", residual);
    if (broken > 0) line += fmt::format("  broken {}", broken);
    line = form_ == Form::terminal ? "\r" + line + "\x1b[K" : line + "\n";
    line_open_ = form_ == Form::terminal;
  }
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace hyperlattice
