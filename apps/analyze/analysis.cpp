#include <analyze/analysis.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <iterator>
#include <limits>

namespace hyperlattice {

namespace {

Json vector_json(Vec3 v) { return {v.x, v.y, v.z}; }

Json wave_json(const Wave& wave) {
  return {{"wave_vector", vector_json(wave.vector)},
          {"mode", {{"direction", vector_json(wave.direction)}, {"height", wave.height}}}};
}

Json instability_json(const char* lattice, const Instability& found) {
  Json json = found.homogeneous
                  ? Json{{"wave_vector", vector_json({})}, {"mode", {{"strain", found.strain}}}}
                  : wave_json(found.wave);
  json["lattice"] = lattice;
  json["because"] = describe(found);
  return json;
}

}  // namespace

Analysis analyse(const SpringLattice& lattice) {
  Analysis analysis;
  analysis.elasticity = elasticity(lattice);
  analysis.listed = lattice.geometry().listed != nullptr;
  if (analysis.listed) {
    analysis.all_positive = facts_of(lattice.geometry()).is_stable(lattice.constants());
    analysis.critical_time_step = std::numeric_limits<double>::quiet_NaN();
    return analysis;
  }
  analysis.mirrored = find_instability(lattice.endless(), Sector::mirrored);
  analysis.opposed = find_instability(lattice.endless(), Sector::opposed);
  analysis.stiffest = stiffest_wave(lattice.endless());
  analysis.critical_time_step =
      2 / std::sqrt(analysis.stiffest.stiffness / lattice.base_stiffness());
  return analysis;
}

Json analysis_json(const Analysis& analysis) {
  const LatticeElasticity& e = analysis.elasticity;
  Json json = {
      {"C1", e.C1},
      {"C2", e.C2},
      {"C3", e.C3},
      {"C4", e.C4},
      {"C11", e.C11},
      {"C12", e.C12},
      {"C44", e.C44},
      {"stiffness", e.stiffness},
      {"young_over_k_per_l", e.young()},
      {"poisson_bulk", e.poisson_bulk()},
      {"poisson_shear", e.poisson_shear()},
      {"zener", e.zener()},
      {"cubic", e.cubic},
      {"isotropic", e.isotropic},
      {"stable",
       {{"mirrored", analysis.mirrored_stable()}, {"two_layer", analysis.two_layer_stable()}}}};
  json["unstable"] = Json::array();
  if (analysis.mirrored)
    json["unstable"].push_back(instability_json("mirrored", *analysis.mirrored));
  if (analysis.opposed)
    json["unstable"].push_back(instability_json("two_layer", *analysis.opposed));
  json["critical_time_step"] = analysis.critical_time_step;
  if (!analysis.listed) json["stiffest_wave"] = wave_json(analysis.stiffest);
  return json;
}

std::string analysis_text(const Analysis& analysis) {
  std::string text;
  const auto line = [&](std::string_view name, const std::string& value) {
    fmt::format_to(std::back_inserter(text), "  {:<28} {}\n", name, value);
  };
  const auto stability = [](bool stable, const std::optional<Instability>& found) {
    return stable ? std::string("stable") : "unstable: " + describe(*found);
  };
  const LatticeElasticity& e = analysis.elasticity;
  text += "Elasticity\n";
  if (!analysis.listed)
    line("C1, C2, C3, C4",
         fmt::format("{:.6g}, {:.6g}, {:.6g}, {:.6g}  (k l^2 / V Delta)", e.C1, e.C2, e.C3, e.C4));
  line("C11, C12, C44", fmt::format("{:.6g}, {:.6g}, {:.6g}  (k / l)", e.C11, e.C12, e.C44));
  line("E along [100]", fmt::format("{:.6g}  (k / l)", e.young()));
  line("nu'", fmt::format("{:.6g}", e.poisson_bulk()));
  line("nu''", fmt::format("{:.6g}", e.poisson_shear()));
  line("Zener ratio A", fmt::format("{:.6g}", e.zener()));
  line("symmetry", e.isotropic ? "isotropic"
                   : e.cubic   ? "cubic, not isotropic"
                               : "not cubic: constants are means over the axes");
  if (analysis.listed) {
    text += analysis.all_positive ? "\nStable: no spring is negative. The critical time step "
                                    "depends on the body: `hyperlattice plan` says it.\n"
                                  : "\nNot known to be stable: some springs are negative.\n";
    return text;
  }
  text += "\nStability over the Brillouin zone\n";
  line("mirrored lattice", stability(analysis.mirrored_stable(), analysis.mirrored));
  line("two-layer lattice", stability(analysis.two_layer_stable(),
                                      analysis.opposed ? analysis.opposed : analysis.mirrored));
  text += "\nTime step\n";
  line("critical time step",
       fmt::format("{:.6g}  (sqrt(m / k)){}", analysis.critical_time_step,
                   analysis.mirrored_stable() ? "" : ", of the waves that do not grow"));
  line("limited by", describe(analysis.stiffest));
  return text;
}

}  // namespace hyperlattice
