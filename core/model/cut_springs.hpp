// Springs that the lattice's cuts take away. A spring exists if no surface crosses the line between
// its ends (geometry/cut_surface.hpp), and if no border of a region separates them.
#pragma once

#include <model/region_index.hpp>
#include <scene/scene.hpp>

#include <functional>
#include <span>
#include <vector>

namespace hyperlattice {

struct Model;

/// The line between two particles.
struct Segment {
  Particle a = 0, b = 0;
};

/// Returns for each segment whether a cut crosses it.
std::vector<bool> crossed(const Body& body, std::span<const Cut> cuts, RegionIndex& regions,
                          std::span<const Segment> segments);

/// Calls visit(n, piece) for each crossing of segment n with a flat piece of the cut, piece by
/// piece.
void for_crossings(const Body& body, const Cut& cut, std::span<const Segment> segments,
                   const std::function<void(std::size_t, const FlatPiece&)>& visit);

/// Takes away the springs that the cuts of the model's lattice cross. The materials and the table
/// of springs must be complete: their constants are those of the whole lattice. Adds a fault for
/// each surface that crosses no spring, and a warning for lists of discs of which some cross none.
void cut_springs(Model& model, RegionIndex& regions, Faults& faults);

}  // namespace hyperlattice
