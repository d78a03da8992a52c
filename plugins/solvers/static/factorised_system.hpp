// A listed lattice whose tangent is factorised: whole if the body is small, else without the entries that the tangent does not have.
#pragma once

#include "listed_system.hpp"

#include <memory>

namespace hyperlattice::statics {

enum class Factorisation : std::uint32_t { automatic, whole, incomplete };

class FactorisedSystem : public ListedSystem {
 public:
  FactorisedSystem(const StaticProblem& problem, Factorisation factorisation);
  ~FactorisedSystem() override;

  void prepare() override;
  void apply(const Field& r, Field& z) override;

 private:
  struct Factors;
  Factorisation factorisation_;
  std::vector<std::size_t> unknowns_;  ///< numbers of a field, by particle and component
  std::unique_ptr<Factors> factors_;
};

}  // namespace hyperlattice::statics
