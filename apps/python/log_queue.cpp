#include "log_queue.hpp"

#include <spdlog/sinks/base_sink.h>
#include <spdlog/spdlog.h>

#include <cstdio>
#include <memory>

namespace hyperlattice::python {

namespace {

constinit thread_local LogQueue* queue_of_thread = nullptr;

/// Returns the number of Python's `logging` for a level.
int python_level(spdlog::level::level_enum level) {
  constexpr int debug = 10, info = 20, warning = 30, error = 40;
  switch (level) {
    case spdlog::level::info:
      return info;
    case spdlog::level::warn:
      return warning;
    case spdlog::level::err:
    case spdlog::level::critical:
      return error;
    default:
      return debug;
  }
}

class QueueSink final : public spdlog::sinks::base_sink<std::mutex> {
 protected:
  void sink_it_(const spdlog::details::log_msg& message) override {
    std::string text(message.payload.data(), message.payload.size());
    if (queue_of_thread != nullptr)
      queue_of_thread->add({python_level(message.level), std::move(text)});
    else
      std::fprintf(stderr, "hyperlattice: %s\n", text.c_str());
  }
  void flush_() override {}
};

}  // namespace

void LogQueue::add(LogLine line) {
  const std::scoped_lock lock(mutex_);
  lines_.push_back(std::move(line));
}

std::vector<LogLine> LogQueue::take() {
  const std::scoped_lock lock(mutex_);
  return std::exchange(lines_, {});
}

LogScope::LogScope(LogQueue& queue) { queue_of_thread = &queue; }
LogScope::~LogScope() { queue_of_thread = nullptr; }

void catch_log() {
  spdlog::set_default_logger(
      std::make_shared<spdlog::logger>("hyperlattice", std::make_shared<QueueSink>()));
}

}  // namespace hyperlattice::python
