// The threads of a run. They are started once. Work is cut into ranges of equal size, one a thread;
// a thread that is done with its own goes on with what the others have not begun, so that none
// waits for one that the system lets wait. Results do not depend on who did what.
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

/// A number that several threads write, in a line of the caches of its own.
template <class Number>
struct Apart {
  std::atomic<Number> now = 0;
  char rest_of_line[64 - sizeof now] = {};
};

class Team {
 public:
  /// Starts all threads but the first, which is the one that asks for work. Throws OutsideError if
  /// the system refuses one.
  explicit Team(int threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int count() const { return static_cast<int>(threads_); }

  /// Calls work(n) for each n below `size`, at most 2^32 - 1. An exception ends its range; the one
  /// of the least n is thrown here when all are done. For work of one thread at a time, not from
  /// within such work.
  template <class Work>
  void for_each(std::size_t size, const Work& work) {
    share(size, true, &call<Work>, &work);
  }
  /// The same, but each thread does its own range and no other: memory that it is the first to
  /// touch lies near it.
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

  /// What is left of a thread's range: the round in the upper half, how many in the lower. Who
  /// counts it down by one has taken the first of these.
  using Range = Apart<std::uint64_t>;

  void share(std::size_t size, bool helping, Call call, const void* work);
  void work(std::size_t thread, std::uint32_t round) noexcept;
  void do_range(std::size_t range, std::uint32_t round) noexcept;
  void fail(std::size_t range, std::uint32_t round, std::size_t n) noexcept;
  void finish(std::uint32_t round, std::size_t count) noexcept;
  void serve(std::size_t thread) noexcept;
  void stop() noexcept;
  void wait_for_change(const std::atomic<std::uint32_t>& number, std::uint32_t from) const noexcept;
  std::size_t end_of(std::size_t range) const { return size_ * (range + 1) / threads_; }

  std::size_t threads_;
  std::unique_ptr<Range[]> ranges_;
  int looks_ = 0;  ///< how often a waiting thread looks before it sleeps
  std::vector<std::thread> others_;

  // The work that is shared out now. Who has taken a part of it may read this: the round does not
  // end before that part is done.
  std::size_t size_ = 0;
  Call call_ = nullptr;
  const void* work_ = nullptr;
  std::mutex failing_;
  std::size_t failed_ = 0;      ///< the least n whose work threw
  std::exception_ptr failure_;  ///< what it threw

  Apart<std::uint32_t> round_;  ///< of shared work
  Apart<std::size_t> open_;     ///< parts of it that are not done
  Apart<std::uint32_t> done_;   ///< the latest round of which all is done
  std::atomic<bool> helping_ = true, stopping_ = false;
};

}  // namespace hyperlattice
