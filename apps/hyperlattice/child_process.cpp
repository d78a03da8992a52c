#include "child_process.hpp"

#include <base/errors.hpp>

#include <spdlog/fmt/fmt.h>

#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <system_error>

namespace hyperlattice {

namespace {

OutsideError cannot(const char* what) {
  return OutsideError(fmt::format("cannot {}: {}", what, std::generic_category().message(errno)));
}

}  // namespace

StopSignals::StopSignals() {
  sigset_t held;
  sigemptyset(&held);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGCHLD}) sigaddset(&held, signal);
  sigprocmask(SIG_BLOCK, &held, &before_);
  signals_ = Descriptor(::signalfd(-1, &held, SFD_NONBLOCK | SFD_CLOEXEC));
  if (!signals_) throw cannot("wait for signals");
}

StopSignals::~StopSignals() { sigprocmask(SIG_SETMASK, &before_, nullptr); }

bool StopSignals::wait(int descriptor, std::chrono::milliseconds time) {
  std::array<pollfd, 2> sources{{{signals_.number(), POLLIN, 0}, {descriptor, POLLIN, 0}}};
  ::poll(sources.data(), sources.size(), static_cast<int>(time.count()));
  read();
  return (sources[1].revents & POLLIN) != 0;
}

void StopSignals::read() {
  signalfd_siginfo info{};
  while (::read(signals_.number(), &info, sizeof info) == sizeof info)
    if (info.ssi_signo != SIGCHLD) asked_ = is_new_ = true;
}

bool StopSignals::take_request() {
  const bool asked = is_new_;
  is_new_ = false;
  return asked;
}

ChildProcess::ChildProcess(const std::vector<std::string>& words) {
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid();
  process_ = ::fork();
  if (process_ < 0) throw cannot("start a process");
  if (process_ > 0) return;
  // The child: only calls that are safe after fork().
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGINT);
  sigset_t none;
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (::getppid() == parent) ::execv("/proc/self/exe", arguments.data());
  ::_exit(exit_outside);
}

ChildProcess::~ChildProcess() {
  if (has_ended_) return;
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
}

std::optional<ChildProcess::End> ChildProcess::ended() {
  int status = 0;
  if (::waitpid(process_, &status, WNOHANG) != process_) return {};
  has_ended_ = true;
  if (WIFSIGNALED(status)) return End{0, WTERMSIG(status)};
  return End{WEXITSTATUS(status), 0};
}

}  // namespace hyperlattice
