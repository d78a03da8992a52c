// history.csv: the energy balance, the momentum and the number of broken springs at every record.
// failures.csv: every broken spring.
#pragma once

#include <run/folder.hpp>
#include <state/simulation.hpp>

namespace hyperlattice {

/// One row of history.csv.
struct Record {
  double time = 0;  ///< s
  std::uint64_t step = 0;
  EnergyBalance balance;
  std::uint64_t broken_open = 0, broken_closed = 0;
};

class History {
 public:
  explicit History(RunFolder& folder);
  void write(const Record& record);

 private:
  Table& table_;
};

/// failures.csv, only for runs with a failure criterion.
class FailureLog {
 public:
  explicit FailureLog(RunFolder& folder, Archive* resumed = nullptr);
  void save(Archive& archive);
  /// Writes the breakages since the last call.
  void write_new(const std::vector<Breakage>& breakages);

 private:
  Table& table_;
  std::uint64_t written_ = 0;
};

}  // namespace hyperlattice
