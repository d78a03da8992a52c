// The particles, cells and faces of the regions of a scene, for one body. Each region is computed
// when it is first asked for.
#pragma once

#include <model/skin.hpp>

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace hyperlattice {

class RegionIndex {
 public:
  RegionIndex(const Body& body, const Regions& regions) : body_(body), regions_(regions) {}

  std::span<const Particle> particles(RegionId region);  ///< ascending
  /// Calls visit(particle) for the same particles; on a cubic grid without a list of them.
  void for_particles(RegionId region, const std::function<void(Particle)>& visit);
  /// Returns the indices of the region's cells in the body, ascending. A solid holds a cell if the
  /// centre of the cell is inside.
  std::vector<Particle> cells(RegionId region);
  std::span<const OpenArea> open_areas(RegionId region);
  /// Returns the exact area, m2, of a surface of the shape that the lattice fills; 0 if unknown.
  double true_area(RegionId region) const;
  /// Returns the centre of the region's shape, m; without a shape, the mean position of its
  /// particles.
  Vec3 centre(RegionId region);

  /// Returns a text for a fault about an empty region, with the place of the body: "a region with
  /// particles; "slab", a box ..., holds none ...".
  std::string expected_particles(RegionId region) const;
  /// Returns the same text for a region without cells.
  std::string expected_cells(RegionId region) const;

 private:
  /// Returns the region. Throws PluginMistake if a plugin asks for an id that does not exist.
  const Region& existing(RegionId region) const;
  const Surfaces& surfaces();
  const Skin& skin();
  std::string expected(RegionId region, const char* members, const char* held) const;
  const Region* filled() const;  ///< the shape that the lattice fills, or null

  const Body& body_;
  const Regions& regions_;
  std::unique_ptr<Surfaces> surfaces_;  ///< for bodies on a cubic grid
  std::unique_ptr<Skin> skin_;          ///< for all other bodies
  std::map<std::uint32_t, std::vector<Particle>> particles_;
  std::map<std::uint32_t, std::vector<OpenArea>> open_areas_;
};

}  // namespace hyperlattice
