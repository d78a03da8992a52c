// A stack for signal handlers. Infinite recursion uses up the thread's own stack, so a handler
// needs another one.
#pragma once

#include <csignal>
#include <cstddef>

namespace hyperlattice {

/// A signal stack, 64 KiB, of the thread that constructs and destroys it; each thread needs its
/// own. If the thread already has a signal stack, for example of a sanitizer, that one stays.
class SignalStack {
 public:
  SignalStack() noexcept {
    stack_t own{}, present{};
    own.ss_sp = bytes_;
    own.ss_size = sizeof bytes_;
    is_installed_ = sigaltstack(nullptr, &present) == 0 && (present.ss_flags & SS_DISABLE) != 0 &&
                    sigaltstack(&own, nullptr) == 0;
  }
  SignalStack(const SignalStack&) = delete;
  SignalStack& operator=(const SignalStack&) = delete;
  ~SignalStack() {
    if (!is_installed_) return;
    stack_t none{};
    none.ss_flags = SS_DISABLE;
    sigaltstack(&none, nullptr);
  }

 private:
  alignas(std::max_align_t) std::byte bytes_[1 << 16];
  bool is_installed_ = false;
};

}  // namespace hyperlattice
