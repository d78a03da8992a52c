// Begins writers and probes once before the run, on the body at rest, so that unfit options are
// wrong input and nothing is written. Writers also write a frame or two of a few particles into a
// temporary folder, from which the plan knows the bytes of a frame.
#pragma once

#include <plan/plan.hpp>

namespace hyperlattice {

/// Begins a copy of every writer and probe. A refusal becomes a fault at its stage. Fills the
/// plan's tables and costs of frames.
void try_outputs(Plan& plan, Faults& faults);

}  // namespace hyperlattice
