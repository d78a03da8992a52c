// The kernels of a law: what the core chooses, and the functions that it gets. Kernels include this
// header and not material.hpp, so that a word in the help of an option does not compile them again.
#pragma once

#include <hyperlattice/plain.hpp>

#include <cstddef>
#include <cstdint>

namespace hyperlattice {

struct KernelRequest;  // kernel_request.hpp
struct RowPlace;
struct RowEnergies;
struct SpringRow;
struct SpringIdentity;  // law.hpp

/// Precision of stored displacements and velocities and of the steps. Measurements always use
/// doubles.
enum class Precision : std::uint32_t { doubles, floats };
constexpr std::size_t bytes_of(Precision precision) {
  return precision == Precision::floats ? sizeof(float) : sizeof(double);
}

/// Features of a kernel. A feature that is off costs no instruction.
struct KernelChoice {
  enum class Membrane : std::uint32_t { none, clamped, free };
  Membrane membrane = Membrane::none;  ///< none, clamped: 3 degrees of freedom; free: 4
  bool listed = false;                 ///< a list of particles and springs, not a grid
  Precision precision = Precision::doubles;
};

/// One spring, for a question to its law outside a kernel.
struct OneSpring {
  double stiffness = 0, rest_length = 0, elongation = 0;  ///< stiffness, N/m; lengths, m
  const double* law = nullptr;                            ///< the law's constants, if it has any
  const double* memory = nullptr;  ///< memory of the spring: KernelSet::memory numbers
};
/// What a law says about one spring.
struct SpringAnswer {
  double force = 0, energy = 0;  ///< N, J
  double dissipated = 0;         ///< in the last step, J
  double integrity = 1;          ///< 1 intact, 0 gone; 1 of laws that do not soften
};

/// Functions that move a block of particles by one step, or measure it. Null members: this library
/// has no such kernel.
struct KernelSet {
  bool (*step)(const KernelRequest& request, const Complaint& why) noexcept = nullptr;
  bool (*measure)(const KernelRequest& request, const Complaint& why) noexcept = nullptr;
  /// Computes the springs of one row of a structured body for the kernel of another law: sets the
  /// row's own forces, and adds to those of other rows. The kernel has written a list's records.
  bool (*step_row)(const KernelRequest& request, const RowPlace& row, RowEnergies& energies,
                   const Complaint& why) noexcept = nullptr;
  bool (*measure_row)(const KernelRequest& request, const RowPlace& row, RowEnergies& energies,
                      const Complaint& why) noexcept = nullptr;
  /// Computes forces and tangents of a row of springs, and their energy, J.
  bool (*linearise)(const SpringRow& row, double& energy, const Complaint& why) noexcept = nullptr;
  bool (*ask)(const OneSpring& spring, SpringAnswer& answer,
              const Complaint& why) noexcept = nullptr;
  /// Advances one spring by a step of `time_step` seconds, to the given elongation. `kept`: its
  /// memory, in: at the previous step, out: at the current step.
  bool (*take)(const OneSpring& spring, double time_step, double* kept, SpringAnswer& answer,
               const Complaint& why) noexcept = nullptr;
  /// Sets the initial memory of a spring, whose numbers are all zero. Null: zeros are right.
  bool (*start)(const double* law, const SpringIdentity& spring, double* kept,
                const Complaint& why) noexcept = nullptr;
  /// Writes the fields of a spring in its present state. Null: the law gives none.
  bool (*read_fields)(const OneSpring& spring, double* values,
                      const Complaint& why) noexcept = nullptr;
  std::uint32_t memory = 0;  ///< numbers in the memory of each spring, base or cross
  std::uint32_t fields = 0;  ///< how many fields the law gives
  /// Two half springs in series are one spring of the law: it is linear and has no constants.
  bool linear = false;
  bool softens = false;           ///< the law has an integrity
  const char* instructions = "";  ///< instruction set: "avx512", "avx2" or "baseline"
};

}  // namespace hyperlattice
