// A material: the constants of its springs, and the law that gives a spring's force from its
// elongation. The law is scalar physics; the kernels that run it over a lattice are instantiated
// from kernels/ inside the material's own library (CMake: hyperlattice_add_material).
#pragma once

#include <hyperlattice/component.hpp>
#include <hyperlattice/law.hpp>
#include <hyperlattice/sites.hpp>

#include <cstring>
#include <string>

namespace hyperlattice {

struct KernelRequest;  // kernels/request.hpp
struct SpringRow;

/// What a material makes of a lattice. Cross springs (beta, gamma) share their base spring's
/// neighbour.
struct MaterialConstants {
  double density = 0;         ///< kg/m3
  double base_stiffness = 0;  ///< k, N/m; base springs have it times their class's own factor
  double cross_ratio[max_spring_classes] =
      {};                  ///< k_beta / k, k_gamma / k: one for each spring class
  double alpha_ratio = 0;  ///< k_alpha / k; meaningless if clamped
  bool clamped = false;    ///< k_alpha infinite: no motion in the fourth dimension (III, IV)
  double law[max_spring_classes][2][max_law_constants] =
      {};  ///< Law::Constants of each class's base and cross springs, if the law has some

  /// Sets those of one class's base springs (cross 0) or cross springs (1).
  template <class Constants>
  void set_law(std::uint32_t spring_class, int cross, const Constants& constants) {
    static_assert(sizeof constants <= sizeof law[0][0]);
    std::memcpy(law[spring_class][cross], &constants, sizeof constants);
  }

  /// Sets those of all springs.
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

/// Elastic constants of one layer, Pa; of a lattice that is not cubic, means over the axes.
struct ElasticConstants {
  double C11 = 0, C12 = 0, C44 = 0;

  double young() const { return (C11 - C12) * (C11 + 2 * C12) / (C11 + C12); }  ///< along [100]
  double poisson() const { return C12 / (C11 + C12); }  ///< nu', pull along [100]
};

/// The lattice as a material sees it when it chooses its springs' stiffness.
struct LatticeFacts {
  double spacing = 0;            ///< l, metres
  Basis basis = cubic_basis;     ///< in units of the spacing
  double site_volume = 0;        ///< m3 of one particle
  double membrane_distance = 0;  ///< Delta, metres
  std::span<const Neighbour> neighbours;
  std::uint32_t spring_classes = 1;
  std::array<double, max_spring_classes> class_stiffness{1, 1, 1, 1};  ///< of base springs, over k
  std::uint64_t particles =
      0;  ///< of the body, in whole ones: with boundary cells the sum of their shares
  double squared_lengths = 0;  ///< sum over the body's base springs, in whole ones, of stiffness /
                               ///< k times squared length, m2
  double lengths = 0,
         cubed_lengths = 0;  ///< of a list: likewise with length, m, and its third power, m3
  bool allow_unstable =
      false;  ///< the scene wants unstable lattices to run: nothing is refused for that

  void* self = nullptr;
  ElasticConstants (*get_elastic_constants)(void* self,
                                            const MaterialConstants& constants) noexcept = nullptr;
  bool (*get_stable)(void* self,
                     const MaterialConstants& constants) noexcept = nullptr;  ///< null: not known

