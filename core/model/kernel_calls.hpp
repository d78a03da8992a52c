// Calls of the functions of a model's law. Each function throws OutsideError with the name of the
// material's plugin if the law throws.
#pragma once

#include <model/model.hpp>
#include <scene/stage_call.hpp>

namespace hyperlattice {

/// Calls a kernel. `kernel`: one of step, step_damped and measure of model.kernels.
inline void call_kernel(const Model& model, decltype(KernelSet::step) kernel,
                        const KernelRequest& request) {
  call(*model.materials.front().stage, "kernel",
       [&](const Complaint& why) { return kernel(request, why); });
}

/// Computes the forces and tangents of a row of springs. Returns their energy, J.
inline double linearise_springs(const Model& model, const SpringRow& row) {
  double energy = 0;
  call(*model.materials.front().stage, "force",
       [&](const Complaint& why) { return model.kernels.linearise(row, energy, why); });
  return energy;
}

/// Returns the force, N, and energy, J, of one spring in its present state.
inline SpringAnswer ask_spring(const Model& model, const OneSpring& spring) {
  SpringAnswer answer;
  call(*model.materials.front().stage, "force",
       [&](const Complaint& why) { return model.kernels.ask(spring, answer, why); });
  return answer;
}

/// Returns the same after a step of `time_step` seconds. `kept`: in: memory of the spring before
/// the step; out: after it.
inline SpringAnswer take_spring(const Model& model, const OneSpring& spring, double time_step,
                                double* kept) {
  SpringAnswer answer;
  call(*model.materials.front().stage, "force", [&](const Complaint& why) {
    return model.kernels.take(spring, time_step, kept, answer, why);
  });
  return answer;
}

/// Sets the start values of a spring's memory `kept`. `law`: the constants of the spring.
inline void start_spring(const Model& model, const double* law, const SpringIdentity& spring,
                         double* kept) {
  if (model.kernels.start == nullptr) return;
  call(*model.materials.front().stage, "start",
       [&](const Complaint& why) { return model.kernels.start(law, spring, kept, why); });
}

}  // namespace hyperlattice
