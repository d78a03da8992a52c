// Arrays of NumPy from the state of a run.
#pragma once

#include "job.hpp"

#include <pybind11/numpy.h>

#include <memory>
#include <optional>
#include <string>

namespace hyperlattice::python {

/// Returns a field of the present state as a copy, in doubles: one number of each particle, or a
/// row of its components. `name`: a field, or a component as "stress_xx". Throws
/// std::invalid_argument if the run has no such field.
pybind11::array field_copy(Job& job, const std::string& name);

/// Returns a view of the motion or of a component ("displacement", "velocity_z", "height") that
/// cannot be written, in the precision of the run; none if the motion is not one array in memory.
/// The view keeps the job alive.
std::optional<pybind11::array> field_view(const std::shared_ptr<Job>& job, const std::string& name);

/// Returns the names of the fields that the run has.
std::vector<std::string> names_of_fields(Job& job);

/// Returns the places of the particles at rest, m, a row of each.
pybind11::array positions(Job& job);

/// Sets displacements, m, or velocities, m/s, of all particles. Throws std::invalid_argument if the
/// array has not three numbers of each particle, and std::logic_error while the solver keeps a copy
/// of the state.
void set_motion(
    Job& job, bool velocity,
    const pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>& rows);

}  // namespace hyperlattice::python
