// A lattice: where particles sit and which of them springs join. A structured lattice is a box of
// sites with runs of particles along x, and one short list of neighbours that every site shares;
// springs are never listed. A listed lattice names every particle and every spring.
#pragma once

#include <hyperlattice/component.hpp>
#include <hyperlattice/sites.hpp>

namespace hyperlattice {

/// The fixed part of a structured lattice. Site (i, j, k) stands at origin + spacing * (i a1 + j a2
/// + k a3).
struct Grid {
  Vec3 origin;
  double spacing = 0;                   ///< lattice constant l, metres
  Basis basis = cubic_basis;            ///< a1, a2, a3
  std::array<std::int32_t, 3> sites{};  ///< box of sites
  double site_volume = 0;               ///< volume of one whole particle, m3
  double membrane_distance =
      0;  ///< Delta: distance to the mirror copy in the fourth dimension, metres
  std::span<const Neighbour> neighbours;  ///< forward neighbours
  std::uint32_t spring_classes = 1;
  std::array<double, max_spring_classes> class_stiffness{
      1, 1, 1, 1};  ///< of each class's base springs, over k: what makes the lattice isotropic
  Boundary boundary = Boundary::particles;  ///< cells need the cubic basis
  const Shape* shape =
      nullptr;  ///< the solid that was filled, as it came in the options; null: none
};

/// A base spring between two particles of a list.
struct ListedSpring {
  std::uint32_t a = 0, b = 0;
  double stiffness = 1;  ///< over k, of the base spring and of the cross springs beside it
};

/// A lattice that is a list: particles anywhere, joined by the springs named.
struct PointList {
  double spacing = 0;            ///< l: a typical distance of neighbours, metres
  double site_volume = 0;        ///< volume of one whole particle, m3
  double membrane_distance = 0;  ///< Delta, metres
  std::span<const Vec3> positions;
  std::span<const double> volumes;  ///< m3, one a particle; none: all are whole
  std::span<const ListedSpring> springs;
  const Shape* shape =
      nullptr;  ///< the solid that was filled, as it came in the options; null: none
};

/// A spring of a periodic sample, from particle a to particle b or to one of b's images.
struct SampleSpring {
  std::uint32_t a = 0, b = 0;
  Vec3 rest;             ///< metres
  double stiffness = 1;  ///< over k
};

/// A piece of an endless body of the same make as the list, repeated in all directions: what its
/// elastic constants are found from.
struct PeriodicSample {
  std::uint32_t particles = 0;
  double volume = 0;  ///< m3
  std::span<const SampleSpring> springs;
};

/// Receives a lattice. A structured one: the grid once, then the runs of particles (boundary cells:
/// of cells) in the order z, y, x. A listed one: its points once, and a sample if there is one.
struct LatticeSink {
  void* self = nullptr;
  bool for_analysis = false;  ///< no body is wanted: neighbours, or the sample by itself, and a
                              ///< body as small as may be
  void (*receive_grid)(void* self, const Grid& grid) noexcept = nullptr;
  void (*receive_run)(void* self, std::int32_t j, std::int32_t k, std::int32_t begin,
                      std::int32_t end) noexcept = nullptr;
  void (*receive_points)(void* self, const PointList& points) noexcept = nullptr;
  void (*receive_sample)(void* self, const PeriodicSample& sample) noexcept = nullptr;

  void grid(const Grid& g) const { receive_grid(self, g); }
  void points(const PointList& list) const { receive_points(self, list); }
  void sample(const PeriodicSample& piece) const { receive_sample(self, piece); }
  /// Particles at sites begin <= i < end of row (j, k); with boundary cells, the cells whose low
  /// corners these sites are.
  void run(std::int32_t j, std::int32_t k, std::int32_t begin, std::int32_t end) const {
    receive_run(self, j, k, begin, end);
  }
};

struct LatticeFunctions {
  bool (*build)(const void* lattice, const LatticeSink& sink, const Complaint& why) noexcept;
};

/// A lattice class has: void build(const LatticeSink&) const. It throws if no particle falls into
/// the shape.
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

#include <hyperlattice/boundary.hpp>  // the gate, once all that a family hands over is known
