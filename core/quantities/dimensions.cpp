#include <quantities/dimensions.hpp>
#include <quantities/units.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace hyperlattice {

namespace {

constexpr double round_off = 1e-9;  // of a power, which roots of roots make

template <class Function>
Powers combined(const Powers& a, const Powers& b, Function function) {
  Powers result;
  std::transform(a.begin(), a.end(), b.begin(), result.begin(), function);
  return result;
}

bool is_whole(double power) { return std::abs(power - std::round(power)) < round_off; }

}  // namespace

Powers product(const Powers& a, const Powers& b) { return combined(a, b, std::plus<>()); }
Powers quotient(const Powers& a, const Powers& b) { return combined(a, b, std::minus<>()); }
Powers raised(const Powers& a, double power) {
  return combined(a, a, [&](double one, double) { return one * power; });
}

bool same(const Powers& a, const Powers& b) {
  return std::equal(a.begin(), a.end(), b.begin(),
                    [](double one, double other) { return std::abs(one - other) < round_off; });
}
bool is_plain_number(const Powers& powers) { return same(powers, Powers{}); }

std::string unit_text_of(const Powers& powers) {
  std::string text;
  for (std::size_t n = 0; n < powers.size(); ++n) {
    if (std::abs(powers[n]) < round_off) continue;
    text += fmt::format("{}{}", text.empty() ? "" : " ", base_units[n]);
    if (is_whole(powers[n]) && std::round(powers[n]) == 1) continue;
    text += is_whole(powers[n]) ? fmt::format("{}", std::lround(powers[n]))
                                : fmt::format("{:.4g}", powers[n]);
  }
  return text;
}

std::string dimension_name(const Powers& powers) {
  const std::string unit = unit_text_of(powers);
  if (std::all_of(powers.begin(), powers.end(), is_whole)) return dimension_of(unit).name;
  return fmt::format("a quantity in {}", unit);
}

}  // namespace hyperlattice
