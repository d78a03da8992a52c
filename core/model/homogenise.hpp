// Elastic constants of a listed lattice: those of its periodic sample, whose particles find their own rest under a uniform strain of the whole.
#pragma once

#include <model/listed.hpp>

#include <hyperlattice/material.hpp>

namespace hyperlattice {

/// Of one layer, Pa, made isotropic: bulk modulus and Voigt's mean of the shear moduli. `membrane_distance`: Delta, metres. Without a sample, the
/// body's own springs are strained alike, which makes it too stiff. Throws std::invalid_argument if the springs make no solid.
ElasticConstants homogenise(const Listed& listed, double volume, double membrane_distance, const MaterialConstants& constants);

}  // namespace hyperlattice
