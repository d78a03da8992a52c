// A material: the stiffnesses of its springs, and the law that gives a spring's force from its
// elongation. The kernels that apply the law to a lattice are instantiated from kernels/ inside the
// material's own library (CMake: hyperlattice_add_material).
#pragma once

#include <hyperlattice/component.hpp>
#include <hyperlattice/kernel_set.hpp>
#include <hyperlattice/law.hpp>
#include <hyperlattice/sites.hpp>

#include <cstring>
#include <string>

namespace hyperlattice {

/// The springs that a material gives to a lattice. A cross spring (beta, gamma) belongs to the same
/// neighbour as its base spring.
struct MaterialConstants {
  double density = 0;  ///< kg/m3
  /// k, N/m; base springs of a class have k times LatticeFacts::class_stiffness.
  double base_stiffness = 0;
  double cross_ratio[max_spring_classes] = {};  ///< k_beta / k, k_gamma / k, for each spring class
  double alpha_ratio = 0;                       ///< k_alpha / k; not used if clamped
  bool clamped = false;  ///< k_alpha infinite: no motion in the fourth dimension (III, IV)
  /// Law::Constants of each class's base and cross springs; unused if the law has none.
  double law[max_spring_classes][2][max_law_constants] = {};
  /// K_v of the volumetric energy of the cells, or of the nodal volumes of a list, Pa
  /// (volumetric_cell.hpp). Not 0 only on a lattice with LatticeFacts::has_cells; below 0 only
  /// without failure and not on a list.
  double volumetric = 0;

  /// Sets the law's constants of one class's base springs (cross 0) or cross springs (1).
  template <class Constants>
  void set_law(std::uint32_t spring_class, int cross, const Constants& constants) {
    static_assert(sizeof constants <= sizeof law[0][0]);
    std::memcpy(law[spring_class][cross], &constants, sizeof constants);
  }

  /// Sets the law's constants of all springs.
  template <class Constants>
  void set_law(const Constants& constants) {
    for (std::uint32_t c = 0; c < max_spring_classes; ++c)
      for (const int cross : {0, 1}) set_law(c, cross, constants);
  }

  bool has_cross_springs() const {
    for (const double ratio : cross_ratio)
      if (ratio != 0) return true;
    return false;
  }
};

/// Elastic constants of one layer, Pa; means over the axes if the lattice is not cubic.
struct ElasticConstants {
  double C11 = 0, C12 = 0, C44 = 0;

  /// Young's modulus along [100], Pa.
  double young() const { return (C11 - C12) * (C11 + 2 * C12) / (C11 + C12); }
  double poisson() const { return C12 / (C11 + C12); }  ///< nu', for a pull along [100]
};

/// The lattice data from which a material chooses the stiffness of its springs.
struct LatticeFacts {
  double spacing = 0;            ///< l, metres
  Basis basis = cubic_basis;     ///< steps between sites, in units of the spacing
  double site_volume = 0;        ///< volume of one whole particle, m3
  double membrane_distance = 0;  ///< Delta, metres
  std::span<const Neighbour> neighbours;
  std::uint32_t spring_classes = 1;
  /// Stiffness of each class's base springs over k, for each spring class.
  std::array<double, max_spring_classes> class_stiffness{1, 1, 1, 1};
  /// Particles of the body; with boundary cells the sum of their fractions.
  std::uint64_t particles = 0;
  /// Sum over the body's base springs of fraction * stiffness / k * length^2, m2.
  double squared_lengths = 0;
  /// For a list: the same sums with length, m, and length^3, m3.
  double lengths = 0, cubed_lengths = 0;
  /// The scene accepts unstable lattices: a material must not refuse them.
  bool allow_unstable = false;
  /// The lattice can have volumetric energies: its sites are the corners of cubic cells, or it is a
  /// list, whose particles are the corners of tetrahedra.
  bool has_cells = false;

  void* self = nullptr;
  ElasticConstants (*get_elastic_constants)(void* self,
                                            const MaterialConstants& constants) noexcept = nullptr;
  /// Null: not known.
  bool (*get_stable)(void* self, const MaterialConstants& constants) noexcept = nullptr;

  /// Returns the elastic constants of the infinite lattice with these springs.
  ElasticConstants elastic_constants(const MaterialConstants& constants) const {
    return get_elastic_constants(self, constants);
  }
  /// Returns whether the infinite mirrored layer is stable with these springs; true if it is not
  /// known.
  bool is_stable(const MaterialConstants& constants) const {
    return get_stable == nullptr || get_stable(self, constants);
  }
};

/// Functions of a material across the boundary.
struct MaterialFunctions {
  bool (*constants)(const void* material, const LatticeFacts& lattice, MaterialConstants& constants,
                    const Complaint& why) noexcept;
  bool (*kernels)(const void* material, const KernelChoice& choice, KernelSet& kernels,
                  const Complaint& why) noexcept;
  /// Name; materials of one library with one law share kernels.
  std::string_view (*law)(const void* material) noexcept;
  /// Null: the stable step of the elastic springs holds.
  bool (*stable_step)(const void* material, double elastic_step, double& step,
                      const Complaint& why) noexcept;
};

/// A material class has: MaterialConstants constants(const LatticeFacts&) const, which throws if E,
/// nu and membrane do not fit (a sentence whose first word is an option's name blames that option);
/// static KernelSet kernels(const KernelChoice&); static constexpr std::string_view law. Both are
/// not static if the options choose the law. It may have double stable_time_step(double
/// elastic_step) const: the largest stable step, s, of a law that adds to the elastic forces
/// (viscosity); elastic_step is the stable step of the elastic springs.
template <class T>
concept MaterialComponent = requires(const T& material, const LatticeFacts& lattice,
                                     const KernelChoice& choice) {
  { material.constants(lattice) } -> std::convertible_to<MaterialConstants>;
  { material.kernels(choice) } -> std::convertible_to<KernelSet>;
  { material.law } -> std::convertible_to<std::string_view>;
};

namespace detail {
template <class T>
constexpr auto stable_step_of() -> decltype(MaterialFunctions::stable_step) {
  if constexpr (requires(const T& material) { material.stable_time_step(1.0); })
    return
        [](const void* material, double elastic_step, double& step, const Complaint& why) noexcept {
          return guarded(
              why, [&] { step = static_cast<const T*>(material)->stable_time_step(elastic_step); });
        };
  else
    return nullptr;
}

template <MaterialComponent T>
struct FunctionsOf<T> {
  static constexpr Family family = Family::materials;
  static constexpr MaterialFunctions table{
      [](const void* material, const LatticeFacts& lattice, MaterialConstants& constants,
         const Complaint& why) noexcept {
        return guarded(why,
                       [&] { constants = static_cast<const T*>(material)->constants(lattice); });
      },
      [](const void* material, const KernelChoice& choice, KernelSet& kernels,
         const Complaint& why) noexcept {
        return guarded(why, [&] { kernels = static_cast<const T*>(material)->kernels(choice); });
      },
      [](const void* material) noexcept -> std::string_view {
        return static_cast<const T*>(material)->law;
      },
      stable_step_of<T>()};
};
}  // namespace detail
}  // namespace hyperlattice

#include <hyperlattice/boundary.hpp>  // the gate needs all structs of the boundary
