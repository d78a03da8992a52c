// history.csv: the energy books, the momentum and the broken springs at every record; failures.csv:
// every spring that broke.
#pragma once

#include <run/folder.hpp>
#include <state/simulation.hpp>

namespace hyperlattice {

/// What one record holds.
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

/// Only for runs with a failure criterion.
class FailureLog {
 public:
  explicit FailureLog(RunFolder& folder, Archive* resumed = nullptr);
  void save(Archive& archive);
  void write_new(const std::vector<Breakage>& breakages);  ///< those that came since the last call

 private:
  Table& table_;
  std::uint64_t written_ = 0;
};

}  // namespace hyperlattice
