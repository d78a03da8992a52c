#include <run/failure_log.hpp>

#include <spdlog/fmt/fmt.h>

#include <iterator>

namespace hyperlattice {

void FailureLog::begin() {
  table_ = &folder_.table("failures.csv",
                          {"step", "time", "particle_a", "particle_b", "elongation", "softened"});
}

void FailureLog::write_new(const std::vector<Breakage>& breakages) {
  if (written_ == breakages.size()) return;
  std::string lines;
  for (; written_ < breakages.size(); ++written_) {
    const Breakage& b = breakages[written_];
    fmt::format_to(std::back_inserter(lines), "{},{},{},{},{},{:d}\n", b.step, b.time, b.a, b.b,
                   b.elongation, b.softened);
  }
  table_->lines(lines);
}

}  // namespace hyperlattice
