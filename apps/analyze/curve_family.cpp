#include <analyze/curve_family.hpp>
#include <base/gnuplot.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <iterator>

namespace hyperlattice {

Json family_json(const CurveFamily& family, const VirtualTest::Options& options) {
  Json json = {{"each", family.option}, {"curves", Json::array()}};
  for (const CurveFamily::Member& member : family.members) {
    Json one = {{"value", member.value}};
    one.update(curve_json(member.curve, options));
    json["curves"].push_back(one);
  }
  return json;
}

std::string family_text(const CurveFamily& family) {
  std::string text;
  for (const auto& [value, curve] : family.members) {
    fmt::format_to(std::back_inserter(text), "{}{} = {}\n  {:>10} {:>12} {:>12} {:>14}\n",
                   text.empty() ? "" : "\n", family.option, value, "lambda", "nu", "eta",
                   "nu affine");
    for (const CurvePoint& point : curve.points)
      fmt::format_to(std::back_inserter(text), "  {:>10.6g} {:>12.6g} {:>12.6g} {:>14}\n",
                     point.lambda, point.infinite.poisson, point.infinite.modulus_ratio,
                     point.affine ? fmt::format("{:.6g}", point.affine->poisson) : "");
  }
  return text;
}

std::string family_script(const CurveFamily& family) {
  std::string text =
                  "set key right top samplen 2 font ',11'\nset "
                  "xlabel 'λ'\nset ylabel 'Poisson ratio ν'\n",
              plots;
  for (std::size_t n = 0; n < family.members.size(); ++n) {
    const auto& [value, curve] = family.members[n];
    const char* colour = plot_colours[n % plot_colours.size()];
    fmt::format_to(std::back_inserter(text), "$curve{} << EOD\n", n);
    for (const CurvePoint& point : curve.points)
      fmt::format_to(std::back_inserter(text), "{:.10g} {:.10g} {:.10g}\n", point.lambda,
                     point.infinite.poisson,
                     point.affine ? point.affine->poisson : point.infinite.poisson);
    text += "EOD\n";
    fmt::format_to(
        std::back_inserter(plots),
        "{}$curve{} using 1:2 with linespoints pt 7 ps 0.7 lw 2 lc rgb '{}' title '{} {}'",
        plots.empty() ? "plot " : ", ", n, colour, family.option, value);
    if (curve.points.front().affine)
      fmt::format_to(
          std::back_inserter(plots),
          ", $curve{} using 1:3 with lines dt 2 lw 2 lc rgb '{}' title '{} {}, strained alike'", n,
          colour, family.option, value);
  }
  return text + plots + ", 0.25 with lines lw 1 lc rgb '#7f8c8d' title '1/4'\n";
}

}  // namespace hyperlattice
