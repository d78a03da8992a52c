#include <analyze/calibration_curve.hpp>
#include <base/gnuplot.hpp>
#include <base/ticks.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hyperlattice {

namespace {

bool is_measured(const Curve& curve) { return curve.points.front().measured.has_value(); }

std::string source(const Curve& curve, const VirtualTest::Options& options) {
  return is_measured(curve) ? fmt::format("measured on {0} x {0} x {0} particles, strain {1:g}",
                                          options.particles, options.strain)
                            : "the infinite lattice";
}

void append_polynomial(std::string& text, std::string_view name,
                       std::span<const double> coefficients) {
  fmt::format_to(std::back_inserter(text), "  {:<10}", name);
  for (const double coefficient : coefficients)
    fmt::format_to(std::back_inserter(text), " {:>14.8g}", coefficient);
  text += '\n';
}

void append_fit(std::string& text, std::string_view title, const Fit& fit,
                std::span<const double> paper) {
  fmt::format_to(std::back_inserter(text), "\n{}, highest power first; largest error {:.2g}\n",
                 title, fit.largest_error);
  append_polynomial(text, "fit", fit.coefficients);
  if (!paper.empty()) append_polynomial(text, "the paper", paper);
}

std::string horner(std::span<const double> coefficients, const char* x) {
  std::string text = "0.0";
  for (const double coefficient : coefficients)
    text = fmt::format("({})*{}+({:.10g})", text, x, coefficient);
  return text;
}

}  // namespace

Json curve_json(const Curve& curve, const VirtualTest::Options& options) {
  Json json = {{"membrane", calibration::membrane_names[static_cast<std::size_t>(curve.membrane)]},
               {"points", Json::array()}};
  for (const CurvePoint& point : curve.points) {
    Json row = {
        {"lambda", point.lambda},
        {"infinite",
         {{"poisson", point.infinite.poisson}, {"modulus_ratio", point.infinite.modulus_ratio}}}};
    if (point.measured) row["measured"] = measured_json(*point.measured, options);
    if (point.affine)
      row["affine"] = {{"poisson", point.affine->poisson},
                       {"modulus_ratio", point.affine->modulus_ratio}};
    json["points"].push_back(row);
  }
  json["fit"] = {
      {"of", is_measured(curve) ? "measured" : "infinite"},
      {"lambda_of_poisson", curve.lambda_of_poisson.coefficients},
      {"lambda_of_poisson_largest_error", curve.lambda_of_poisson.largest_error},
      {"modulus_ratio_of_lambda", curve.modulus_ratio_of_lambda.coefficients},
      {"modulus_ratio_of_lambda_largest_error", curve.modulus_ratio_of_lambda.largest_error}};
  if (curve.has_paper_fit)
    json["paper"] = {{"lambda_of_poisson", calibration::paper_cubic},
                     {"modulus_ratio_of_lambda", calibration::paper_quadratic}};
  return json;
}

std::string curve_text(const Curve& curve, const VirtualTest::Options& options) {
  std::string text = fmt::format(
      "Membrane {}: {}\n", calibration::membrane_names[static_cast<std::size_t>(curve.membrane)],
      source(curve, options));
  fmt::format_to(std::back_inserter(text), "  {:>10} {:>12} {:>12}", "lambda", "nu", "eta");
  text +=
      is_measured(curve) ? fmt::format(" {:>14} {:>14}\n", "nu infinite", "eta infinite") : "\n";
  for (const CurvePoint& point : curve.points) {
    fmt::format_to(std::back_inserter(text), "  {:>10.6g} {:>12.6g} {:>12.6g}", point.lambda,
                   point.pair().poisson, point.pair().modulus_ratio);
    text += point.measured ? fmt::format(" {:>14.6g} {:>14.6g}\n", point.infinite.poisson,
                                         point.infinite.modulus_ratio)
                           : "\n";
  }
  const auto paper = [&](std::span<const double> coefficients) {
    return curve.has_paper_fit ? coefficients : std::span<const double>();
  };
  append_fit(text, "lambda, a cubic of nu", curve.lambda_of_poisson,
             paper(calibration::paper_cubic));
  append_fit(text, "eta, a quadratic of lambda", curve.modulus_ratio_of_lambda,
             paper(calibration::paper_quadratic));
  return text;
}

std::string curve_script(const Curve& curve, const VirtualTest::Options& options) {
  std::string text = "set key right top samplen 2 font ',11'\n$points << EOD\n";
  for (const CurvePoint& point : curve.points)
    fmt::format_to(std::back_inserter(text), "{:.10g} {:.10g} {:.10g} {:.10g} {:.10g}\n",
                   point.lambda, point.pair().poisson, point.pair().modulus_ratio,
                   point.infinite.poisson, point.infinite.modulus_ratio);
  text += "EOD\n";
  const char* dots = is_measured(curve) ? "measured" : "infinite lattice";
  const auto panel = [&](const Fit& fit, std::span<const double> paper, const char* x,
                         const std::string& columns, const std::string& endless) {
    fmt::format_to(std::back_inserter(text),
                   "plot {} with lines lw 2 lc rgb '{}' title 'least squares'",
                   horner(fit.coefficients, x), plot_colours[0]);
    if (curve.has_paper_fit)
      fmt::format_to(std::back_inserter(text),
                     ", {} with lines dt 2 lw 3 lc rgb '{}' title 'Zhao 2017'", horner(paper, x),
                     plot_colours[1]);
    if (is_measured(curve))
      fmt::format_to(std::back_inserter(text),
                     ", $points using {} with lines lw 1 lc rgb '#7f8c8d' title 'infinite lattice'",
                     endless);
    fmt::format_to(std::back_inserter(text),
                   ", $points using {} with points pt 7 ps 0.7 lc rgb '#000000' title '{}'\n",
                   columns, dots);
  };
  fmt::format_to(std::back_inserter(text), "set multiplot layout 1,2 title \"Membrane {}, {}\"\n",
                 calibration::membrane_names[static_cast<std::size_t>(curve.membrane)],
                 source(curve, options));
  const auto axes = [&](const char* x, const char* y, const char* dummy, double from, double to) {
    fmt::format_to(std::back_inserter(text),
                   "set dummy {}\nset xlabel '{}'\nset ylabel '{}'\nset xrange "
                   "[{:.6g}:{:.6g}]\nset xtics {:g}\n",
                   dummy, x, y, std::min(from, to), std::max(from, to),
                   round_step(std::abs(to - from), 5));
  };
  const CurvePoint &first = curve.points.front(), &last = curve.points.back();
  axes("Poisson ratio ν", "λ", "nu", first.pair().poisson, last.pair().poisson);
  panel(curve.lambda_of_poisson, calibration::paper_cubic, "nu", "2:1", "4:1");
  text += "set key left top\n";
  axes("λ", "η = E / E(λ = 0)", "lambda", first.lambda, last.lambda);
  panel(curve.modulus_ratio_of_lambda, calibration::paper_quadratic, "lambda", "1:3", "1:5");
  return text + "unset multiplot\n";
}

}  // namespace hyperlattice
