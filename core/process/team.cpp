#include <process/processors.hpp>
#include <process/signal_stack.hpp>
#include <process/team.hpp>
#include <process/thread_trial.hpp>

#include <utility>

namespace hyperlattice {

namespace {

constexpr std::uint64_t left_bits = 0xffffffff;

constexpr std::uint64_t left_of(std::uint32_t round, std::size_t count) {
  return std::uint64_t{round} << 32 | count;
}
constexpr bool is_of(std::uint64_t left, std::uint32_t round) {
  return left >> 32 == round && (left & left_bits) > 0;
}

void pause() noexcept {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#endif
}

}  // namespace

Team::Team(int threads)
    : threads_(static_cast<std::size_t>(threads)), ranges_(std::make_unique<Range[]>(threads_)) {
  // A sleeping thread needs about 10 us to wake, longer than threads with equal work wait for each
  // other. A thread that checks for too long takes processor time from the thread it waits for, as
  // soon as other work shares the machine.
  constexpr int looks = 2000;  // about 20 to 60 us
  looks_ = threads <= processors() ? looks : 0;
  others_.reserve(threads_ - 1);
  try {
    while (others_.size() + 1 < threads_)
      others_.emplace_back([this, thread = others_.size() + 1] { serve(thread); });
  } catch (const std::system_error& error) {
    const std::size_t started = others_.size() + 1;
    stop();
    throw refused_threads(started, threads_, error.code());
  } catch (...) {
    stop();
    throw;
  }
}

Team::~Team() { stop(); }

void Team::stop() noexcept {
  stopping_.store(true, std::memory_order_relaxed);
  round_.now.fetch_add(1, std::memory_order_release);
  round_.now.notify_all();
  for (std::thread& other : others_) other.join();
  others_.clear();
}

/// Does the items left in a range. A thread that comes late finds another round in the range and
/// takes nothing.
inline void Team::do_range(std::size_t range, std::uint32_t round) noexcept {
  std::atomic<std::uint64_t>& left = ranges_[range].now;
  for (std::uint64_t now = left.load(std::memory_order_acquire); is_of(now, round);) {
    if (!left.compare_exchange_weak(now, now - 1, std::memory_order_acq_rel,
                                    std::memory_order_acquire))
      continue;
    const std::size_t n = end_of(range) - (now & left_bits);
    try {
      call_(work_, n);
    } catch (...) {
      fail(range, round, n);
    }
    finish(round, 1);
    now = left.load(std::memory_order_acquire);
  }
}

inline void Team::work(std::size_t thread, std::uint32_t round) noexcept {
  do_range(thread, round);
  if (!helping_.load(std::memory_order_relaxed)) return;
  for (std::size_t n = 1; n < threads_; ++n) do_range((thread + n) % threads_, round);
}

void Team::share(std::size_t size, bool helping, Call call, const void* work_to_do) {
  if (size == 0) return;
  size_ = size;
  call_ = call;
  work_ = work_to_do;
  helping_.store(helping, std::memory_order_relaxed);
  open_.now.store(size, std::memory_order_relaxed);
  const std::uint32_t before = round_.now.load(std::memory_order_relaxed), round = before + 1;
  for (std::size_t range = 0; range < threads_; ++range)
    ranges_[range].now.store(left_of(round, end_of(range) - size_ * range / threads_),
                             std::memory_order_release);
  round_.now.store(round, std::memory_order_release);
  round_.now.notify_all();
  work(0, round);
  while (done_.now.load(std::memory_order_acquire) != round) wait_for_change(done_.now, before);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

/// Keeps the present exception and skips the rest of the range.
void Team::fail(std::size_t range, std::uint32_t round, std::size_t n) noexcept {
  {
    const std::lock_guard lock(failing_);
    if (!failure_ || n < failed_) {
      failed_ = n;
      failure_ = std::current_exception();
    }
  }
  if (const std::uint64_t rest =
          ranges_[range].now.exchange(left_of(round, 0), std::memory_order_acq_rel) & left_bits;
      rest > 0)
    finish(round, rest);
}

void Team::finish(std::uint32_t round, std::size_t count) noexcept {
  if (open_.now.fetch_sub(count, std::memory_order_acq_rel) != count) return;
  done_.now.store(round, std::memory_order_release);
  done_.now.notify_one();
}

void Team::serve(std::size_t thread) noexcept {
  const SignalStack stack;  // for a plugin's law with infinite recursion
  for (std::uint32_t seen = 0;;) {
    wait_for_change(round_.now, seen);
    seen = round_.now.load(std::memory_order_acquire);
    if (stopping_.load(std::memory_order_relaxed)) return;
    work(thread, seen);
  }
}

void Team::wait_for_change(const std::atomic<std::uint32_t>& number,
                           std::uint32_t from) const noexcept {
  for (int look = 0; look < looks_; ++look) {
    if (number.load(std::memory_order_acquire) != from) return;
    pause();
  }
  number.wait(from, std::memory_order_acquire);
}

}  // namespace hyperlattice
