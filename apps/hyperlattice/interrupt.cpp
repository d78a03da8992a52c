// The signal handlers of the commands that run scenes.
#include "commands.hpp"

#include <run/run.hpp>

#include <csignal>

namespace hyperlattice {

void stop_gently_when_interrupted() {
  struct sigaction action {
  }, before{};
  action.sa_handler = [](int) { request_stop(); };
  action.sa_flags = SA_RESTART;
  // no SA_RESETHAND: batch systems may send these signals more than once, and each line written to
  // a closed pipe raises SIGPIPE
  for (const int signal : {SIGPIPE, SIGXCPU, SIGUSR1, SIGUSR2, SIGALRM})
    sigaction(signal, &action, nullptr);
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGQUIT}) sigaction(signal, &action, nullptr);
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN)
    sigaction(SIGHUP, &action, nullptr);  // nohup has set it to ignored
}

}  // namespace hyperlattice
