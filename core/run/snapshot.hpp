// The view of a running simulation that writers and probes get.
#pragma once

#include <state/simulation.hpp>

#include <hyperlattice/output.hpp>

#include <exception>
#include <map>
#include <string>

namespace hyperlattice {

/// The numbers of a field at one time.
struct FieldValues {
  std::uint32_t components = 1;
  bool current = false;  ///< they are those of the present state
  std::vector<double> numbers;
};

/// Makes snapshots of the present state. Computes a field only when an output asks for it, once for
/// each state.
class SnapshotSource {
 public:
  SnapshotSource(const Model& model, const Simulation& simulation);
  SnapshotSource(const SnapshotSource&) = delete;
  SnapshotSource& operator=(const SnapshotSource&) = delete;

  /// Returns the present state, valid until the next call or step. Use it in a PluginCall, which
  /// keeps the exceptions of its fields.
  const Snapshot& take();
  /// Returns the state of the latest take().
  const Snapshot& latest() const { return snapshot_; }
  /// Puts a field of the present state, which is that of the latest take(), into `values`.
  void hand_over(std::string_view name, FieldValues& values);

 private:
  bool field(std::string_view name, Field& out);
  bool compute(std::string_view name, FieldValues& values);
  void count_broken(std::vector<double>& numbers, bool open);
  void compute_damage(std::vector<double>& numbers);

  const Model& model_;
  const Simulation& simulation_;
  Snapshot snapshot_;
  std::vector<double> positions_;
  std::map<std::string, FieldValues, std::less<>> fields_;
  /// Springs of each particle at the start; filled when damage is first asked for.
  std::vector<std::uint32_t> springs_of_;
};

}  // namespace hyperlattice
