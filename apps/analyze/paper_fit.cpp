#include <analyze/paper_fit.hpp>

#include <hyperlattice/elastic_solid.hpp>

#include <spdlog/fmt/fmt.h>

namespace hyperlattice::paper_fit {

namespace {

using namespace calibration;

constexpr const char* why = "where the paper's polynomials were fitted";
const double most_lambda = paper_lambda(paper_poisson_low);

/// Returns whether this is the lattice of the paper.
bool is_the_papers(const LatticeGeometry& geometry) {
  std::vector<Neighbour> sites;
  for (const NeighbourGeometry& neighbour : geometry.neighbours) sites.push_back(neighbour.site);
  LatticeFacts facts = facts_of(geometry);
  facts.neighbours = sites;
  return elastic_solid::is_cubic_of_18(facts);
}

}  // namespace

std::string instead(const LatticeGeometry& geometry, Membrane membrane) {
  if (membrane == Membrane::I_m && is_the_papers(geometry)) return "";
  return "closed_form: the paper's polynomials are of the simple cubic lattice with membrane I-m";
}

std::string range_of_poisson(double poisson) {
  if (poisson >= paper_poisson_low && poisson <= paper_poisson_high) return "";
  return fmt::format("{} to {}, {}", paper_poisson_low, paper_poisson_high, why);
}

std::string range_of_lambda(double lambda) {
  if (lambda >= 0 && lambda <= most_lambda) return "";
  return fmt::format("0 to {:.4g}, {}", most_lambda, why);
}

double poisson(double lambda) {  // equation (11) decreases monotonically
  double low = paper_poisson_low, high = 0.25;
  for (int n = 0; n < 60; ++n) {
    const double middle = (low + high) / 2;
    (paper_lambda(middle) > lambda ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace hyperlattice::paper_fit
