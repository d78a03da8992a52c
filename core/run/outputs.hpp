// The writers and probes of a run: made at the start, called when due, ended in order.
#pragma once

#include <model/acted_particles.hpp>
#include <run/folder.hpp>
#include <run/schedule.hpp>
#include <run/snapshot.hpp>

#include <list>

namespace hyperlattice {

/// All members throw OutsideError when a writer, a probe or the disk refuses.
class Outputs {
 public:
  /// `end_time`, s, is the run's and sets the interval of outputs that have none.
  Outputs(const Model& model, Simulation& simulation, RunFolder& folder, double end_time);
  void archive(Archive& archive);
  /// Makes and begins every writer and probe, or continues them.
  void begin();

  /// Shows the present state to the outputs that are due.
  void show(double time_step);
  /// Shows it to all outputs that have not seen it.
  void show_now();
  /// Shows it to the outputs that want the last state and have not seen it.
  void show_last();
  /// Closes the writers.
  void end();

 private:
  struct Output {
    const Stage* stage = nullptr;
    ComponentPointer component;
    std::string name;       ///< of its folder in the run's; empty: the run's folder itself
    std::string directory;  ///< path of its files' folder
    Schedule schedule;
    std::vector<FrameMark> shown;  ///< all frames so far; of a probe, the latest
    Table* table = nullptr;        ///< of a probe
    std::vector<double> row;
  };
  void begin(Output& output);
  static void offer_forces(OutputContext& context);
  void announce(std::string_view file, bool rewritten);
  bool has_seen_this(const Output& output) const {
    return !output.shown.empty() && output.shown.back().step == simulation_.steps();
  }
  void show_to(Output& output);

  const Model& model_;
  Simulation& simulation_;
  SnapshotSource source_;
  RunFolder& folder_;
  const Output* writing_ = nullptr;       ///< the output that is at work
  std::vector<std::string_view> fields_;  ///< of this run
  std::list<Output> outputs_;
  RegionIndex regions_;
  ActedParticles acted_;
};

}  // namespace hyperlattice
