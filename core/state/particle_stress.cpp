#include <state/cell_stress.hpp>
#include <state/corner_means.hpp>
#include <state/particle_stress.hpp>
#include <state/present_volumes.hpp>

#include <cmath>
#include <limits>
#include <optional>

namespace hyperlattice {

namespace {

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

/// Returns the volumetric energies of a listed body, if it has them.
std::optional<PresentVolumes> volumes_of(const PresentSprings& springs) {
  const Model& model = springs.model();
  if (!model.nodal_volumes) return std::nullopt;
  std::vector<Vec3> moved(model.body.particles);
  for (Particle p = 0; p < model.body.particles; ++p) moved[p] = springs.displacement(p);
  return std::make_optional<PresentVolumes>(*model.nodal_volumes, std::move(moved),
                                            springs.simulation().breakages());
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
  const auto volumes = volumes_of(springs);
  for (Particle p = 0; p < body.particles; ++p) {
    const double J = 1 + volume_change(H[p]);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    stresses[p] = symmetric_part(1 / (J > 0 ? J : J <= 0 ? nan : 1) * virial[p]);
    if (volumes)
      for (std::size_t c = 0; c < 3; ++c) stresses[p][c] += volumes->pressure(p);
  }
  return stresses;
}

std::vector<Tensor> nominal_stresses(const PresentSprings& springs) {
  if (has_cells(springs.model().body))
    return means_of_cells<Tensor>(springs, Asked::forces, no_tensor,
                                  [](const PresentCell& cell, double spacing) {
                                    return std::optional(nominal_stress(cell, spacing));
                                  });
  std::vector<Tensor> stresses =
      virials(springs, [](const PresentSpring& spring) { return spring.rest; });
  if (const auto volumes = volumes_of(springs)) {
    const std::vector<Tensor> H = gradients(springs, springs.displacements());
    for (Particle p = 0; p < stresses.size(); ++p)
      stresses[p] +=
          volumes->pressure(p) * cofactor(std::isfinite(trace(H[p])) ? identity + H[p] : identity);
  }
  return stresses;
}

std::vector<double> energy_densities(const PresentSprings& springs) {
  const Model& model = springs.model();
  const Body& body = model.body;
  if (has_cells(body))
    return means_of_cells<double>(springs, Asked::energies,
                                  std::numeric_limits<double>::quiet_NaN(),
                                  [](const PresentCell& cell, double spacing) {
                                    return std::optional(energy_density(cell, spacing));
                                  });
  std::vector<double> energies(body.particles, 0);
  springs.for_springs(Asked::energies, [&](const PresentSpring& spring) {
    for (const Particle end : {spring.a, spring.b})
      energies[end] += 0.5 * spring.share * spring.energy;
  });
  const auto volumes = volumes_of(springs);
  for (Particle p = 0; p < body.particles; ++p) {
    if (volumes) energies[p] += volumes->energy(p);
    const double height = springs.height(p);
    if (height != 0)
      energies[p] += body.share(p) * springs.remaining_alpha(p) *
                     model.kinds.alphas[model.kinds.of(p)] * height * height;
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
  if (const auto volumes = volumes_of(springs))
    for (Particle p = 0; p < model.body.particles; ++p) forces[p] += volumes->force(p);
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
