// A law of the body and its kernels; materials with the same law share them. Calls of its functions
// throw OutsideError with the name of the material's plugin if the law throws.
#pragma once

#include <scene/stage_call.hpp>

#include <hyperlattice/kernel_request.hpp>
#include <hyperlattice/material.hpp>

namespace hyperlattice {

struct Law {
  const Stage* stage = nullptr;  ///< the first material with the law
  std::string_view name;
  KernelSet kernels;
};

/// Calls a kernel. `kernel`: step or measure of the law's kernels.
inline void call_kernel(const Law& law, decltype(KernelSet::step) kernel,
                        const KernelRequest& request) {
  call(*law.stage, "kernel", [&](const Complaint& why) { return kernel(request, why); });
}

/// Computes the springs of a row for the kernel of another law. `kernel`: step_row or measure_row.
/// Returns their energies.
inline RowEnergies call_row_kernel(const Law& law, decltype(KernelSet::step_row) kernel,
                                   const KernelRequest& request, const RowPlace& row) {
  RowEnergies energies;
  call(*law.stage, "kernel",
       [&](const Complaint& why) { return kernel(request, row, energies, why); });
  return energies;
}

/// Computes the forces and tangents of a row of springs. Returns their energy, J.
inline double linearise_springs(const Law& law, const SpringRow& row) {
  double energy = 0;
  call(*law.stage, "force",
       [&](const Complaint& why) { return law.kernels.linearise(row, energy, why); });
  return energy;
}

/// Returns the force, N, and energy, J, of one spring in its present state.
inline SpringAnswer ask_spring(const Law& law, const OneSpring& spring) {
  SpringAnswer answer;
  call(*law.stage, "force",
       [&](const Complaint& why) { return law.kernels.ask(spring, answer, why); });
  return answer;
}

/// Returns the same after a step of `time_step` seconds. `kept`: in: memory of the spring before
/// the step; out: after it.
inline SpringAnswer take_spring(const Law& law, const OneSpring& spring, double time_step,
                                double* kept) {
  SpringAnswer answer;
  call(*law.stage, "force", [&](const Complaint& why) {
    return law.kernels.take(spring, time_step, kept, answer, why);
  });
  return answer;
}

/// Reads the fields that the law gives for one spring in its present state.
inline void read_fields(const Law& law, const OneSpring& spring, double* values) {
  call(*law.stage, "fields",
       [&](const Complaint& why) { return law.kernels.read_fields(spring, values, why); });
}

/// Sets the start values of a spring's memory `kept`. `constants`: those of the law for the spring.
inline void start_spring(const Law& law, const double* constants, const SpringIdentity& spring,
                         double* kept) {
  if (law.kernels.start == nullptr) return;
  call(*law.stage, "start",
       [&](const Complaint& why) { return law.kernels.start(constants, spring, kept, why); });
}

}  // namespace hyperlattice
