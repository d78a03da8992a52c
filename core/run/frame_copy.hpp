// A copy of the fields of one moment. A writer reads it while the simulation goes on.
#pragma once

#include <process/team.hpp>
#include <run/snapshot.hpp>

#include <set>
#include <string>

namespace hyperlattice {

/// Names of the fields that are copied.
using FieldNames = std::set<std::string, std::less<>>;

class FrameCopy {
 public:
  /// `team`: runs the tasks of writers.
  FrameCopy(const Model& model, Team& team);
  FrameCopy(const FrameCopy&) = delete;
  FrameCopy& operator=(const FrameCopy&) = delete;

  /// Takes the latest state of the source with these fields, which the run has.
  void take(SnapshotSource& source, const FieldNames& fields);
  /// Returns the copy, valid until the next take(). A request for a field that was not copied fails
  /// as a mistake of the plugin. Use it in a PluginCall.
  const Snapshot& snapshot() const { return snapshot_; }

 private:
  bool field(std::string_view name, Field& out) const;

  const Model& model_;
  Team& team_;
  Snapshot snapshot_;
  std::map<std::string, FieldValues, std::less<>> fields_;
};

}  // namespace hyperlattice
