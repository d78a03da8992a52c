#include <base/errors.hpp>
#include <run/recorder.hpp>

#include <spdlog/spdlog.h>

#include <algorithm>

namespace hyperlattice {

Recorder::Recorder(const Plan& plan, Simulation& simulation, RunFolder& folder,
                   Stopwatch& stopwatch, Ranks& ranks)
    : simulation_(simulation),
      stopwatch_(stopwatch),
      guard_(*plan.model, simulation),
      cells_(*plan.model),
      history_(folder, *plan.model),
      outputs_(plan, simulation, folder, ranks),
      planned_steps_(plan.steps()),
      first_step_(plan.first_step()) {
  if (plan.model->springs.breakable || plan.model->springs.softens) failures_.emplace(folder);
}

void Recorder::archive(Archive& archive) {
  archive(schedule_);
  archive(time_step_);
  history_.archive(archive);
  archive(rest_);
  guard_.archive(archive);
  std::string lines;  // a warning is one line
  for (const std::string& warning : warnings_) lines += warning + '\n';
  std::vector<char> letters(lines.begin(), lines.end());
  archive(letters);
  if (archive.restores()) {
    warnings_.clear();
    for (auto from = letters.begin(), to = from;
         (to = std::find(from, letters.end(), '\n')) != letters.end(); from = to + 1)
      warnings_.emplace_back(from, to);
  }
  archive(cells_.seen());
  stopwatch_.archive(archive);
  if (failures_) failures_->archive(archive);
  outputs_.archive(archive);
  if (archive.restores()) observed_ = simulation_.steps();
}

void Recorder::begin(bool quiet) {
  history_.begin();
  if (failures_) failures_->begin();
  outputs_.begin();
  progress_ = std::make_unique<Progress>(planned_steps_, quiet);
}

void Recorder::start_stage(const PlannedStage& stage, bool is_resumed) {
  stage_ = &stage;
  guard_.start(stage, is_resumed);
  if (is_resumed) return;
  schedule_ = Schedule(stage.start_time, record_interval(stage), true);
  time_step_ = stage.plan.time_step;
}

/// Makes a check. If it fails, outputs see the state that shows where the run goes wrong.
template <class Check>
void Recorder::guarded(const Check& check) {
  try {
    check();
  } catch (const RunError&) {
    double speed = 0;
    bool finite = true;
    simulation_.fastest(speed, finite);
    if (finite) stopwatch_.output([&] { outputs_.show_now(); });
    throw;
  }
}

void Recorder::take_step(double time_step) {
  time_step_ = time_step;
  if (simulation_.steps() % guard_every == 0) guarded([&] { guard_.check_motion(time_step); });
}

void Recorder::observe() {
  observed_ = simulation_.steps();
  const bool at_rest = stage_->plan.at_rest;
  if (at_rest ? simulation_.steps() % record_steps(*stage_) == 0
              : schedule_.due(simulation_.time(), time_step_))
    record();
  // In a static stage times are rarely round numbers: the times of outputs have a tolerance.
  const double near_enough = 1e-6 * (stage_->plan.end_time - stage_->start_time);
  stopwatch_.output([&] { outputs_.show(at_rest ? near_enough : time_step_); });
  progress_->update(simulation_.steps() - first_step_, simulation_.time(), time_step_,
                    simulation_.broken(), at_rest && rest_ ? rest_->residual : -1);
}

void Recorder::observe_once() {
  if (observed_ != simulation_.steps()) observe();
}

void Recorder::record() {
  if (history_.has(simulation_.steps())) return;
  const std::uint64_t open = simulation_.broken_open();
  const Record record{simulation_.time(),          simulation_.steps(),
                      simulation_.balance(),       open,
                      simulation_.broken() - open, simulation_.crack_surface()};
  guarded([&] {
    if (record.step > 0) guard_.check_motion(time_step_);
    guard_.check_finite(record.balance, time_step_);
    if (!stage_->plan.at_rest) guard_.check_approach(time_step_);
  });
  history_.take(record);
  if (cells_.is_due(record.step)) look_at_cells();
  stopwatch_.output([&] {
    history_.write(simulation_.work_of_loads());
    if (failures_) failures_->write_new(simulation_.breakages());
  });
  if (stage_->plan.at_rest) return;
  guarded([&] {
    guard_.check_balance(record.balance, time_step_);
    guard_.check_growth(record.balance, simulation_.work_of_loads(), time_step_);
    guard_.check_momentum(record.balance, time_step_);
  });
  for (std::string early : {guard_.step_warning(record.balance, time_step_),
                            guard_.early_warning(record.balance, time_step_)}) {
    if (early.empty()) continue;
    spdlog::warn("warning: {}", early);
    warnings_.push_back(std::move(early));
  }
}

bool Recorder::is_sound() const {
  try {
    guard_.check_motion(time_step_);
    if (!stage_->plan.at_rest) guard_.check_approach(time_step_);
    return true;
  } catch (const RunError&) {
    return false;
  }
}

void Recorder::look_at_cells() {
  stopwatch_.output([&] {
    if (cells_.look(simulation_)) spdlog::warn("{}", cells_.sentence());
  });
}

void Recorder::end_stage() {
  record();
  if (!stage_->plan.at_rest) return;
  look_at_cells();
  stopwatch_.output([&] { outputs_.show_now(); });
}

void Recorder::drain() {
  stopwatch_.output([&] { outputs_.drain(); });
}

void Recorder::finish() {
  progress_.reset();
  look_at_cells();
  stopwatch_.output([&] {
    outputs_.show_last();
    outputs_.end();
  });
}

void Recorder::note(Outcome& outcome) {
  outcome.last = history_.last();
  outcome.largest_relative_error = history_.largest_relative_error();
  outcome.rest = rest_;
  if (outcome.exit_code == exit_run) {
    // Compressed cells, as they were before the failure, or folded cells may be the reason.
    if (std::string sentence = cells_.stiffened();
        !sentence.empty() && stage_ != nullptr && !stage_->plan.at_rest) {
      spdlog::warn("{}", sentence);
      outcome.warnings.push_back(std::move(sentence));
    }
    look_at_cells();
  }
  if (std::string sentence = cells_.sentence(); !sentence.empty())
    outcome.warnings.push_back(std::move(sentence));
  outcome.warnings.insert(outcome.warnings.end(), warnings_.begin(), warnings_.end());
  for (std::string& warning : outputs_.warnings()) outcome.warnings.push_back(std::move(warning));
}

}  // namespace hyperlattice
