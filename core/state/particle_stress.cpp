#include <state/cell_stress.hpp>
#include <state/corner_means.hpp>
#include <state/particle_stress.hpp>

#include <cmath>
#include <limits>

namespace hyperlattice {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Tensor no_tensor{{Vec3{nan, nan, nan}, Vec3{nan, nan, nan}, Vec3{nan, nan, nan}}};

/// The part of the volume at rest that a particle of a lattice without cells has, m3.
double volume_of(const Body& body, Particle particle) {
  return body.share(particle) * body.grid.site_volume;
}

/// Returns 1/(2 V_i) sum f (x) arm over the springs of each particle, Pa.
template <class Arm>
std::vector<Tensor> virials(const PresentSprings& springs, const Arm& arm) {
  const Body& body = springs.model().body;
  std::vector<Tensor> sums(body.particles);
  springs.for_springs(Asked::forces, [&](const PresentSpring& spring) {
    const Tensor of = outer(spring.share * spring.pull * (spring.rest + spring.apart), arm(spring));
    sums[spring.a] += of;
    sums[spring.b] += of;
  });
  for (Particle p = 0; p < body.particles; ++p) sums[p] = 1 / (2 * volume_of(body, p)) * sums[p];
  return sums;
}

/// Returns a cell's or particle's value for all particles.
template <class T, class OfCell>
std::vector<T> means_of_cells(const PresentSprings& springs, Asked asked, const T& none,
                              const OfCell& of_cell) {
  const Body& body = springs.model().body;
  CornerMeans<T> means(body.particles);
  for_cells(springs, asked, [&](const PresentCell& cell) {
    if (const auto value = of_cell(cell, body.grid.spacing)) means.add(cell, *value);
  });
  return means.take(none);
}

}  // namespace

std::vector<Symmetric> cauchy_stresses(const PresentSprings& springs) {
  const Body& body = springs.model().body;
  std::vector<Symmetric> stresses(body.particles);
  if (has_cells(body)) {
    const std::vector<Tensor> means = means_of_cells<Tensor>(
        springs, Asked::forces, no_tensor,
        [](const PresentCell& cell, double spacing) { return cauchy_stress(cell, spacing); });
    for (Particle p = 0; p < body.particles; ++p) stresses[p] = symmetric_part(means[p]);
    return stresses;
  }
  const std::vector<Tensor> H = gradients(springs, springs.displacements()),
                            virial = virials(springs, [](const PresentSpring&spring) {
                              return spring.rest + spring.apart;
                            });
  for (Particle p = 0; p < body.particles; ++p) {
    const double J = 1 + volume_change(H[p]);
    stresses[p] = symmetric_part(1 / (J > 0 ? J : J <= 0 ? nan : 1) * virial[p]);
  }
  return stresses;
}

std::vector<Tensor> nominal_stresses(const PresentSprings& springs) {
  if (has_cells(springs.model().body))
    return means_of_cells<Tensor>(springs, Asked::forces, no_tensor,
                                  [](const PresentCell& cell, double spacing) {
                                    return std::optional(nominal_stress(cell, spacing));
                                  });
  return virials(springs, [](const PresentSpring& spring) { return spring.rest; });
}

std::vector<double> energy_densities(const PresentSprings& springs) {
  const Model& model = springs.model();
  const Body& body = model.body;
  if (has_cells(body))
    return means_of_cells<double>(springs, Asked::energies, nan,
                                  [](const PresentCell& cell, double spacing) {
                                    return std::optional(energy_density(cell, spacing));
                                  });
  std::vector<double> energies(body.particles, 0);
  springs.for_springs(Asked::energies, [&](const PresentSpring& spring) {
    for (const Particle end : {spring.a, spring.b})
      energies[end] += 0.5 * spring.share * spring.energy;
  });
  for (Particle p = 0; p < body.particles; ++p) {
    const double height = springs.height(p);
    if (height != 0)
      energies[p] += body.share(p) * model.kinds.alphas[model.kinds.of(p)] * height * height;
    energies[p] /= volume_of(body, p);
  }
  return energies;
}

std::vector<Vec3> internal_forces(const PresentSprings& springs) {
  const Model& model = springs.model();
  std::vector<Vec3> forces(model.body.particles);
  springs.for_springs(Asked::forces, [&](const PresentSpring& spring) {
    const Vec3 force = spring.share * spring.pull * (spring.rest + spring.apart);
    forces[spring.a] += force;
    forces[spring.b] -= force;
  });
  if (model.volumetric.empty()) return forces;
  for_cells(springs, Asked::motion, [&](PresentCell cell) {
    add_volumetric_energy(model, cell);
    for (std::size_t n = 0; n < 8; ++n) forces[cell.corners[n]] += cell.force[n];
  });
  return forces;
}

double pressure(const Symmetric& stress) { return -(stress[0] + stress[1] + stress[2]) / 3; }

double von_mises(const Symmetric& stress) {
  const auto square = [](double x) { return x * x; };
  return std::sqrt(0.5 * (square(stress[0] - stress[1]) + square(stress[1] - stress[2]) +
                          square(stress[2] - stress[0])) +
                   3 * (square(stress[3]) + square(stress[4]) + square(stress[5])));
}

}  // namespace hyperlattice
