// Writers and probes of a run: made at the start, shown the body when due, ended in order.
#pragma once

#include <model/region_index.hpp>
#include <run/folder.hpp>
#include <run/schedule.hpp>
#include <run/snapshot.hpp>

#include <list>

namespace hyperlattice {

/// Everything here throws OutsideError when a writer, a probe or the disk refuses.
class Outputs {
 public:
  /// Begins every writer and probe, or goes on with them. `end_time` is the run's, for those that
  /// do not say how often.
  Outputs(const Model& model, const Simulation& simulation, RunFolder& folder, double end_time,
          Archive* resumed = nullptr);
  void save(Archive& archive);

  void show(double time_step);  ///< to those that are due, at the present state
  void show_now();              ///< to all that have not seen the present state
  void show_last();             ///< to those that want the last state and have not seen it
  void end();                   ///< closes the writers

 private:
  struct Output {
    const Stage* stage = nullptr;
    ComponentPointer component;
    std::string name;       ///< of its folder in the run's; empty: the run's itself
    std::string directory;  ///< of its files
    Schedule schedule;
    std::vector<FrameMark> shown;  ///< all that it was shown; of a probe, the latest
    Table* table = nullptr;        ///< of a probe
    std::vector<double> row;
  };
  void begin(Output& output);
  void announce(std::string_view file, bool rewritten);
  static void visit(Archive& archive, Output& output);
  bool has_seen_this(const Output& output) const {
    return !output.shown.empty() && output.shown.back().step == simulation_.steps();
  }
  void show_to(Output& output);

  const Model& model_;
  const Simulation& simulation_;
  SnapshotSource source_;
  RunFolder& folder_;
  const Output* writing_ = nullptr;       ///< the one that is at work
  std::vector<std::string_view> fields_;  ///< that this run has
  std::list<Output> outputs_;
  RegionIndex regions_;
};

}  // namespace hyperlattice
