#include <analyze/calibrate.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <iterator>

namespace hyperlattice {

namespace {

Json pair_json(const ElasticPair& pair) {
  return {{"poisson", pair.poisson}, {"modulus_ratio", pair.modulus_ratio}};
}

void line(std::string& text, std::string_view name, const std::string& value) {
  fmt::format_to(std::back_inserter(text), "  {:<28} {}\n", name, value);
}

std::string pair_text(const ElasticPair& pair) {
  return fmt::format("nu {:.6g}, eta {:.6g}", pair.poisson, pair.modulus_ratio);
}

}  // namespace

Json calibration_json(const Calibration& found) {
  Json json = chosen_json(found.chosen);
  json["poisson"] = found.pair.poisson;
  json["eta"] = found.pair.modulus_ratio;
  json["zener"] = found.zener;
  if (found.young) json["young"] = *found.young;
  if (found.stiffness_per_spacing)
    json["base_stiffness_per_spacing"] = *found.stiffness_per_spacing;
  if (found.base_stiffness) json["base_stiffness"] = *found.base_stiffness;
  json["infinite"] = pair_json(found.infinite);
  return json;
}

std::string calibration_text(const Calibration& found) {
  std::string text = "Parameters\n";
  const calibration::Ratios& r = found.chosen.ratios;
  if (found.chosen.lambda) line(text, "lambda", fmt::format("{:.8g}", *found.chosen.lambda));
  line(text, "k_alpha, k_beta, k_gamma",
       fmt::format("{}, {:.6g}, {:.6g}  (k)",
                   r.clamped ? "infinite" : fmt::format("{:.6g}", r.alpha), r.beta, r.gamma));
  if (found.chosen.volumetric != 0)
    line(text, "volumetric energy K_v", fmt::format("{:.6g}  (k / l)", found.chosen.volumetric));
  line(text, "Poisson ratio", fmt::format("{:.6g}", found.pair.poisson));
  line(text, "modulus ratio eta", fmt::format("{:.6g}", found.pair.modulus_ratio));
  line(text, "Zener ratio A", fmt::format("{:.6g}", found.zener));
  if (found.stiffness_per_spacing)
    line(text, "base stiffness k / l", fmt::format("{:.6g} Pa", *found.stiffness_per_spacing));
  if (found.base_stiffness)
    line(text, "base stiffness k", fmt::format("{:.6g} N/m", *found.base_stiffness));
  line(text, "infinite lattice", pair_text(found.infinite));
  return text;
}

Json measured_json(const VirtualTestResult& measured, const VirtualTest::Options& options) {
  Json json = pair_json(measured);
  json["young_over_k_per_l"] = measured.young;
  json["particles_along_edge"] = options.particles;
  json["particles"] = measured.particles;
  json["strain"] = options.strain;
  json["residual"] = measured.residual;
  json["iterations"] = measured.iterations;
  json["seconds"] = measured.seconds;
  return json;
}

std::string measured_text(const VirtualTestResult& measured, const VirtualTest::Options& options,
                          const ElasticPair& infinite) {
  const auto edge = static_cast<std::uint64_t>(options.particles),
             in_a_cell = measured.particles / (edge * edge * edge);
  std::string text =
      fmt::format("\nMeasured on {0} x {0} x {0} {1}, strain {2:g}\n", edge,
                  in_a_cell > 1 ? fmt::format("cells of {} particles", in_a_cell) : "particles",
                  options.strain);
  line(text, "cube", pair_text(measured));
  line(text, "less the infinite lattice",
       fmt::format("nu {:+.2g}, eta {:+.2g}", measured.poisson - infinite.poisson,
                   measured.modulus_ratio - infinite.modulus_ratio));
  line(text, "forces left",
       fmt::format("{:.1e} of the mean force on a platen's particle, after {} iterations",
                   measured.residual, measured.iterations));
  line(text, "time", fmt::format("{:.2g} s", measured.seconds));
  return text;
}

}  // namespace hyperlattice
