// A listed lattice whose tangent is factorised: whole if the body is small, else without the
// entries that the tangent does not have.
#pragma once

#include "listed_system.hpp"

#include <memory>

namespace hyperlattice::statics {

class FactorisedSystem : public ListedSystem {
 public:
  FactorisedSystem(const StaticProblem& problem, bool whole);
  ~FactorisedSystem() override;

  void prepare() override;
  void apply(const Field& r, Field& z) override;

 private:
  struct Factors;
  std::vector<std::size_t> unknowns_;  ///< numbers of a field, by particle and component
  std::unique_ptr<Factors> factors_;
};

}  // namespace hyperlattice::statics
