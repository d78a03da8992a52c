// The structure of a lattice component, for the analysis of its infinite lattice.
#pragma once

#include <model/spring_lattice.hpp>

#include <string>

namespace hyperlattice {

/// Returns the structure of a lattice component with spacing 1 m; builds a small body for it.
/// `options`: the component's options, each as "name=value". Throws InputError at --lattice or
/// --option if the type is unknown, an option is wrong, or the lattice needs more than a spacing, a
/// shape and these options; OutsideError if the host refuses its library.
LatticeGeometry load_lattice(Host& host, const std::string& type,
                             const std::vector<std::string>& options = {});

}  // namespace hyperlattice
