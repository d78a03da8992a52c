// Writers and probes are begun once before the run, on the body at rest, so that what does not fit
// is wrong input and nothing is written. Writers also write a frame or two of a few particles into
// a folder that is removed at once, so that the plan knows how many bytes a frame has.
#pragma once

#include <plan/plan.hpp>

namespace hyperlattice {

/// Begins a copy of every writer and probe; a refusal becomes a fault at its stage. Fills the
/// plan's tables, and the costs of frames.
void rehearse_outputs(Plan& plan, Faults& faults);

}  // namespace hyperlattice
