// Bodies of cells of several materials. A cell has one material; a particle or spring is the mean
// of its cells, weighted with their shares, so that the body is the sum of its cells. A mixture is
// the list of materials and shares of the cells around a particle. It sets the particle's mass and
// the constants of its springs.
#pragma once

#include <base/paged_numbers.hpp>
#include <model/body.hpp>

#include <array>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

namespace hyperlattice {

/// The materials of a spring, each once.
class SpringMaterials {
 public:
  void add(std::uint8_t material) {
    if (std::find(begin(), end(), material) == end()) materials_[count_++] = material;
  }
  const std::uint8_t* begin() const { return materials_.data(); }
  const std::uint8_t* end() const { return materials_.data() + count_; }

 private:
  std::array<std::uint8_t, 4> materials_{};  // a spring belongs to at most four cells
  std::size_t count_ = 0;
};

class Mixtures {
 public:
  static constexpr std::uint8_t no_cell = 255;
  /// The cells around a particle, x fastest.
  struct Around {
    std::array<std::uint8_t, 8> materials{};  ///< no_cell where there is no cell
    std::array<float, 8> shares{};            ///< 0 where there is no cell
    auto operator<=>(const Around&) const = default;
  };

  Mixtures() = default;
  /// `material_of`: the material of each cell, in the order of the body's runs of cells.
  Mixtures(const Body& body, std::span<const std::uint8_t> material_of, std::size_t materials);

  bool empty() const { return of_particle_.empty(); }
  std::size_t count() const { return around_.size(); }
  /// Returns the mixture of a particle. The first mixtures have one material each, in the order of
  /// the materials.
  std::uint32_t of(Particle particle) const { return of_particle_[particle]; }
  const Around& around(std::uint32_t mixture) const { return around_[mixture]; }
  /// Returns the material of the cell of which a particle with this mixture is the lowest corner.
  std::uint8_t cell_above(std::uint32_t mixture) const {
    return around_[mixture].materials[place(0, 0, 0)];
  }
  /// Returns the material with the largest sum of shares; among equals the one with the smallest
  /// index.
  std::uint8_t commonest(std::uint32_t mixture) const;
  /// Returns the material of a cell of the spring to a neighbour. It has the law of the spring,
  /// unless the spring is composite.
  std::uint8_t material_of_spring(std::uint32_t mixture, const Neighbour& to) const;
  double bytes() const;

  /// Calls visit(material, share) for each existing cell of the spring to a neighbour; with `to` {}
  /// for each existing cell around the particle.
  template <class Visit>
  void for_cells(std::uint32_t mixture, const Neighbour& to, const Visit& visit) const {
    for_cells_of(to, [&](int di, int dj, int dk) {
      const std::size_t n = place(di, dj, dk);
      const Around& around = around_[mixture];
      if (around.materials[n] != no_cell) visit(around.materials[n], double{around.shares[n]});
    });
  }

 private:
  static std::size_t place(int di, int dj, int dk) {
    return 4 * static_cast<std::size_t>(dk + 1) + 2 * static_cast<std::size_t>(dj + 1) +
           static_cast<std::size_t>(di + 1);
  }

  PagedNumbers<std::uint32_t> of_particle_;
  std::vector<Around> around_;
};

}  // namespace hyperlattice
