// The errors of the core as exceptions of Python.
#pragma once

namespace hyperlattice::python {

/// Lets errors of the core arrive as the classes of hyperlattice/_errors.py: InputError as
/// SceneError with its faults, RunError as RunError, OutsideError as OutsideError; lack of memory
/// as MemoryError.
void translate_errors();

}  // namespace hyperlattice::python
