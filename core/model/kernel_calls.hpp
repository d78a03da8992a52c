// Calls of the functions of a model's law. Each throws OutsideError, naming the material's plugin,
// if the law throws.
#pragma once

#include <model/model.hpp>
#include <scene/stage_call.hpp>

namespace hyperlattice {

/// `kernel`: one of the model's step, step_damped, measure.
inline void call_kernel(const Model& model, decltype(KernelSet::step) kernel,
                        const KernelRequest& request) {
  call(*model.materials.front().stage, "kernel",
       [&](const Complaint& why) { return kernel(request, why); });
}

/// Forces and tangents of a row of springs; returns their energy, J.
inline double linearise_springs(const Model& model, const SpringRow& row) {
  double energy = 0;
  call(*model.materials.front().stage, "force",
       [&](const Complaint& why) { return model.kernels.linearise(row, energy, why); });
  return energy;
}

/// Force and energy of one spring as it is.
inline SpringAnswer ask_spring(const Model& model, const OneSpring& spring) {
  SpringAnswer answer;
  call(*model.materials.front().stage, "force",
       [&](const Complaint& why) { return model.kernels.ask(spring, answer, why); });
  return answer;
}

/// The same after a step of that many seconds; `kept`: its memory, which becomes that of now.
inline SpringAnswer take_spring(const Model& model, const OneSpring& spring, double time_step,
                                double* kept) {
  SpringAnswer answer;
  call(*model.materials.front().stage, "force", [&](const Complaint& why) {
    return model.kernels.take(spring, time_step, kept, answer, why);
  });
  return answer;
}

/// Sets what a spring keeps at first. `law`: its constants.
inline void start_spring(const Model& model, const double* law, const SpringIdentity& spring,
                         double* kept) {
  if (model.kernels.start == nullptr) return;
  call(*model.materials.front().stage, "start",
       [&](const Complaint& why) { return model.kernels.start(law, spring, kept, why); });
}

}  // namespace hyperlattice
