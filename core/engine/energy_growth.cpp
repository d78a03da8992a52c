#include <engine/energy_growth.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hyperlattice {

bool EnergyGrowth::runs_away(const EnergyBalance& balance, std::span<const double> work,
                             double step_ratio, double limit) {
  constexpr double growth = 1.5;  // from one record to the next; real energies end such a row soon
  constexpr std::uint64_t enough = 3;  // records in a row
  constexpr double at_once = 1e3;      // times the bound: no need to wait
  constexpr double least_gap = 0.01;   // of 1 - r^2: steps next to the critical one
  const double start =
      balance.kinetic + balance.stored + balance.dissipated() - balance.injected - balance.error;
  double put_in = std::max(0.0, start) + std::max(0.0, -balance.stored);
  for (const double one : work) put_in += std::max(0.0, one);
  put_in_ = std::max(put_in_, put_in);
  const double energy = std::max(std::abs(balance.kinetic), balance.stored);
  const double before = std::exchange(ratio_, put_in_ > 0 ? energy / put_in_ : 0);
  grown_ = ratio_ > growth * before ? grown_ + 1 : 0;
  const double bound = limit / std::max(least_gap, 1 - step_ratio * step_ratio);
  return limit > 0 && (ratio_ > at_once * bound || (ratio_ > bound && grown_ >= enough));
}

}  // namespace hyperlattice
