// Springs of a listed body, each as a row of one spring. Their forces are computed in parallel and
// added in the order of the list, so that sums have the same order for any number of threads.
#include <base/thread_errors.hpp>
#include <scene/stage_call.hpp>
#include <state/present_volumes.hpp>
#include <statics/spring_rows.hpp>
#include <statics/statics.hpp>

#include <cmath>

namespace hyperlattice {

void Statics::make_list() {
  const Body& body = model_.body;
  StaticGrid& grid = problem_.grid;
  grid.places = static_cast<std::int64_t>(body.particles);
  grid.components = model_.degrees_of_freedom;
  grid.spacing = body.grid.spacing;
  grid.membrane_distance = body.grid.membrane_distance;
  free_.assign(body.particles, static_cast<std::uint8_t>((1u << grid.components) - 1));
  grid.free = free_.data();
  for (Particle p = 0; p < body.particles; ++p)
    particle_weight_.push_back(static_cast<float>(body.share(p)));
  if (!model_.kinds.material_of.empty())
    for (Particle p = 0; p < body.particles; ++p) kind_.push_back(model_.kinds.material_of[p]);
  for (std::uint32_t n = 0; n < body.listed.springs.size(); ++n) {
    const ListedSpring& spring = body.listed.springs[n];
    const SpringProperties properties = model_.spring_properties(spring.a, spring.b, n);
    springs_.push_back({spring.a, spring.b, properties.rest});
    spring_stiffness_.push_back(properties.stiffness);
    spring_cross_stiffness_.push_back(properties.cross_stiffness);
  }
  grid.springs = springs_;
  if (model_.nodal_volumes) grid.tetrahedra = model_.nodal_volumes->tetrahedra().all();
  if (model_.springs.memory == 0) return;
  spring_memory_.resize(springs_.size());
  simulation_.for_springs_of_list(
      [&](const Simulation::SpringMemory& spring) { spring_memory_[spring.index] = spring; });
}

void Statics::find_listed_weights() {
  weight_.assign(springs_.size(), 1);
  for (const Breakage& broken : simulation_.breakages())
    if (!broken.softened) weight_[broken.neighbour] = 0;
}

/// Adds the forces of nodal volumes and writes their tangents; returns their energy, J.
double Statics::respond_volumes(const double* u, double* force,
                                const SpringTangents* tangents) const {
  if (!model_.nodal_volumes) return 0;
  const auto places = static_cast<std::size_t>(problem_.grid.places);
  std::vector<Vec3> moved(places);
  for (std::size_t p = 0; p < places; ++p) moved[p] = {u[p], u[places + p], u[2 * places + p]};
  const PresentVolumes volumes(*model_.nodal_volumes, std::move(moved), simulation_.breakages());
  const double spacing = problem_.grid.spacing;
  double energy = 0;
  for (std::size_t p = 0; p < places; ++p) {
    const Vec3 own = volumes.force(p);
    for (std::size_t c = 0; c < 3; ++c) force[c * places + p] += own[c];
    energy += volumes.energy(p);
    if (tangents == nullptr) continue;
    tangents->volume_stiffness[p] = static_cast<float>(volumes.stiffness(p) * std::pow(spacing, 4));
    tangents->volume_pressure[p] = static_cast<float>(volumes.pressure(p) * spacing);
  }
  return energy;
}

double Statics::respond_list(const double* u, double* force, const SpringTangents* tangents) const {
  constexpr std::size_t piece = 1024;  // springs, for any number of threads
  const StaticGrid& grid = problem_.grid;
  const std::size_t springs = springs_.size(), pieces = (springs + piece - 1) / piece,
                    of_spring = 2 * static_cast<std::size_t>(grid.components);
  std::vector<double> pulls(of_spring * springs, 0),
      energies(pieces, 0);  // at both ends of each spring, by component and end
  const auto respond_piece = [&](std::size_t n) {
    RowBuffers buffer(grid, 1);
    SpringRow& row = buffer.springs;
    row.count = 1;
    double here[4][lanes] = {}, there[4][lanes] = {}, here_before[4][lanes] = {},
           there_before[4][lanes] = {};
    for (int c = 0; c < grid.components; ++c) {
      row.here[c] = here[c];
      row.there[c] = there[c];
      if (!moves()) continue;
      row.here_before[c] = here_before[c];
      row.there_before[c] = there_before[c];
    }
    time_row(row);
    for (std::size_t s = n * piece; s < std::min(springs, (n + 1) * piece); ++s) {
      const ListedSpring& ends = model_.body.listed.springs[s];
      const SpringConstants& constants =
          model_.springs.spring(model_.kinds.material(ends.a), model_.kinds.material(ends.b), 0);
      const StaticSpring& spring = springs_[s];
      row.rest = spring.rest;
      row.rest_length = norm(spring.rest);
      row.cross_rest_length = std::hypot(row.rest_length, grid.membrane_distance);
      buffer.weight[0] = static_cast<double>(weight_[s]);
      buffer.stiffness[0] = spring_stiffness_[s];
      buffer.cross_stiffness[0] = spring_cross_stiffness_[s];
      for (int c = 0; c < grid.components; ++c) {
        here[c][0] = u[c * grid.places + spring.a];
        there[c][0] = u[c * grid.places + spring.b];
        here_before[c][0] = state_[static_cast<std::size_t>(c * grid.places + spring.a)];
        there_before[c][0] = state_[static_cast<std::size_t>(c * grid.places + spring.b)];
      }
      LawMemory memory;
      for (std::size_t cross = 0; cross < 2 && !spring_memory_.empty(); ++cross)
        memory[cross] = spring_memory_[s].of[cross];
      energies[n] += linearise(
          {constants, model_.kinds.material(ends.a), buffer.stiffness[0], memory}, buffer);
      add_forces(buffer, grid, 2, 1, pulls.data() + of_spring * s);
      if (tangents != nullptr) keep_tangents(buffer, grid.components == 4, s, *tangents);
    }
  };
  ThreadErrors errors;
#pragma omp parallel for num_threads(grid.threads) schedule(static)
  for (std::size_t n = 0; n < pieces; ++n) errors.run(n, [&] { respond_piece(n); });
  errors.rethrow();
  for (std::size_t s = 0; s < springs; ++s)
    for (int c = 0; c < grid.components; ++c) {
      const double* pull = pulls.data() + of_spring * s + 2 * c;
      force[c * grid.places + springs_[s].a] += pull[0];
      force[c * grid.places + springs_[s].b] += pull[1];
    }
  double energy = 0;
  for (const double of_piece : energies) energy += of_piece;
  return energy + respond_volumes(u, force, tangents);
}

}  // namespace hyperlattice
