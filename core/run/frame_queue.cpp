#include <process/signal_stack.hpp>
#include <run/frame_queue.hpp>

namespace hyperlattice {

FrameQueue::FrameQueue(const Model& model, int threads) : helpers_(threads) {
  for (Slot& slot : slots_) slot.copy = std::make_unique<FrameCopy>(model, helpers_);
  thread_ = std::thread([this] { serve(); });
}

FrameQueue::~FrameQueue() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

void FrameQueue::put(SnapshotSource& source, const FieldNames& fields,
                     std::function<void(const Snapshot&)> write) {
  wait_for_at_most(queued_frames - 1);
  Slot& slot = slots_[next_];  // free, for the slots are used in turn
  slot.copy->take(source, fields);
  slot.write = std::move(write);
  next_ = (next_ + 1) % queued_frames;
  {
    const std::lock_guard lock(mutex_);
    ++waiting_;
  }
  changed_.notify_all();
}

void FrameQueue::check() {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(failure_);
}

void FrameQueue::drain() { wait_for_at_most(0); }

void FrameQueue::wait_for_at_most(std::size_t waiting) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return failure_ || waiting_ <= waiting; });
  if (failure_) std::rethrow_exception(failure_);
}

void FrameQueue::serve() noexcept {
  const SignalStack stack;  // for a writer with infinite recursion
  std::unique_lock lock(mutex_);
  for (std::size_t n = 0;; n = (n + 1) % queued_frames) {
    changed_.wait(lock, [this] { return stopping_ || waiting_ > 0; });
    if (stopping_) return;
    const Slot& slot = slots_[n];
    lock.unlock();
    std::exception_ptr failure;
    try {
      slot.write(slot.copy->snapshot());
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    failure_ = failure;
    --waiting_;
    changed_.notify_all();
    if (failure_) return;
  }
}

}  // namespace hyperlattice
