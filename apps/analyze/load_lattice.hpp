// A lattice plugin's structure, for the analysis of its endless lattice.
#pragma once

#include <model/spring_lattice.hpp>

#include <string>

namespace hyperlattice {

/// The structure of a lattice plugin with spacing 1 m, by building a small body. `options`: of the
/// component, each as "name=value". InputError at
/// --lattice if there is no such lattice, or if it is not one that a spacing, a shape and these
/// options describe; OutsideError if its library is refused.
LatticeGeometry load_lattice(Host& host, const std::string& type,
                             const std::vector<std::string>& options = {});

}  // namespace hyperlattice
