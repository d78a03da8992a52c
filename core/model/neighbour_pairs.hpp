// The pairs of neighbouring particles of a structured body.
#pragma once

#include <model/model.hpp>

namespace hyperlattice {

/// Calls visit(a, b, neighbour) for each pair of particles that stand as a spring of the lattice
/// would join them, also if that spring is cut. `neighbour`: index in SpringTable::neighbours.
template <class Visit>
void for_neighbour_pairs(const Model& model, const Visit& visit) {
  const Body& body = model.body;
  for (const Run& run : body.runs)
    for (std::int32_t i = run.begin; i < run.end; ++i)
      for (std::uint32_t n = 0; n < model.springs.neighbours.size(); ++n) {
        const auto& to = model.springs.neighbours[n].site;
        const Particle b = body.at({i + to.dx, run.j + to.dy, run.k + to.dz});
        if (b != Body::no_particle) visit(run.first + static_cast<Particle>(i - run.begin), b, n);
      }
}

}  // namespace hyperlattice
