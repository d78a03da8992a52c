// The map of figure 4. A pair nu', nu'' defines a crystal up to its scale: C11 = 1, C12 = nu' / (1
// - nu'), C44 = (1 - 2 nu'') / (2 - 2 nu''). So each spot of the map is fitted like a crystal: does
// a lattice exist, and a stable one?
#include <analyze/crystal_report.hpp>

#include <spdlog/fmt/fmt.h>

#include <array>
#include <iterator>
#include <memory>

namespace hyperlattice {

namespace {

constexpr std::size_t columns = 100, rows = 200;  // nu' from 0 to 0.5, nu'' from -0.5 to 0.5
constexpr double cell = 0.005;

enum Kind { nothing, any, stable };

Kind kind_of(const std::optional<CrystalFit>& fit) {
  return !fit ? nothing : fit->mirrored ? stable : any;
}

Kind at(double bulk, double shear) {
  Crystal crystal;
  crystal.C11 = 1;
  crystal.C12 = bulk / (1 - bulk);
  crystal.C44 = (1 - 2 * shear) / (2 - 2 * shear);
  return kind_of(fit(crystal));
}

using Map = std::array<std::array<Kind, columns>, rows>;

double bulk_at(double column) { return cell * column; }
double shear_at(double row) { return cell * row - 0.5; }

/// Appends the cells of one kind as bars along nu': x, y, half width, half height.
void append_region(std::string& text, const Map& map, Kind kind) {
  fmt::format_to(std::back_inserter(text), "$region{} << EOD\n", static_cast<int>(kind));
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t begin = 0, end = 0; begin < columns; begin = end) {
      for (end = begin + 1; end < columns && map[row][end] == map[row][begin];) ++end;
      if (map[row][begin] != kind) continue;
      const auto first = static_cast<double>(begin), last = static_cast<double>(end);
      fmt::format_to(std::back_inserter(text), "{:.5g} {:.5g} {:.5g} {:.5g}\n",
                     bulk_at((first + last) / 2), shear_at(static_cast<double>(row) + 0.5),
                     cell * (last - first) / 2, cell / 2);
    }
  text += "0 -9 0 0\nEOD\n";  // gnuplot needs at least one row
}

void append_regions(std::string& text) {
  auto map = std::make_unique<Map>();
  for (std::size_t row = 0; row < rows; ++row)
    for (std::size_t column = 0; column < columns; ++column)
      (*map)[row][column] =
          at(bulk_at(static_cast<double>(column) + 0.5), shear_at(static_cast<double>(row) + 0.5));
  append_region(text, *map, any);
  append_region(text, *map, stable);
}

/// Appends the curve of a membrane from its first stable lambda upwards, evenly in lambda / (lambda
/// + 4).
void append_membrane(std::string& text, calibration::Membrane membrane, double first) {
  constexpr int points = 200;
  const auto name = calibration::membrane_names[static_cast<std::size_t>(membrane)];
  fmt::format_to(std::back_inserter(text), "$membrane{} << EOD\n", static_cast<int>(membrane));
  const double start = first / (first + 4);
  for (int n = 0; n < points; ++n) {
    const double fraction = start + (1 - start) * (n + 0.5) / points;
    const calibration::Elasticity e =
        calibration::elasticity(calibration::ratios(membrane, 4 * fraction / (1 - fraction)));
    fmt::format_to(std::back_inserter(text), "{:.6g} {:.6g}\n", e.poisson(), e.poisson_shear());
  }
  fmt::format_to(std::back_inserter(text), "EOD # {}\n", name);
}

void append_crystals(std::string& text, const std::vector<FittedCrystal>& crystals,
                     bool representable) {
  fmt::format_to(std::back_inserter(text), "$crystals{} << EOD\n9 9\n", representable ? 1 : 0);
  for (const auto& [crystal, found] : crystals)
    if ((kind_of(found) == stable) == representable)
      fmt::format_to(std::back_inserter(text), "{:.6g} {:.6g}\n", crystal.poisson_bulk(),
                     crystal.poisson_shear());
  text += "EOD\n";
}

}  // namespace

std::string crystal_map_script(const std::vector<FittedCrystal>& crystals,
                               const std::optional<MapPoint>& lattice) {
  using calibration::Membrane;
  std::string text =
      "set xrange [0:0.5]\nset yrange [-0.5:0.5]\nset xlabel \"ν′ = C12 / (C11 "
      "+ C12)\" offset 0,0.4\n"
      "set ylabel \"ν″ = (2 C44 − C11) / (2 C44 − 2 C11)\"\nset key below horizontal samplen 2 "
      "width -4 maxrows 3 font ',11'\nset style fill solid 1 "
      "noborder\n";
  append_regions(text);
  struct Curve {
    Membrane membrane;
    double first;
    const char* style;
  };
  constexpr Curve curves[] = {
      {Membrane::I, 0, "lw 2 lc rgb '#1b6ca8'"},
      {Membrane::II, 0, "lw 2 lc rgb '#7a3fa0'"},
      {Membrane::IV, -2,
       "lw 5 lc rgb '#7fc97f'"},  // III and IV are both clamped: C12 = C44, the same curve
      {Membrane::III, -1.5, "lw 2 lc rgb '#b8860b'"},
      {Membrane::I_m, 0, "lw 2 lc rgb '#000000'"}};
  for (const Curve& curve : curves) append_membrane(text, curve.membrane, curve.first);
  append_crystals(text, crystals, false);
  append_crystals(text, crystals, true);
  if (lattice)
    fmt::format_to(std::back_inserter(text), "$lattice << EOD\n{:.6g} {:.6g}\nEOD\n",
                   lattice->poisson_bulk, lattice->poisson_shear);

  text +=
      "plot $region1 using 1:2:3:4 with boxxyerror lc rgb '#dddddd' title 'a lattice, unstable'"
      ", $region2 using 1:2:3:4 with boxxyerror lc rgb '#bfe3c0' title 'a stable lattice'";
  for (const Curve& curve : curves)
    fmt::format_to(std::back_inserter(text), ", $membrane{} using 1:2 with lines {} title '{}'",
                   static_cast<int>(curve.membrane), curve.style,
                   calibration::membrane_names[static_cast<std::size_t>(curve.membrane)]);
  if (!crystals.empty())
    text +=
        ", $crystals0 using 1:2 with points pt 6 ps 0.7 lc rgb '#c0392b' title 'crystals'"
        ", $crystals1 using 1:2 with points pt 7 ps 0.7 lc rgb '#145a32' title 'crystals, stable "
        "lattice'";
  if (lattice)
    text +=
        ", $lattice using 1:2 with points pt 3 ps 1.6 lw 2 lc rgb '#e67e22' title 'the lattice "
        "analysed'";
  return text + "\n";
}

}  // namespace hyperlattice
