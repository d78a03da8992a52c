// A lattice plugin's structure, for the analysis of its endless lattice.
#pragma once

#include <model/spring_lattice.hpp>

#include <string>

namespace hyperlattice {

/// The structure of a lattice plugin with spacing 1 m, by building a small body. InputError at --lattice if there is no such lattice, or if it is not
/// one that a spacing and a shape describe; OutsideError if its library is refused.
LatticeGeometry load_lattice(Host& host, const std::string& type);

}  // namespace hyperlattice
