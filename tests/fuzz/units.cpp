// Quantities with units. The first byte chooses the unit of the option.
#include "target.hpp"

#include <quantities/units.hpp>

#include <array>
#include <cmath>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static constexpr std::array<std::string_view, 12> units{
      "", "m", "s", "Pa", "N", "kg/m3", "m/s", "rad/s", "Hz", "J/m2", "kg m2/s", "1/s"};
  if (size == 0) return 0;
  const std::string_view text = fuzz::text_of(data + 1, size - 1);
  const hyperlattice::Quantity quantity =
      hyperlattice::read_quantity(text, units[data[0] % units.size()]);
  fuzz::require(!quantity.problem.empty() || std::isfinite(quantity.value));
  return 0;
}
