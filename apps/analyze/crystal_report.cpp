#include <analyze/crystal_report.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace hyperlattice {

namespace {

struct Counts {
  std::ptrdiff_t shown, fit, mirrored, two_layer;
};

bool in_window(const Crystal& c) {
  return c.poisson_bulk() >= 0 && c.poisson_bulk() <= 0.5 && c.poisson_shear() >= -0.5 &&
         c.poisson_shear() <= 0.5;
}

Counts count(const std::vector<FittedCrystal>& all) {
  const auto of = [&](const auto& property) {
    return std::count_if(all.begin(), all.end(), property);
  };
  return {of([](const FittedCrystal& c) { return in_window(c.crystal); }),
          of([](const FittedCrystal& c) { return c.fit.has_value(); }),
          of([](const FittedCrystal& c) { return c.fit && c.fit->mirrored; }),
          of([](const FittedCrystal& c) { return c.fit && c.fit->two_layer; })};
}

Json fit_json(const CrystalFit& fit) {
  constexpr double giga = 1e9;
  return {{"base_stiffness_per_spacing", fit.base_stiffness * giga},
          {"k_alpha", fit.ratios.clamped ? Json("infinite") : Json(fit.ratios.alpha)},
          {"k_beta", fit.ratios.beta},
          {"k_gamma", fit.ratios.gamma},
          {"stable", {{"mirrored", fit.mirrored}, {"two_layer", fit.two_layer}}}};
}

}  // namespace

std::vector<FittedCrystal> fit_all(const std::vector<Crystal>& crystals) {
  std::vector<FittedCrystal> all;
  all.reserve(crystals.size());
  for (const Crystal& crystal : crystals) all.push_back({crystal, fit(crystal)});
  return all;
}

Json crystals_json(const std::vector<FittedCrystal>& crystals) {
  Json list = Json::array();
  for (const auto& [c, found] : crystals)
    list.push_back({{"name", c.name},
                    {"reliability", c.reliability},
                    {"C11_GPa", c.C11},
                    {"C12_GPa", c.C12},
                    {"C44_GPa", c.C44},
                    {"poisson_bulk", c.poisson_bulk()},
                    {"poisson_shear", c.poisson_shear()},
                    {"zener", c.zener()},
                    {"in_display_range", in_window(c)},
                    {"fit", found ? fit_json(*found) : Json()}});
  const Counts counts = count(crystals);
  return {{"crystals", std::move(list)},
          {"crystal_counts",
           {{"all", crystals.size()},
            {"in_display_range", counts.shown},
            {"fit", counts.fit},
            {"stable_mirrored", counts.mirrored},
            {"stable_two_layer", counts.two_layer}}}};
}

std::string crystals_text(const std::vector<FittedCrystal>& crystals) {
  std::size_t width = 7;
  for (const FittedCrystal& c : crystals) width = std::max(width, c.crystal.name.size());
  std::string text =
      fmt::format("{:<{}}  {:>7} {:>7} {:>7}  {:>7} {:>8} {:>6}  {:<9} {:>8} {:>8} {:>8} {:>8}\n",
                  "Crystal", width, "C11", "C12", "C44", "nu'", "nu''", "A", "lattice", "k/l",
                  "k_alpha", "k_beta", "k_gamma");
  for (const auto& [c, found] : crystals) {
    fmt::format_to(std::back_inserter(text),
                   "{:<{}}  {:>7.4g} {:>7.4g} {:>7.4g}  {:>7.4f} {:>8.4f} {:>6.3f}  ", c.name,
                   width, c.C11, c.C12, c.C44, c.poisson_bulk(), c.poisson_shear(), c.zener());
    if (!found) {
      text += "none\n";
      continue;
    }
    const std::string alpha =
        found->ratios.clamped ? "infinite" : fmt::format("{:.4f}", found->ratios.alpha);
    fmt::format_to(std::back_inserter(text), "{:<9} {:>8.4g} {:>8} {:>8.4f} {:>8.4f}\n",
                   found->two_layer  ? "stable"
                   : found->mirrored ? "mirrored"
                                     : "unstable",
                   found->base_stiffness, alpha, found->ratios.beta, found->ratios.gamma);
  }
  const Counts counts = count(crystals);
  text += fmt::format(
      "\nConstants and k/l in GPa; ratios from {} to {}. Of {} crystals, {} are in the window of "
      "figure 4, {} have a lattice, {} a stable one\n"
      "(mirrored layer), {} of these also stable with two layers. Stable lattices need C44 >= "
      "C12.\n",
      least_ratio, most_ratio, crystals.size(), counts.shown, counts.fit, counts.mirrored,
      counts.two_layer);
  return text;
}

}  // namespace hyperlattice
