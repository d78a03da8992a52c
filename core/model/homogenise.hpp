// Elastic constants of a listed lattice, from its periodic sample: a uniform strain is applied to
// the sample, and its particles move to their positions of rest.
#pragma once

#include <model/listed.hpp>

#include <hyperlattice/material.hpp>

namespace hyperlattice {

/// Returns the constants of one layer, Pa, made isotropic: bulk modulus and Voigt's mean of the
/// shear moduli. `membrane_distance`: Delta, m. Without a sample it calls strained_alike() on the
/// body, which makes the lattice too stiff. Throws std::invalid_argument if the springs make no
/// solid.
ElasticConstants homogenise(const Listed& listed, double volume, double membrane_distance,
                            const MaterialConstants& constants);

/// Returns the constants, Pa, for equal strain of all particles of the sample, or of the body:
/// equations (33) to (36) of Zhao 2017, summed over the springs.
ElasticConstants strained_alike(const Listed& listed, double volume, double membrane_distance,
                                const MaterialConstants& constants);

}  // namespace hyperlattice
