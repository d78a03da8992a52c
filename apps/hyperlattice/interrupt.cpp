// What the commands that run scenes do when interrupted.
#include "commands.hpp"

#include <run/run.hpp>

#include <csignal>

namespace hyperlattice {

void stop_gently_when_interrupted() {
  struct sigaction action {};
  action.sa_handler = [](int) { request_stop(); };
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

}  // namespace hyperlattice
