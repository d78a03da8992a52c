// What the regions of a scene mean for a body: each is worked out once, when first asked for.
#pragma once

#include <model/skin.hpp>

#include <map>
#include <memory>
#include <string>

namespace hyperlattice {

class RegionIndex {
 public:
  RegionIndex(const Body& body, const Regions& regions) : body_(body), regions_(regions) {}

  std::span<const Particle> particles(RegionId region);  ///< ascending
  std::vector<Particle> cells(RegionId region);  ///< places in the body's cells, ascending: a solid
                                                 ///< holds those whose centres are inside
  std::span<const OpenArea> open_areas(RegionId region);
  double true_area(RegionId region)
      const;  ///< m2, of a surface of the shape that the lattice filled; 0 if unknown
  Vec3 centre(RegionId region);  ///< of the shape behind the region; else of its particles

  /// What an empty region is and where the body is, for a fault: "a region with particles; "slab",
  /// a box ..., holds none ...".
  std::string expected_particles(RegionId region) const;
  /// The same of a region that holds no cell.
  std::string expected_cells(RegionId region) const;

 private:
  const Region& existing(RegionId region) const;  ///< the ids that plugins hand over are checked
  const Surfaces& surfaces();
  const Skin& skin();
  std::string expected(RegionId region, const char* members, const char* held) const;
  const Region* filled() const;  ///< the shape that the lattice filled, or null

  const Body& body_;
  const Regions& regions_;
  std::unique_ptr<Surfaces> surfaces_;  ///< of a body on a cubic grid
  std::unique_ptr<Skin> skin_;          ///< of any other
  std::map<std::uint32_t, std::vector<Particle>> particles_;
  std::map<std::uint32_t, std::vector<OpenArea>> open_areas_;
};

}  // namespace hyperlattice
