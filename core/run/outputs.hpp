// Writers and probes of a run: made at the start, shown the body when due, ended in order.
#pragma once

#include <model/region_index.hpp>
#include <run/schedule.hpp>
#include <run/snapshot.hpp>
#include <run/table.hpp>

#include <filesystem>
#include <list>
#include <optional>

namespace hyperlattice {

/// Everything here throws OutsideError when a writer, a probe or the disk refuses.
class Outputs {
 public:
  /// Begins every writer and probe, or goes on with them. `end_time` is the run's, for those that do not say how often.
  Outputs(const Model& model, const Simulation& simulation, const std::filesystem::path& directory, double end_time, Archive* resumed = nullptr);
  void save(Archive& archive);

  void show(double time_step);  ///< to those that are due, at the present state
  void show_now();              ///< to all that have not seen the present state
  void show_last();             ///< to those that want the last state and have not seen it
  void end();                   ///< closes the writers

 private:
  struct Output {
    const Stage* stage = nullptr;
    ComponentPointer component{nullptr, [](void*) {}};
    std::string directory;
    Schedule schedule;
    std::vector<FrameMark> shown;  ///< all that it was shown; of a probe, the latest
    std::optional<Table> table;    ///< of a probe
    std::vector<double> row;
  };
  void begin(Output& output, Archive* resumed);
  static void visit(Archive& archive, Output& output);
  bool has_seen_this(const Output& output) const { return !output.shown.empty() && output.shown.back().step == simulation_.steps(); }
  void show_to(Output& output);

  const Model& model_;
  const Simulation& simulation_;
  SnapshotSource source_;
  std::filesystem::path directory_;
  std::vector<std::string_view> fields_;  ///< that this run has
  std::list<Output> outputs_;
  RegionIndex regions_;
};

}  // namespace hyperlattice
