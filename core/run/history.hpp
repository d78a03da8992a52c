// history.csv: the energy balance, the momentum, the number of broken springs, what cracks there
// are in cohesive materials, and the work of each load at every record.
#pragma once

#include <run/folder.hpp>
#include <state/archive.hpp>
#include <state/simulation.hpp>

namespace hyperlattice {

/// One row of history.csv.
struct Record {
  double time = 0;  ///< s
  std::uint64_t step = 0;
  EnergyBalance balance;
  std::uint64_t broken_open = 0, broken_closed = 0;
  CrackSurface cracks;
};

/// Returns the names of the columns of history.csv in a run of this model.
std::vector<std::string> history_columns(const Model& model);

class History {
 public:
  History(RunFolder& folder, const Model& model)
      : folder_(folder), model_(model), has_cracks_(!model.cohesive.empty()) {}
  void archive(Archive& archive);
  /// Begins the table, or continues it. Throws OutsideError if the disk refuses.
  void begin();

  /// Returns whether the latest record is of this step.
  bool has(std::uint64_t step) const { return has_record_ && last_.step == step; }
  /// Makes this record the latest.
  void take(const Record& record);
  /// Writes the latest record, with the work of each load, J. Throws OutsideError if the disk
  /// refuses.
  void write(const std::vector<double>& work);

  const Record& last() const { return last_; }
  /// Returns the largest relative error of the energy balance in all records.
  double largest_relative_error() const { return largest_relative_error_; }

 private:
  RunFolder& folder_;
  const Model& model_;
  const bool has_cracks_;
  Table* table_ = nullptr;
  Record last_;
  bool has_record_ = false;
  double largest_relative_error_ = 0;
};

}  // namespace hyperlattice
