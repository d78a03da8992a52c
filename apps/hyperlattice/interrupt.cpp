// What the commands that run scenes do when interrupted.
#include "commands.hpp"

#include <run/run.hpp>

#include <csignal>

namespace hyperlattice {

void stop_gently_when_interrupted() {
  struct sigaction action {
  }, before{};
  action.sa_handler = [](int) { request_stop(); };
  action.sa_flags = SA_RESTART;
  // batch systems send some of these more than once, and a closed pipe is met at every line that is
  // written to it
  for (const int signal : {SIGPIPE, SIGXCPU, SIGUSR1, SIGUSR2, SIGALRM})
    sigaction(signal, &action, nullptr);
  action.sa_flags = SA_RESTART | static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM, SIGQUIT}) sigaction(signal, &action, nullptr);
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN)
    sigaction(SIGHUP, &action, nullptr);  // ignored: the program was started with nohup
}

}  // namespace hyperlattice
