// A run in a thread of its own. The solver's loop belongs to its plugin, so that the thread waits
// inside it, after a step, while Python looks at the state. This file knows nothing of Python.
#pragma once

#include "log_queue.hpp"
#include "scene_source.hpp"

#include <run/observer.hpp>
#include <run/run.hpp>
#include <run/snapshot.hpp>

#include <atomic>
#include <condition_variable>
#include <deque>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace hyperlattice::python {

/// How far a run is.
struct Reached {
  std::uint64_t steps = 0;
  double time = 0, time_step = 0;   ///< s
  std::uint64_t planned_steps = 0;  ///< 0: not planned yet
};

class Job final : public RunObserver {
 public:
  /// Starts the thread, which plans and runs the scene. `stays`: the run waits before its first
  /// step, and keeps its state after its end.
  Job(SceneSource source, RunOptions options, bool stays);
  /// Ends the run without a checkpoint.
  ~Job() override;
  Job(const Job&) = delete;
  Job& operator=(const Job&) = delete;

  /// Waits for at most so many seconds. Returns whether the run waits or has ended.
  bool wait(double seconds);
  /// Lets a waiting run take `steps` more steps, or fewer up to `time`, s. Returns false if the run
  /// has ended.
  bool go_on(std::uint64_t steps, double time);
  /// Lets the run wait after its present step.
  void pause() noexcept { pauses_ = true; }
  /// Ends the run after its present step, with a checkpoint.
  void stop();
  /// Ends the run after its present step as a failed one, without a checkpoint.
  void give_up();

  bool has_ended() const;
  /// Returns the exit code of the ended run. Throws what the run threw before it left a summary.
  int exit_code() const;
  /// Returns the plan as JSON. Throws std::logic_error while the scene is planned.
  std::string plan_text() const;
  Reached reached() const noexcept;
  std::vector<LogLine> take_log() { return log_.take(); }

  /// Does work(simulation) in the thread of the run, while it waits or after its end, and returns
  /// when it is done. Throws what the work throws, and std::logic_error if the run is going on or
  /// has no state.
  void with_state(const std::function<void(Simulation&)>& work);
  /// Parts of with_state() work, called within it.
  const Model& model() const { return *plan_->model; }
  SnapshotSource& source();
  /// Whether displacements and velocities may be set now.
  bool can_change() const { return can_change_; }

  // RunObserver, called by the thread of the run
  void begin(Simulation& simulation) override;
  void advanced(Simulation& simulation, bool can_change) override;
  bool must_stop() const noexcept override { return stops_; }
  void keep(std::unique_ptr<Simulation> simulation) override;

 private:
  enum class Phase { working, waiting, ended };

  void work();
  void wait_here(Phase phase);
  void note(const Simulation& simulation);
  void end_if_given_up() const;

  const SceneSource scene_;
  RunOptions options_;
  const bool stays_;
  LogQueue log_;

  mutable std::mutex mutex_;
  mutable std::condition_variable changed_;
  Phase phase_ = Phase::working;
  std::deque<std::function<void()>> tasks_;
  bool goes_on_ = false;  ///< the waiting run may continue
  bool closes_ = false;   ///< the thread ends with the run
  std::uint64_t last_step_ = 0;
  double last_time_ = 0;  ///< s
  int exit_code_ = 0;
  std::exception_ptr thrown_;

  std::atomic<bool> pauses_ = false, stops_ = false, gives_up_ = false, planned_ = false;
  std::atomic<std::uint64_t> steps_ = 0, planned_steps_ = 0;
  std::atomic<double> time_ = 0, time_step_ = 0;

  bool can_change_ = false;
  std::unique_ptr<Plan> plan_;
  std::unique_ptr<Simulation> kept_;  ///< after the end
  Simulation* simulation_ = nullptr;  ///< null: no state yet
  std::unique_ptr<SnapshotSource> source_;
  std::thread thread_;
};

}  // namespace hyperlattice::python
