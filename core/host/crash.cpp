#include <base/errors.hpp>
#include <host/crash.hpp>
#include <host/plugin_call.hpp>
#include <process/lack_of_memory.hpp>
#include <process/signal_stack.hpp>

#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string_view>

namespace hyperlattice {
namespace {

struct CrashSignal {
  int number;
  std::string_view text;
  struct sigaction before {};
};
CrashSignal crash_signals[] = {{SIGSEGV, "segmentation fault"},
                               {SIGBUS, "bus error"},
                               {SIGFPE, "arithmetic error"},
                               {SIGILL, "illegal instruction"},
                               {SIGABRT, "abort"}};

const char* loading = nullptr;
std::terminate_handler other_ends = nullptr;
struct sigaction alarm_before;

/// A line for standard error. Uses only write(), since signal handlers may call little more.
class Line {
 public:
  Line& operator<<(std::string_view text) {
    const std::size_t count = std::min(text.size(), sizeof(text_) - 1 - size_);
    std::memcpy(text_ + size_, text.data(), count);
    size_ += count;
    return *this;
  }
  void write() {
    text_[size_++] = '\n';
    [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text_, size_);
  }

 private:
  char text_[8192];
  std::size_t size_ = 0;
};

void write_end_of(const PluginCall& call, std::string_view reason) {
  Line line;
  line << "\nhyperlattice: " << call.name() << " (" << call.library() << ") ended the program in "
       << call.function() << "(): " << reason;
  line.write();
}

void on_crash(int number, siginfo_t* info, void* context) {
  const auto found = std::find_if(std::begin(crash_signals), std::end(crash_signals),
                                  [&](const CrashSignal& s) { return s.number == number; });
  const PluginCall* call = PluginCall::running();
  if (call != nullptr) write_end_of(*call, found->text);
  if ((found->before.sa_flags & SA_SIGINFO) != 0)
    return found->before.sa_sigaction(number, info, context);
  if (call != nullptr) _exit(exit_outside);
  std::signal(number, SIG_DFL);
  std::raise(number);
}

void on_exit_of_plugin() {
  const PluginCall* call = PluginCall::running();
  if (call == nullptr) return;
  write_end_of(*call, "it called exit");
  _exit(exit_outside);
}

/// Handles an exception that nothing catches, for example one from a destructor. For causes other
/// than lack of memory, the abort signal follows.
[[noreturn]] void on_terminate() {
  if (const PluginCall* call = PluginCall::running(); call != nullptr && ends_for_memory()) {
    write_end_of(*call, "not enough memory");
    _exit(exit_outside);
  }
  if (other_ends != nullptr) other_ends();
  std::abort();
}

void on_alarm(int) {
  Line line;
  line << "\nhyperlattice: " << loading
       << " is still loading: a plugin must load within HYPERLATTICE_LOAD_SECONDS (60 by default)";
  line.write();
  _exit(exit_outside);
}

/// Returns the time that a library may take to load, s; 0: no limit.
long most_load_seconds() {
  constexpr long usual = 60, most = 86400;
  const char* wish = std::getenv("HYPERLATTICE_LOAD_SECONDS");
  if (wish == nullptr) return usual;
  char* end = nullptr;
  const long seconds = std::strtol(wish, &end, 10);
  return end == wish || *end != '\0' || seconds < 0 ? usual : std::min(seconds, most);
}

void set_alarm(long seconds) {
  const itimerval timer{{0, 0}, {seconds, 0}};
  setitimer(ITIMER_REAL, &timer, nullptr);
}

}  // namespace

void report_crashes() {
  static const SignalStack stack;  // for the main thread; the threads of a Team have their own
  for (CrashSignal& signal : crash_signals) {
    struct sigaction action {};
    action.sa_sigaction = on_crash;
    action.sa_flags = SA_SIGINFO | SA_ONSTACK | SA_NODEFER;
    sigaction(signal.number, &action, &signal.before);
  }
  other_ends = std::set_terminate(on_terminate);
  std::atexit(on_exit_of_plugin);
  std::at_quick_exit(on_exit_of_plugin);
}

LoadWatch::LoadWatch(const char* library) {
  loading = library;
  struct sigaction action {};
  action.sa_handler = on_alarm;
  sigaction(SIGALRM, &action, &alarm_before);
  sigset_t alarm;
  sigemptyset(&alarm);
  sigaddset(&alarm, SIGALRM);
  sigprocmask(SIG_UNBLOCK, &alarm, nullptr);
  set_alarm(most_load_seconds());
}

LoadWatch::~LoadWatch() {
  set_alarm(0);
  sigaction(SIGALRM, &alarm_before, nullptr);
  loading = nullptr;
}

}  // namespace hyperlattice
