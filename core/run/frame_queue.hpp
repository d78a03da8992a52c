// The frames that are written beside the steps that follow them: a queue of copies, and one thread
// that writes them in order, with helpers.
#pragma once

#include <plan/estimates.hpp>
#include <run/frame_copy.hpp>

#include <array>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace hyperlattice {

/// All members are for one thread, that of the run. The first error of a frame ends the queue: the
/// frames after it are not written, and each member throws the error.
class FrameQueue {
 public:
  /// Starts the thread and `threads` - 1 helpers. Throws OutsideError or std::system_error if the
  /// system refuses a thread.
  FrameQueue(const Model& model, int threads);
  FrameQueue(const FrameQueue&) = delete;
  FrameQueue& operator=(const FrameQueue&) = delete;
  /// Drops the frames that wait, after the one that is being written.
  ~FrameQueue();

  /// Copies the latest state of the source with these fields, after the wait for a free copy, and
  /// calls `write(copy)` on the queue's thread.
  void put(SnapshotSource& source, const FieldNames& fields,
           std::function<void(const Snapshot&)> write);
  /// Throws the error of a frame, if there was one.
  void check();
  /// Waits until all frames are written.
  void drain();

 private:
  struct Slot {
    std::unique_ptr<FrameCopy> copy;
    std::function<void(const Snapshot&)> write;
  };
  void serve() noexcept;
  void wait_for_at_most(std::size_t waiting);

  Team helpers_;
  std::array<Slot, queued_frames> slots_;  ///< used in turn: one is written while another waits
  std::size_t next_ = 0;                   ///< slot of the next frame
  std::mutex mutex_;                       ///< guards the members below
  std::condition_variable changed_;
  std::size_t waiting_ = 0;  ///< number of frames that are not written
  bool stopping_ = false;
  std::exception_ptr failure_;
  std::thread thread_;
};

}  // namespace hyperlattice
