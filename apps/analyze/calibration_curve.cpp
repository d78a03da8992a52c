#include <analyze/calibration_curve.hpp>
#include <analyze/paper_fit.hpp>

#include <spdlog/fmt/fmt.h>
#include <Eigen/Dense>

namespace hyperlattice {

namespace {

Fit fit(int degree, const std::vector<double>& x, const std::vector<double>& y) {
  const auto rows = static_cast<Eigen::Index>(x.size());
  Eigen::MatrixXd powers = Eigen::MatrixXd::Ones(rows, degree + 1);
  for (Eigen::Index row = 0; row < rows; ++row)
    for (int n = degree - 1; n >= 0; --n)
      powers(row, n) = powers(row, n + 1) * x[static_cast<std::size_t>(row)];
  const Eigen::VectorXd right = Eigen::Map<const Eigen::VectorXd>(y.data(), rows);
  const Eigen::VectorXd best = powers.colPivHouseholderQr().solve(right);
  return {{best.data(), best.data() + best.size()},
          (powers * best - right).lpNorm<Eigen::Infinity>()};
}

}  // namespace

void check_curve(const CurveChoice& choice, const CalibrationChoice& lattice,
                 const LatticeGeometry& geometry) {
  Faults faults;
  const auto written = fmt::format("{} {} {}", choice.from, choice.to, choice.points);
  const auto membrane = membrane_named(lattice.membrane.membrane, faults);
  const MembraneChoice& m = lattice.membrane;
  for (const auto& [option, given] : {std::pair{"--poisson", m.poisson.has_value()},
                                      {"--lambda", m.lambda.has_value()},
                                      {"--k_alpha", m.k_alpha.has_value()},
                                      {"--k_beta", m.k_beta.has_value()},
                                      {"--k_gamma", m.k_gamma.has_value()},
                                      {"--young", lattice.young.has_value()},
                                      {"--spacing", lattice.spacing.has_value()}})
    if (given) faults.add(option, "", "none together with --curve, which is of many lambda");
  if (!(choice.from < choice.to) || !std::isfinite(choice.from) || !std::isfinite(choice.to))
    faults.add("--curve", written, "FROM below TO, both finite");
  if (choice.points < 4 || choice.points > 10000)
    faults.add("--curve", written, "4 to 10000 points");
  if (membrane && !has_lambda(*membrane))
    faults.add("--membrane", m.membrane, "one that has a lambda: I, II, III, IV or I-m");
  else if (membrane && faults.empty() && !is_stable(geometry, *membrane, choice.from))
    faults.add("--curve", written, "FROM " + stable_sentence(geometry, *membrane, choice.from));
  faults.throw_if_any();
}

Curve calibration_curve(const CurveChoice& choice, const CalibrationChoice& lattice,
                        const LatticeGeometry& geometry, VirtualTest* virtual_test) {
  check_curve(choice, lattice, geometry);
  Faults none;
  Curve curve;
  curve.membrane = *membrane_named(lattice.membrane.membrane, none);
  curve.has_paper_fit = paper_fit::instead(geometry, curve.membrane).empty();
  std::vector<double> lambdas, poissons, moduli;
  for (int n = 0; n < choice.points; ++n) {
    CurvePoint point;
    point.lambda = choice.from + (choice.to - choice.from) * n / (choice.points - 1);
    const calibration::Ratios ratios = ratios_of(geometry, curve.membrane, point.lambda);
    point.infinite = elastic_pair(geometry, ratios);
    point.affine = affine_pair(geometry, ratios);
    if (virtual_test != nullptr) point.measured = virtual_test->measure(ratios);
    lambdas.push_back(point.lambda);
    poissons.push_back(point.pair().poisson);
    moduli.push_back(point.pair().modulus_ratio);
    curve.points.push_back(point);
  }
  curve.lambda_of_poisson = fit(3, poissons, lambdas);
  curve.modulus_ratio_of_lambda = fit(2, lambdas, moduli);
  return curve;
}

}  // namespace hyperlattice
