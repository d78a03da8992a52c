// The threads of a run, started once. Work is divided into ranges of equal size, one per thread. A
// thread that has finished its range continues with items that other threads have not begun, so
// none waits for a thread that the system has paused. Results do not depend on which thread did
// which item.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace hyperlattice {

/// A number that several threads write, padded to a cache line of 64 bytes.
template <class Number>
struct Apart {
  std::atomic<Number> now = 0;
  char rest_of_line[64 - sizeof now] = {};
};

/// A pool of threads; the thread that asks for work is its first member.
class Team {
 public:
  /// Starts all threads except the first, which is the caller. Throws OutsideError if the system
  /// refuses a thread.
  explicit Team(int threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int count() const { return static_cast<int>(threads_); }

  /// Calls work(n) for each n below `size`, which is at most 2^32 - 1. An exception ends its range;
  /// after all work, the one of the lowest n is thrown. Only one thread may call this at a time,
  /// and not from within work.
  template <class Work>
  void for_each(std::size_t size, const Work& work) {
    share(size, true, &call<Work>, &work);
  }
  /// Calls work(n) as for_each() does, but each thread does only its own range: memory that it
  /// touches first is then close to it (NUMA).
  template <class Work>
  void for_own(std::size_t size, const Work& work) {
    share(size, false, &call<Work>, &work);
  }

 private:
  using Call = void (*)(const void* work, std::size_t n);
  template <class Work>
  static void call(const void* work, std::size_t n) {
    (*static_cast<const Work*>(work))(n);
  }

  /// Remaining items of a thread's range: the round in the upper 32 bits, the number of items in
  /// the lower 32. A thread takes the first of them when it decreases the number by one.
  using Range = Apart<std::uint64_t>;

  void share(std::size_t size, bool helping, Call call, const void* work);
  [[gnu::always_inline]] void work(std::size_t thread, std::uint32_t round) noexcept;
  [[gnu::always_inline]] void do_range(std::size_t range, std::uint32_t round) noexcept;
  void fail(std::size_t range, std::uint32_t round, std::size_t n) noexcept;
  void finish(std::uint32_t round, std::size_t count) noexcept;
  void serve(std::size_t thread) noexcept;
  void stop() noexcept;
  void wait_for_change(const std::atomic<std::uint32_t>& number, std::uint32_t from) const noexcept;
  std::size_t end_of(std::size_t range) const { return size_ * (range + 1) / threads_; }

  std::size_t threads_;
  std::unique_ptr<Range[]> ranges_;
  int looks_ = 0;  ///< number of checks of a waiting thread before it sleeps
  std::vector<std::thread> others_;

  // The present work. A thread that has taken an item may read it, since the round does not end
  // before that item is done.
  std::size_t size_ = 0;
  Call call_ = nullptr;
  const void* work_ = nullptr;
  std::mutex failing_;
  std::size_t failed_ = 0;      ///< lowest n whose work threw
  std::exception_ptr failure_;  ///< its exception

  Apart<std::uint32_t> round_;  ///< number of the present round of work
  Apart<std::size_t> open_;     ///< items of the round that are not done
  Apart<std::uint32_t> done_;   ///< latest round of which all items are done
  std::atomic<bool> helping_ = true, stopping_ = false;
};

}  // namespace hyperlattice
