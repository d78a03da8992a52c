#include <analyze/dispersion.hpp>
#include <model/zone.hpp>
#include <run/table.hpp>

#include <spdlog/fmt/fmt.h>

namespace hyperlattice {

namespace {

constexpr int intervals = 100;

struct Direction {
  const char* name;
  Vec3 to;
};
constexpr Direction directions[] = {{"100", {pi, 0, 0}}, {"110", {pi, pi, 0}}, {"111", {pi, pi, pi}}};

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
  for (const auto& [name, to] : directions)
    for (int n = 0; n <= intervals; ++n) {
      const Vec3 q = (static_cast<double>(n) / intervals) * to;
      std::vector<double> row{q.x, q.y, q.z};
      for (const Sector sector : {Sector::mirrored, Sector::opposed})
        for (const Wave& wave : waves(lattice, q, sector)) row.push_back(frequency(wave.stiffness, base_stiffness));
      text += fmt::format("{},", name);
      append_row(text, row);
    }
  return text;
}

}  // namespace hyperlattice
