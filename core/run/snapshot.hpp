// The view of a running simulation that writers and probes get.
#pragma once

#include <state/simulation.hpp>

#include <hyperlattice/output.hpp>

#include <exception>
#include <map>
#include <string>

namespace hyperlattice {

/// Makes snapshots of the present state. Computes a field, or the forces of loads, only when an
/// output asks for it, once for each state.
class SnapshotSource {
 public:
  SnapshotSource(const Model& model, Simulation& simulation);
  SnapshotSource(const SnapshotSource&) = delete;
  SnapshotSource& operator=(const SnapshotSource&) = delete;

  /// Forgets what was computed, because the state may have changed.
  void renew();
  /// Returns the present state, valid until the next call of renew() or step. Use it in a
  /// PluginCall, which keeps the exceptions of its fields.
  const Snapshot& take();

 private:
  struct Values {
    std::uint32_t components = 1;
    bool current = false;
    std::vector<double> numbers;
  };
  bool field(std::string_view name, Field& out);
  bool compute(std::string_view name, Values& values);
  Resultant resultant(ForcesId forces, Vec3 about);
  void count_broken(std::vector<double>& numbers, bool open);
  void compute_damage(std::vector<double>& numbers);

  const Model& model_;
  Simulation& simulation_;
  Snapshot snapshot_;
  std::vector<double> positions_;
  std::map<std::string, Values, std::less<>> fields_;
  bool forces_current_ = false;
  /// Springs of each particle at the start; filled when damage is first asked for.
  std::vector<std::uint32_t> springs_of_;
};

}  // namespace hyperlattice
