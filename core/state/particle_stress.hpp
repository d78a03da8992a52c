// Stress, energy density and forces of each particle, from the forces of its springs. See
// docs/theory/stress.md.
#pragma once

#include <state/particle_strain.hpp>

namespace hyperlattice {

/// Returns the Cauchy stress of each particle, Pa: the mean over the cells around it, with their
/// shares as weights. In a lattice without cubic cells it is the virial of the particle's springs,
///   sigma_i = 1/(2 J V_i) sum f (x) r,
/// V_i the particle's share of the volume of a site, J that of the least-squares gradient, or 1 if
/// there is none, and the pressure of its nodal volume if it has one. NaN for a particle of a cubic
/// lattice around which no cell has a stress.
std::vector<Symmetric> cauchy_stresses(const PresentSprings& springs);
/// Returns the nominal stress, Pa, in the same way: 1/(2 V_i) sum f (x) R without cells.
std::vector<Tensor> nominal_stresses(const PresentSprings& springs);
/// Returns the stored energy per volume at rest, J/m3: the mean over the cells; without cells half
/// of the energy of each spring, and the alpha spring, over V_i.
std::vector<double> energy_densities(const PresentSprings& springs);

/// Returns the force of the springs, and of a volumetric term, on each particle, N.
std::vector<Vec3> internal_forces(const PresentSprings& springs);

/// Returns minus a third of the trace: the mean pressure, Pa.
double pressure(const Symmetric& stress);
/// Returns sqrt(3/2 s : s) with the deviator s, Pa.
double von_mises(const Symmetric& stress);

}  // namespace hyperlattice
