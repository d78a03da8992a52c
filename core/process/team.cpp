#include <base/errors.hpp>
#include <process/processors.hpp>
#include <process/team.hpp>

#include <spdlog/fmt/fmt.h>

#include <system_error>

namespace hyperlattice {

namespace {

void pause() noexcept {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

Team::Team(int threads) : failures_(static_cast<std::size_t>(threads)) {
  // A thread that sleeps takes some 10 us to wake, longer than equal shares of work wait for each other. A thread that looks for long takes the
  // processor from the one that it waits for, as soon as other work shares the machine.
  constexpr int looks = 2000;  // some 20 to 60 us
  looks_ = threads <= processors() ? looks : 0;
  others_.reserve(failures_.size() - 1);
  try {
    while (others_.size() + 1 < failures_.size()) others_.emplace_back([this, thread = others_.size() + 1] { serve(thread); });
  } catch (const std::system_error& error) {
    const std::size_t started = others_.size() + 1;
    stop();
    throw OutsideError(
        fmt::format("the system starts no more than {} of {} threads ({}): limits on memory (ulimit -v, ulimit -s) or processes "
                    "(ulimit -u) may be the cause; `--threads {}` asks for fewer",
                    started, threads, error.code().message(), started));
  } catch (...) {
    stop();
    throw;
  }
}

Team::~Team() { stop(); }

void Team::stop() noexcept {
  range_ = nullptr;
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  for (std::thread& other : others_) other.join();
  others_.clear();
}

void Team::share(std::size_t size, Range range, const void* work) {
  size_ = size;
  range_ = range;
  work_ = work;
  const int round = round_.load(std::memory_order_relaxed);
  working_.store(static_cast<int>(others_.size()), std::memory_order_relaxed);
  round_.store(round + 1, std::memory_order_release);
  round_.notify_all();
  do_range(0);
  if (!others_.empty()) wait_for_change(done_, round);
  std::exception_ptr first;
  for (std::exception_ptr& failure : failures_) {
    if (!first) first = failure;
    failure = nullptr;
  }
  if (first) std::rethrow_exception(first);
}

void Team::do_range(std::size_t thread) noexcept {
  const std::size_t threads = failures_.size();
  try {
    range_(work_, size_ * thread / threads, size_ * (thread + 1) / threads);
  } catch (...) {
    failures_[thread] = std::current_exception();
  }
}

void Team::serve(std::size_t thread) noexcept {
  for (int round = 0;;) {
    wait_for_change(round_, round);
    ++round;
    if (range_ == nullptr) return;
    do_range(thread);
    if (working_.fetch_sub(1, std::memory_order_acq_rel) != 1) continue;
    done_.store(round, std::memory_order_release);
    done_.notify_one();
  }
}

void Team::wait_for_change(const std::atomic<int>& number, int from) const noexcept {
  for (int look = 0; look < looks_; ++look) {
    if (number.load(std::memory_order_acquire) != from) return;
    pause();
  }
  number.wait(from, std::memory_order_acquire);
}

}  // namespace hyperlattice
