#include <base/errors.hpp>
#include <process/lack_of_memory.hpp>
#include <process/room.hpp>

#include <unistd.h>

#include <atomic>
#include <cstring>
#include <exception>
#include <new>

namespace hyperlattice {

namespace {

constexpr const char* sentence = "not enough memory";
std::atomic<bool> ran_out = false;
std::terminate_handler other_ends = nullptr;

/// The new-handler: makes the allocation that called it fail with std::bad_alloc.
[[noreturn]] void note() {
  ran_out.store(true, std::memory_order_relaxed);
  throw std::bad_alloc();
}

[[noreturn]] void end() {
  if (ends_for_memory()) {
    constexpr char line[] = "hyperlattice: not enough memory\n";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, line, std::strlen(line));
    ::_exit(exit_outside);
  }
  if (other_ends != nullptr) other_ends();
  std::abort();
}

}  // namespace

void watch_memory() noexcept {
  std::set_new_handler(note);
  other_ends = std::set_terminate(end);
}

bool ends_for_memory() noexcept {
  if (ran_out.load(std::memory_order_relaxed)) return true;
  try {
    if (const std::exception_ptr thrown = std::current_exception()) std::rethrow_exception(thrown);
  } catch (const std::bad_alloc&) {
    return true;
  } catch (...) {
  }
  return false;
}

bool memory_ran_out() noexcept { return ran_out.load(std::memory_order_relaxed); }
void forget_lack_of_memory() noexcept { ran_out.store(false, std::memory_order_relaxed); }

std::string lack_of_memory() {
  try {
    const Room room = memory_room();
    return room.bound.empty() ? sentence : sentence + (": " + room.bound);
  } catch (const std::bad_alloc&) {
    return sentence;
  }
}

}  // namespace hyperlattice
