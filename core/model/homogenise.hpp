// Elastic constants of a listed lattice: those of its periodic sample, whose particles find their
// own rest under a uniform strain of the whole.
#pragma once

#include <model/listed.hpp>

#include <hyperlattice/material.hpp>

namespace hyperlattice {

/// Of one layer, Pa, made isotropic: bulk modulus and Voigt's mean of the shear moduli.
/// `membrane_distance`: Delta, metres. Without a sample, the body's own springs are strained alike,
/// which makes it too stiff. Throws std::invalid_argument if the springs make no solid.
ElasticConstants homogenise(const Listed& listed, double volume, double membrane_distance,
                            const MaterialConstants& constants);

/// As if all particles of the sample, or of the body, were strained alike: equations (33) to (36)
/// of Zhao 2017, summed over the springs.
ElasticConstants strained_alike(const Listed& listed, double volume, double membrane_distance,
                                const MaterialConstants& constants);

}  // namespace hyperlattice
