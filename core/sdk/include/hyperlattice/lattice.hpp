// A lattice: the positions of the particles and the springs between them. A structured lattice is a
// box of sites with runs of particles along x and one list of neighbours that all sites share; it
// does not list springs. A listed lattice names every particle and every spring.
#pragma once

#include <hyperlattice/component.hpp>
#include <hyperlattice/sites.hpp>

namespace hyperlattice {

/// A structured lattice without its particles. Site (i, j, k) is at origin + spacing * (i a1 + j a2
/// + k a3).
struct Grid {
  Vec3 origin;
  double spacing = 0;                     ///< lattice constant l, metres
  Basis basis = cubic_basis;              ///< a1, a2, a3
  std::array<std::int32_t, 3> sites{};    ///< size of the box in sites
  double site_volume = 0;                 ///< volume of one whole particle, m3
  double membrane_distance = 0;           ///< Delta: distance to the mirror copy, m
  std::span<const Neighbour> neighbours;  ///< forward neighbours
  std::uint32_t spring_classes = 1;
  /// Stiffness of each class's base springs over k; the ratios make the lattice isotropic.
  std::array<double, max_spring_classes> class_stiffness{1, 1, 1, 1};
  Boundary boundary = Boundary::particles;  ///< cells of any kind need the cubic basis
  const Shape* shape = nullptr;  ///< the filled solid, as received in the options; null: none
};

/// A base spring between two particles of a list.
struct ListedSpring {
  std::uint32_t a = 0, b = 0;
  double stiffness = 1;  ///< stiffness over k, of the base spring and its cross springs
};

/// A listed lattice: particles at any positions, and named springs.
struct PointList {
  double spacing = 0;            ///< l: a typical distance of neighbours, metres
  double site_volume = 0;        ///< volume of one whole particle, m3
  double membrane_distance = 0;  ///< Delta, metres
  std::span<const Vec3> positions;
  std::span<const double> volumes;  ///< volume of each particle, m3; empty: all particles are whole
  std::span<const ListedSpring> springs;
  const Shape* shape = nullptr;  ///< the filled solid, as received in the options; null: none
};

/// A spring of a periodic sample, from particle a to particle b or to a periodic image of b.
struct SampleSpring {
  std::uint32_t a = 0, b = 0;
  Vec3 rest;             ///< rest vector from a to b, m
  double stiffness = 1;  ///< stiffness over k
};

/// A periodic sample of the same material structure as the list, from which the core finds the
/// elastic constants of the lattice.
struct PeriodicSample {
  std::uint32_t particles = 0;
  double volume = 0;  ///< m3
  std::span<const SampleSpring> springs;
};

/// Receives a lattice. A structured lattice sends the grid once, then the runs of particles (with
/// boundary cells: of cells; with partial cells: of cells and their shares) in the order z, y, x. A
/// listed lattice sends its points once, and a sample if it has one.
struct LatticeSink {
  void* self = nullptr;
  /// Only the elastic constants are needed: send the neighbours, or the sample, and the smallest
  /// possible body.
  bool for_analysis = false;
  void (*receive_grid)(void* self, const Grid& grid) noexcept = nullptr;
  void (*receive_run)(void* self, std::int32_t j, std::int32_t k, std::int32_t begin,
                      std::int32_t end) noexcept = nullptr;
  void (*receive_points)(void* self, const PointList& points) noexcept = nullptr;
  void (*receive_sample)(void* self, const PeriodicSample& sample) noexcept = nullptr;
  void (*receive_partial_run)(void* self, std::int32_t j, std::int32_t k, std::int32_t begin,
                              std::span<const double> shares) noexcept = nullptr;

  void grid(const Grid& g) const { receive_grid(self, g); }
  void points(const PointList& list) const { receive_points(self, list); }
  void sample(const PeriodicSample& piece) const { receive_sample(self, piece); }
  /// Adds particles at sites begin <= i < end of row (j, k); with boundary cells, the cells whose
  /// low corners are these sites.
  void run(std::int32_t j, std::int32_t k, std::int32_t begin, std::int32_t end) const {
    receive_run(self, j, k, begin, end);
  }
  /// Adds the cells whose low corners are the sites from `begin` on of row (j, k), one for each
  /// share. A share, above 0 and at most 1, is the part of the cell's volume that counts. For
  /// boundary partial_cells.
  void partial_run(std::int32_t j, std::int32_t k, std::int32_t begin,
                   std::span<const double> shares) const {
    receive_partial_run(self, j, k, begin, shares);
  }
};

/// Functions of a lattice across the boundary.
struct LatticeFunctions {
  bool (*build)(const void* lattice, const LatticeSink& sink, const Complaint& why) noexcept;
};

/// A lattice class has: void build(const LatticeSink&) const, which throws if no particle is in the
/// shape.
template <class T>
concept LatticeComponent = requires(const T& lattice, const LatticeSink& sink) {
  lattice.build(sink);
};

namespace detail {
template <LatticeComponent T>
struct FunctionsOf<T> {
  static constexpr Family family = Family::lattices;
  static constexpr LatticeFunctions table{
      [](const void* lattice, const LatticeSink& sink, const Complaint& why) noexcept {
        return guarded(why, [&] { static_cast<const T*>(lattice)->build(sink); });
      }};
};
}  // namespace detail
}  // namespace hyperlattice

#include <hyperlattice/boundary.hpp>  // the gate needs all structs of the boundary
