// The opening between two regions of the body: the way by which their mean places move apart, or
// its component along a direction fixed in space. It is what probes.gauge measures.
#pragma once

#include <equilibrium/numerics.hpp>

#include <hyperlattice/statics.hpp>

#include <optional>

namespace hyperlattice::equilibrium {

class Opening {
 public:
  struct Ends {
    RegionId from, to;
    std::optional<Vec3> direction;  ///< of any length; else along the present line between them
  };
  Opening(const StaticProblem& problem, const Ends& ends);

  /// Returns the opening of displacements, m.
  double of(const Field& displacement) const;

 private:
  template <class Value>
  Vec3 mean_apart(const Value& value) const;

  std::int64_t places_;  ///< of a component in a field
  std::span<const std::int64_t> from_, to_;
  std::optional<Vec3> direction_;  ///< of length 1
  Vec3 rest_;                      ///< between the mean places at rest, m
};

}  // namespace hyperlattice::equilibrium
