// The writers and probes of a run: made at the start, called when due, ended in order. Frames of
// writers that name their fields are written beside the steps that follow.
#pragma once

#include <model/acted_particles.hpp>
#include <run/folder.hpp>
#include <run/frame_queue.hpp>
#include <run/schedule.hpp>
#include <run/snapshot.hpp>

#include <list>
#include <mutex>
#include <optional>

namespace hyperlattice {

/// All members throw OutsideError when a writer, a probe or the disk refuses, or refused an earlier
/// frame.
class Outputs {
 public:
  /// With more than one thread of the plan, frames are written by as many threads besides those of
  /// the simulation. Only the first of `ranks` has the components; the others keep its schedule.
  Outputs(const Plan& plan, Simulation& simulation, RunFolder& folder, Ranks& ranks);
  void archive(Archive& archive);
  /// Makes and begins every writer and probe, or continues them.
  void begin();

  /// Shows the present state to the outputs that are due.
  void show(double time_step);
  /// Shows it to all outputs that have not seen it.
  void show_now();
  /// Shows it to the outputs that want the last state and have not seen it.
  void show_last();
  /// Waits until all frames so far are written.
  void drain();
  /// Closes the writers.
  void end();
  /// Returns what writers have told the user since they began.
  std::vector<std::string> warnings() const;

 private:
  struct Output {
    Outputs* owner = nullptr;
    const Stage* stage = nullptr;
    ComponentPointer component;
    std::string name;       ///< of its folder in the run's; empty: the run's folder itself
    std::string directory;  ///< path of its files' folder
    Schedule schedule;
    std::vector<FrameMark> shown;          ///< all frames so far; of a probe, the latest
    FieldNames fields;                     ///< of a writer, as named in begin()
    bool needs_state = true;               ///< see OutputNeeds; known to all ranks
    std::set<Simulation::Motion> motions;  ///< that it shows, if it does not need the state
    bool is_writing = false;               ///< it may announce files
    Table* table = nullptr;                ///< of a probe
    std::vector<double> row;
    bool is_probe() const { return stage->family() == Family::probes; }
  };
  void begin(Output& output);
  static void offer_forces(OutputContext& context);
  OutputContext context_of(Output& output) const;
  void announce(const Output& output, std::string_view file, bool rewritten);
  void warn(const Output& output, std::string_view sentence);
  bool has_seen_this(const Output& output) const {
    return !output.shown.empty() && output.shown.back().step == simulation_.steps();
  }
  void share_needs();
  void bring_state(const std::vector<Output*>& shown);
  void show_to(const std::vector<Output*>& due);
  void show_here(const std::vector<Output*>& due);
  static void sample(Output& probe, const Snapshot& snapshot);
  static void write(Output& writer, const Snapshot& snapshot);

  const Plan& plan_;
  const Model& model_;
  Simulation& simulation_;
  SnapshotSource source_;
  RunFolder& folder_;
  Ranks& ranks_;
  std::vector<std::string_view> fields_;  ///< of this run
  std::vector<CrackFace> cut_faces_;      ///< while outputs begin, if one asks for them
  std::list<Output> outputs_;
  RegionIndex regions_;
  ActedParticles acted_;
  mutable std::mutex warnings_mutex_;  ///< frames may be written on another thread
  std::vector<std::string> warnings_;
  std::optional<FrameQueue> queue_;  ///< none: frames are written at once
};

}  // namespace hyperlattice
