#include <analyze/dispersion.hpp>
#include <model/zone.hpp>
#include <run/table.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>

namespace hyperlattice {

namespace {

constexpr int intervals = 100;

struct Direction {
  const char* name;
  Vec3 along;
};
constexpr Direction directions[] = {{"100", {1, 0, 0}}, {"110", {1, 1, 0}}, {"111", {1, 1, 1}}};

/// Returns half of the shortest reciprocal lattice vector in a direction: beyond it the curves
/// repeat backwards. If there is none, returns the length of the cubic lattice.
Vec3 turning_point(const Basis& basis, Vec3 along) {
  constexpr int farthest = 12;
  const auto is_whole = [](double number) { return std::abs(number - std::round(number)) < 1e-6; };
  for (int times = 1; times <= farthest; ++times)
    if (std::all_of(basis.begin(), basis.end(),
                    [&](Vec3 a) { return is_whole(times * dot(a, along)); }))
      return times * pi * along;
  return pi * along;
}

double frequency(double stiffness, double base_stiffness) {
  constexpr double rounding = 1e-13;
  const double square = stiffness / base_stiffness;
  return std::abs(square) < rounding ? 0 : std::copysign(std::sqrt(std::abs(square)), square);
}

}  // namespace

std::string dispersion_csv(const InfiniteLattice& lattice, double base_stiffness) {
  std::string text = "direction,q_x,q_y,q_z";
  const int modes = lattice.membrane == KernelChoice::Membrane::free ? 4 : 3;
  for (const char* sector : {"mirrored", "opposed"})
    for (int mode = 1; mode <= modes; ++mode) text += fmt::format(",{}_{}", sector, mode);
  text += '\n';
  for (const auto& [name, along] : directions) {
    const Vec3 to = turning_point(lattice.basis, along);
    for (int n = 0; n <= intervals; ++n) {
      const Vec3 q = (static_cast<double>(n) / intervals) * to;
      std::vector<double> row{q.x, q.y, q.z};
      for (const Sector sector : {Sector::mirrored, Sector::opposed})
        for (const Wave& wave : waves(lattice, q, sector))
          row.push_back(frequency(wave.stiffness, base_stiffness));
      text += fmt::format("{},", name);
      append_row(text, row);
    }
  }
  return text;
}

}  // namespace hyperlattice
