// The equations of damage at rest (damage_at_rest.cpp), solved particle by particle in their order,
// and the factor of the stress at which damage has grown by a given amount.
#pragma once

#include <state/damage_records.hpp>

#include <vector>

namespace hyperlattice {

/// Bounds of a search for damage at rest. Stresses are those of the displacements times a factor.
struct DamageBounds {
  double least_factor = 1, most_factor = 1;
  double most_growth = 1;  ///< of a particle's damage since the last accepted state
};

/// Equations of the particles where damage may grow.
class DamageEquations {
 public:
  struct Equation {
    std::uint32_t record = 0;
    double start = 0;  ///< least damage
    double shape = 1, drive = 0;
    double diagonal = 0;              ///< b^2 times the sum of the weights of its Laplacian
    std::size_t first = 0, last = 0;  ///< its other particles
  };

  /// `damage`: of each record, with a first guess; solve() writes the result there.
  explicit DamageEquations(std::vector<double>& damage) : damage_(damage) {}
  void add(const Equation& equation) {
    all_.push_back(equation);
    all_.back().first = others_.size();
  }
  /// Adds another particle of the last equation, with b^2 times its weight. none: without damage.
  void add_other(std::uint32_t record, double weight) {
    all_.back().diagonal += weight;
    if (record != DamageRecords::none) others_.push_back({record, weight});
    all_.back().last = others_.size();
  }
  bool empty() const { return all_.empty(); }

  /// Solves for drives times `factor`^2, by projected over-relaxation. Returns the largest growth.
  double solve(double factor);
  /// Solves for the largest factor between the bounds at which damage grows by no more than
  /// `most_growth`, or for the least. Returns the factor.
  double solve(const DamageBounds& bounds);

 private:
  struct Other {
    std::uint32_t record;
    double weight;
  };
  std::vector<double>& damage_;  // of each record
  std::vector<Equation> all_;
  std::vector<Other> others_;
};

}  // namespace hyperlattice
