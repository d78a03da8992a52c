// The threads of a run. They are started once and share work by fixed ranges, so that a range belongs to the same thread each time, and results do
// not depend on how many there are.
#pragma once

#include <atomic>
#include <cstddef>
#include <exception>
#include <thread>
#include <vector>

namespace hyperlattice {

class Team {
 public:
  /// Starts all threads but the first, which is the one that asks for work. Throws OutsideError if the system refuses one.
  explicit Team(int threads);
  ~Team();
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  int count() const { return static_cast<int>(failures_.size()); }

  /// Calls work(n) for each n below `size`. An exception ends the range of its thread; the first one, by ranges, is thrown here when all are done.
  /// For work of one thread at a time, not from within such work.
  template <class Work>
  void for_each(std::size_t size, const Work& work) {
    share(
        size,
        [](const void* self, std::size_t first, std::size_t last) {
          for (std::size_t n = first; n < last; ++n) (*static_cast<const Work*>(self))(n);
        },
        &work);
  }

 private:
  using Range = void (*)(const void* work, std::size_t first, std::size_t last);
  void share(std::size_t size, Range range, const void* work);
  void do_range(std::size_t thread) noexcept;
  void serve(std::size_t thread) noexcept;
  void stop() noexcept;
  void wait_for_change(const std::atomic<int>& number, int from) const noexcept;

  std::vector<std::exception_ptr> failures_;  ///< of each thread
  int looks_ = 0;                             ///< how often a waiting thread looks before it sleeps
  std::vector<std::thread> others_;

  // the work that is shared out now
  std::size_t size_ = 0;
  Range range_ = nullptr;  ///< null: the threads end
  const void* work_ = nullptr;
  alignas(64) std::atomic<int> round_ = 0;    ///< of shared work
  alignas(64) std::atomic<int> working_ = 0;  ///< threads that are not done yet
  alignas(64) std::atomic<int> done_ = 0;     ///< the latest round that all were done with
};

}  // namespace hyperlattice
