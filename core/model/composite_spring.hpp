// A spring between particles of different materials whose laws, or the constants of their law,
// differ. It consists of parts, each with the law of one material:
//
//   in series     two half springs, f = f_1(e_1) = f_2(e_2), u = (e_1 + e_2) / 2
//   side by side  the springs of the cells around it, f = sum w_n f_n(u)
//
// f_n(e) is the force of a whole spring of material n with the elongation e. A half spring of the
// elongation e / 2 has this force, so constants of laws keep their meaning. No constants are
// averaged.
#pragma once

#include <model/law.hpp>

#include <span>
#include <vector>

namespace hyperlattice {

/// Most parts of a spring: a spring belongs to at most four cells.
inline constexpr std::size_t max_spring_parts = 4;
/// Most numbers that a spring keeps.
inline constexpr std::size_t max_spring_memory = max_spring_parts * (max_law_memory + 2) + 1;

struct SpringPart {
  std::uint8_t material = 0;
  std::uint32_t law = 0;     ///< index in SpringTable::laws
  double weight = 1;         ///< w_n, side by side
  double stiffness[2] = {};  ///< of a whole base and cross spring of the material, N/m
  const double* constants[2] = {};
};

/// Force, N, energies, J, and integrity of a composite spring.
struct CompositeAnswer {
  double force = 0, stored = 0;
  double dissipated = 0, fractured = 0;  ///< in the last step: by laws, and by laws that soften
  double integrity = 1;                  ///< 1 intact, 0 gone
};

class CompositeSpring {
 public:
  enum class Joined { in_series, side_by_side };

  /// `parts` are sorted by their material.
  CompositeSpring(std::span<const Law> laws, std::vector<SpringPart> parts, Joined joined);

  std::span<const SpringPart> parts() const { return parts_; }
  bool in_series() const { return joined_ == Joined::in_series; }
  std::uint32_t memory() const { return memory_; }  ///< numbers that a spring keeps
  /// Returns the place in this memory of the first number of part n.
  std::uint32_t first_number(std::size_t n) const { return first_[n]; }

  /// One spring, base (cross 0) or cross (1). `factor`: its stiffness over that of its class.
  struct Spring {
    std::size_t cross = 0;
    double factor = 1, rest_length = 0, elongation = 0;  ///< lengths in m
  };
  /// Sets the start values of a new spring's memory, which is all zero.
  void start(const SpringIdentity& identity, std::size_t cross, double* kept) const;
  /// Advances a spring by a step of `time_step` seconds. `kept`: in: memory before the step; out:
  /// after it.
  CompositeAnswer take(const Spring& spring, double time_step, double* kept) const;
  /// Returns the present answer without a step.
  CompositeAnswer present(const Spring& spring, const double* kept) const;
  /// Calls visit(law, spring, weight) for each part in its present state.
  template <class Visit>
  void for_parts(const Spring& spring, const double* kept, const Visit& visit) const {
    if (is_absent(spring.cross)) return;
    const bool series = in_series(spring.cross);
    for (std::size_t n = 0; n < parts_.size(); ++n) {
      OneSpring part =
          one(spring, n, series ? elongation_of(n, spring.elongation, kept) : spring.elongation);
      part.memory = kept + first_[n];
      visit(laws_[parts_[n].law], part, series ? 0.5 : parts_[n].weight);
    }
  }
  /// Returns the derivative of the force, N/m, after a step of `time_step` seconds, 0 in statics,
  /// that starts from the memory `kept`: a central difference.
  double tangent(const Spring& spring, double time_step, const double* kept) const;
  /// Returns the elongation, m, of a whole spring of the material of part n with the same force,
  /// for the memory after a step.
  double elongation_of(std::size_t n, double elongation, const double* kept) const;

 private:
  bool in_series(std::size_t cross) const;
  bool is_absent(std::size_t cross) const;
  OneSpring one(const Spring& spring, std::size_t n, double elongation) const;
  SpringAnswer take_part(const Spring& spring, std::size_t n, double elongation, double time_step,
                         double* kept) const;
  double solve(const Spring& spring, double time_step, const double* kept) const;
  void add(CompositeAnswer& sum, std::size_t n, double weight, const SpringAnswer& part) const;

  std::span<const Law> laws_;
  std::vector<SpringPart> parts_;
  std::vector<std::uint32_t> first_;  ///< first number of each part in the memory
  Joined joined_;
  std::uint32_t memory_ = 0;
};

}  // namespace hyperlattice
