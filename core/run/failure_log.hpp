// failures.csv: every broken spring, in runs with a failure criterion.
#pragma once

#include <run/folder.hpp>
#include <state/archive.hpp>
#include <state/simulation.hpp>

#include <vector>

namespace hyperlattice {

/// All members throw OutsideError if the disk refuses.
class FailureLog {
 public:
  explicit FailureLog(RunFolder& folder) : folder_(folder) {}
  void archive(Archive& archive) { archive(written_); }
  /// Begins the table, or continues it.
  void begin();

  /// Writes the breakages since the last call.
  void write_new(const std::vector<Breakage>& breakages);

 private:
  RunFolder& folder_;
  Table* table_ = nullptr;
  std::uint64_t written_ = 0;  ///< number of breakages in the table
};

}  // namespace hyperlattice
