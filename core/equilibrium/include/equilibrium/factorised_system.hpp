// The system of a listed lattice with a factorisation of the tangent as preconditioner: complete
// for small bodies, else incomplete (without fill-in).
#pragma once

#include <equilibrium/listed_system.hpp>

#include <memory>

namespace hyperlattice::equilibrium {

class FactorisedSystem : public ListedSystem {
 public:
  /// `whole`: complete factorisation, else incomplete.
  FactorisedSystem(const StaticProblem& problem, bool whole);
  ~FactorisedSystem() override;

  void prepare() override;
  void apply(const Field& r, Field& z) override;

 private:
  struct Factors;
  std::vector<std::size_t> unknowns_;  ///< indices in a field, by particle and component
  std::unique_ptr<Factors> factors_;
};

}  // namespace hyperlattice::equilibrium
