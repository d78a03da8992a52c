#include <study/rows.hpp>

#include <algorithm>

namespace hyperlattice::study {

double Row::seconds() const {
  if (solve_seconds.empty()) return 0;
  std::vector<double> ordered = solve_seconds;
  std::sort(ordered.begin(), ordered.end());
  const std::size_t half = ordered.size() / 2;
  return ordered.size() % 2 == 1 ? ordered[half] : (ordered[half - 1] + ordered[half]) / 2;
}

void Row::fail(std::string why, int code) {
  status = "failed";
  reason = std::move(why);
  exit_code = code;
}

}  // namespace hyperlattice::study
