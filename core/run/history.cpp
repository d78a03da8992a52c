#include <run/history.hpp>
#include <state/archive.hpp>

#include <spdlog/fmt/fmt.h>

#include <iterator>

namespace hyperlattice {

History::History(RunFolder& folder)
    : table_(folder.table(
          "history.csv",
          {"time", "step", "kinetic", "kinetic_mean", "stored", "dissipated", "dissipated_failure",
           "dissipated_damping", "injected", "balance_error", "relative_error", "momentum_x",
           "momentum_y", "momentum_z", "broken_open", "broken_closed"})) {}

void History::write(const Record& record) {
  const EnergyBalance& b = record.balance;
  const double values[] = {record.time,
                           static_cast<double>(record.step),
                           b.kinetic,
                           b.kinetic_mean,
                           b.stored,
                           b.dissipated(),
                           b.dissipated_failure,
                           b.dissipated_damping,
                           b.injected,
                           b.error,
                           b.relative_error(),
                           b.momentum.x,
                           b.momentum.y,
                           b.momentum.z,
                           static_cast<double>(record.broken_open),
                           static_cast<double>(record.broken_closed)};
  table_.row(values);
}

FailureLog::FailureLog(RunFolder& folder, Archive* resumed)
    : table_(folder.table("failures.csv",
                          {"step", "time", "particle_a", "particle_b", "elongation"})) {
  if (resumed != nullptr) (*resumed)(written_);
}

void FailureLog::save(Archive& archive) { archive(written_); }

void FailureLog::write_new(const std::vector<Breakage>& breakages) {
  if (written_ == breakages.size()) return;
  std::string lines;
  for (; written_ < breakages.size(); ++written_) {
    const Breakage& b = breakages[written_];
    fmt::format_to(std::back_inserter(lines), "{},{},{},{},{}\n", b.step, b.time, b.a, b.b,
                   b.elongation);
  }
  table_.lines(lines);
}

}  // namespace hyperlattice
