#include <run/failure_log.hpp>

#include <spdlog/fmt/compile.h>
#include <spdlog/fmt/fmt.h>

#include <string>

namespace hyperlattice {

void FailureLog::begin() {
  table_ = &folder_.table("failures.csv",
                          {"step", "time", "particle_a", "particle_b", "elongation", "softened"});
}

void FailureLog::write_new(const std::vector<Breakage>& breakages) {
  if (written_ == breakages.size()) return;
  fmt::memory_buffer lines;
  std::string beginning;  // that breakages of one step share
  const std::uint64_t first = written_;
  for (; written_ < breakages.size(); ++written_) {
    const Breakage& b = breakages[written_];
    if (written_ == first || b.step != breakages[written_ - 1].step)
      beginning = fmt::format("{},{},", b.step, b.time);
    lines.append(beginning);
    fmt::format_to(fmt::appender(lines), FMT_COMPILE("{},{},{},{:d}\n"), b.a, b.b, b.elongation,
                   b.softened);
  }
  table_->lines({lines.data(), lines.size()});
}

}  // namespace hyperlattice
