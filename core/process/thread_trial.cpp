#include <process/thread_trial.hpp>

#include <pthread.h>

#include <spdlog/fmt/fmt.h>

#include <cstdlib>
#include <latch>
#include <vector>

namespace hyperlattice {

namespace {

/// Returns the stack size that OMP_STACKSIZE requests, bytes: a number of KiB, or a number followed
/// by B, K, M or G; 0 without a request.
std::size_t openmp_stack() {
  const char* text = std::getenv("OMP_STACKSIZE");
  if (text == nullptr) text = std::getenv("GOMP_STACKSIZE");
  if (text == nullptr) return 0;
  char* unit = nullptr;
  const std::size_t number = std::strtoull(text, &unit, 10);
  while (*unit == ' ') ++unit;
  switch (*unit) {
    case 'b':
    case 'B':
      return number;
    case 'm':
    case 'M':
      return number << 20;
    case 'g':
    case 'G':
      return number << 30;
    default:
      return number << 10;
  }
}

void* wait_for(void* end) {
  static_cast<std::latch*>(end)->wait();
  return nullptr;
}

}  // namespace

OutsideError refused_threads(std::size_t started, std::size_t asked, const std::error_code& why) {
  return OutsideError(
      fmt::format("the system starts no more than {} of {} threads ({}): limits on memory (ulimit "
                  "-v, ulimit -s) or processes "
                  "(ulimit -u) may be the cause; `--threads {}` asks for fewer",
                  started, asked, why.message(), started));
}

void try_openmp_threads(int threads) {
  pthread_attr_t attributes;
  if (pthread_attr_init(&attributes) != 0) throw std::bad_alloc();
  if (const std::size_t stack = openmp_stack(); stack > 0)
    pthread_attr_setstacksize(&attributes,
                              stack);  // a size that is too small is ignored, as OpenMP does
  std::latch end(1);
  const auto asked = static_cast<std::size_t>(threads);
  std::vector<pthread_t> started;
  started.reserve(asked);
  int error = 0;
  while (started.size() + 1 < asked && error == 0) {
    pthread_t thread{};
    error = pthread_create(&thread, &attributes, wait_for, &end);
    if (error == 0) started.push_back(thread);
  }
  end.count_down();
  for (const pthread_t thread : started) pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  if (error != 0)
    throw refused_threads(started.size() + 1, asked, {error, std::generic_category()});
}

}  // namespace hyperlattice
