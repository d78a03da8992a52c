#include <run/stopwatch.hpp>

namespace hyperlattice {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void Stopwatch::archive(Archive& archive) {
  archive(solve_seconds_);
  archive(output_seconds_);
}

void Stopwatch::start() {
  lap_start_ = Clock::now();
  output_at_lap_start_ = output_seconds_;
}

void Stopwatch::lap() {
  const auto before = lap_start_;
  const double output_before = output_at_lap_start_;
  start();
  solve_seconds_ += std::chrono::duration<double>(lap_start_ - before).count() -
                    (output_at_lap_start_ - output_before);
}

}  // namespace hyperlattice
