#include "job.hpp"

#include <base/errors.hpp>
#include <scene/json.hpp>

#include <nlohmann/json.hpp>

#include <limits>
#include <stdexcept>

namespace hyperlattice::python {

Job::Job(SceneSource source, RunOptions options, bool stays)
    : scene_(std::move(source)), options_(std::move(options)), stays_(stays) {
  options_.observer = this;
  options_.quiet = true;  // Python shows the progress
  thread_ = std::thread([this] { work(); });
}

Job::~Job() {
  {
    const std::scoped_lock lock(mutex_);
    gives_up_ = closes_ = true;
    changed_.notify_all();
  }
  thread_.join();
}

void Job::work() {
  const LogScope scope(log_);
  const FunctionScope functions(scene_.functions.get());
  try {
    plan_ = plan_of(scene_);
    planned_steps_ = plan_->steps();
    planned_ = true;
    if (scene_.functions) *scene_.functions->are_called = true;
    exit_code_ = run(*plan_, options_);
  } catch (...) {
    thrown_ = std::current_exception();
  }
  wait_here(Phase::ended);
}

/// Does tasks until the run may continue; after its end, until the job is destroyed.
void Job::wait_here(Phase phase) {
  std::unique_lock lock(mutex_);
  phase_ = phase;
  goes_on_ = false;
  changed_.notify_all();
  for (;;) {
    const bool is_over = phase == Phase::ended ? closes_ : goes_on_ || gives_up_ || stops_;
    if (!tasks_.empty()) {
      const auto task = std::move(tasks_.front());
      tasks_.pop_front();
      lock.unlock();
      task();
      lock.lock();
    } else if (is_over) {
      break;
    } else {
      changed_.wait(lock);
    }
  }
  if (phase == Phase::waiting) phase_ = Phase::working;
}

bool Job::wait(double seconds) {
  std::unique_lock lock(mutex_);
  return changed_.wait_for(lock, std::chrono::duration<double>(seconds),
                           [this] { return phase_ != Phase::working; });
}

bool Job::go_on(std::uint64_t steps, double time) {
  const std::scoped_lock lock(mutex_);
  if (phase_ == Phase::ended) return false;
  if (phase_ == Phase::working) throw std::logic_error("the simulation is taking steps");
  const std::uint64_t now = steps_;
  last_step_ = steps > std::numeric_limits<std::uint64_t>::max() - now
                   ? std::numeric_limits<std::uint64_t>::max()
                   : now + steps;
  last_time_ = time;
  pauses_ = false;
  goes_on_ = true;
  phase_ = Phase::working;
  changed_.notify_all();
  return true;
}

void Job::stop() {
  const std::scoped_lock lock(mutex_);
  stops_ = true;
  if (phase_ == Phase::waiting) phase_ = Phase::working;
  changed_.notify_all();
}

void Job::give_up() {
  const std::scoped_lock lock(mutex_);
  gives_up_ = true;
  if (phase_ == Phase::waiting) phase_ = Phase::working;
  changed_.notify_all();
}

bool Job::has_ended() const {
  const std::scoped_lock lock(mutex_);
  return phase_ == Phase::ended;
}

int Job::exit_code() const {
  if (!has_ended()) throw std::logic_error("the run has not ended");
  if (thrown_) std::rethrow_exception(thrown_);
  return exit_code_;
}

std::string Job::plan_text() const {
  if (!planned_) throw std::logic_error("the scene is not planned yet");
  return json_text(plan_json(*plan_));
}

Reached Job::reached() const noexcept { return {steps_, time_, time_step_, planned_steps_}; }

void Job::with_state(const std::function<void(Simulation&)>& work) {
  std::exception_ptr thrown;
  bool is_done = false;
  std::unique_lock lock(mutex_);
  if (phase_ == Phase::working || goes_on_)
    throw std::logic_error("the simulation is taking steps");
  tasks_.emplace_back([&] {
    try {
      if (simulation_ == nullptr) throw std::logic_error("the simulation has no state");
      work(*simulation_);
    } catch (...) {
      thrown = std::current_exception();
    }
    const std::scoped_lock done(mutex_);
    is_done = true;
    changed_.notify_all();
  });
  changed_.notify_all();
  changed_.wait(lock, [&] { return is_done; });
  if (thrown) std::rethrow_exception(thrown);
}

SnapshotSource& Job::source() {
  if (!source_) source_ = std::make_unique<SnapshotSource>(*plan_->model, *simulation_);
  return *source_;
}

void Job::note(const Simulation& simulation) {
  steps_ = simulation.steps();
  time_ = simulation.time();
  time_step_ = simulation.last_step();
}

void Job::end_if_given_up() const {
  if (gives_up_) throw RunError("given up by the program that runs it");
}

void Job::begin(Simulation& simulation) {
  simulation_ = &simulation;
  can_change_ = true;
  note(simulation);
  if (stays_) wait_here(Phase::waiting);
  end_if_given_up();
}

void Job::advanced(Simulation& simulation, bool can_change) {
  note(simulation);
  end_if_given_up();
  if (!stays_) return;
  can_change_ = can_change;
  if (!stops_ && (pauses_ || steps_ >= last_step_ || time_ >= last_time_)) {
    if (source_) source_->renew();
    wait_here(Phase::waiting);
    end_if_given_up();
  }
}

void Job::keep(std::unique_ptr<Simulation> simulation) {
  if (!stays_) {
    simulation_ = nullptr;
    return;
  }
  if (source_) source_->renew();
  can_change_ = false;
  kept_ = std::move(simulation);
  simulation_ = kept_.get();
}

}  // namespace hyperlattice::python