  /// Of the endless lattice with these springs.
  ElasticConstants elastic_constants(const MaterialConstants& constants) const {
    return get_elastic_constants(self, constants);
  }
  /// Whether the endless mirrored layer is stable with these springs.
  bool is_stable(const MaterialConstants& constants) const {
    return get_stable == nullptr || get_stable(self, constants);
  }
};

/// How displacements and velocities are stored, and steps computed. Measurements are computed in
/// doubles.
enum class Precision : std::uint32_t { doubles, floats };
constexpr std::size_t bytes_of(Precision precision) {
  return precision == Precision::floats ? sizeof(float) : sizeof(double);
}

/// What is special in a kernel; everything not asked for costs no instruction.
struct KernelChoice {
  enum class Membrane : std::uint32_t { none, clamped, free };
  Membrane membrane = Membrane::none;  ///< none, clamped: 3 degrees of freedom; free: 4
  bool breakable = false;              ///< a failure criterion is present
  bool mixed = false;                  ///< more than one material
  bool listed = false;                 ///< a list of particles and springs, not a grid
  Precision precision = Precision::doubles;
};

/// One spring, outside a kernel.
struct OneSpring {
  double stiffness = 0, rest_length = 0, elongation = 0;  ///< N/m, m, m
  const double* law = nullptr;                            ///< its constants, if the law has some
  const double* memory = nullptr;                         ///< KernelSet::memory numbers
};
struct SpringAnswer {
  double force = 0, energy = 0;  ///< N, J
};

/// Moves a block of particles by one step, or measures it. Null members: this library has no such
/// kernel.
struct KernelSet {
  bool (*step)(const KernelRequest& request, const Complaint& why) noexcept = nullptr;
  bool (*step_damped)(const KernelRequest& request, const Complaint& why) noexcept = nullptr;
  bool (*measure)(const KernelRequest& request, const Complaint& why) noexcept = nullptr;
  /// Forces and tangents of a row of springs, and their energy, J.
  bool (*linearise)(const SpringRow& row, double& energy, const Complaint& why) noexcept = nullptr;
  bool (*ask)(const OneSpring& spring, SpringAnswer& answer,
              const Complaint& why) noexcept = nullptr;
  /// Takes one spring a step of that many seconds further, to the elongation given; `kept`: its
  /// memory, which becomes that of now.
  bool (*take)(const OneSpring& spring, double time_step, double* kept, SpringAnswer& answer,
               const Complaint& why) noexcept = nullptr;
  /// Sets what a spring keeps at first, where all is zero; null: that is right.
  bool (*start)(const double* law, const SpringIdentity& spring, double* kept,
                const Complaint& why) noexcept = nullptr;
  std::uint32_t memory = 0;       ///< numbers that each spring keeps, base or cross
  const char* instructions = "";  ///< "avx512", "avx2", "baseline": what this processor was given
};

struct MaterialFunctions {
  bool (*constants)(const void* material, const LatticeFacts& lattice, MaterialConstants& constants,
                    const Complaint& why) noexcept;
  bool (*kernels)(const KernelChoice& choice, KernelSet& kernels, const Complaint& why) noexcept;
  std::string_view law;  ///< materials with the same law share kernels and may stand in one body
  /// Null: that of the elastic springs.
  bool (*stable_step)(const void* material, double elastic_step, double& step,
                      const Complaint& why) noexcept;
};

/// A material class has: MaterialConstants constants(const LatticeFacts&) const, which throws when
/// E, nu and membrane do not fit (a sentence whose first word is an option's name is an objection
/// to that option); static KernelSet kernels(const KernelChoice&); static constexpr
/// std::string_view law. It may have double stable_time_step(double elastic_step) const: the
/// largest stable step in seconds, where the law does more than the elastic springs whose stable
/// step it is given (viscosity).
template <class T>
concept MaterialComponent = requires(const T& material, const LatticeFacts& lattice,
                                     const KernelChoice& choice) {
  { material.constants(lattice) } -> std::convertible_to<MaterialConstants>;
  { T::kernels(choice) } -> std::convertible_to<KernelSet>;
  { T::law } -> std::convertible_to<std::string_view>;
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
      [](const KernelChoice& choice, KernelSet& kernels, const Complaint& why) noexcept {
        return guarded(why, [&] { kernels = T::kernels(choice); });
      },
      T::law, stable_step_of<T>()};
};
}  // namespace detail
}  // namespace hyperlattice

#include <hyperlattice/boundary.hpp>  // the gate, once all that a family hands over is known
