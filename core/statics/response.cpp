// Forces, energy and tangents of all springs, from the material's own kernels; on a grid by rows
// and neighbours. The springs of a plane act on it and on planes after it. Planes that share none
// of these are computed in parallel, so that sums have the same order for any number of threads.
#include <base/thread_errors.hpp>
#include <model/kernel_calls.hpp>
#include <statics/spring_rows.hpp>
#include <statics/statics.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

void no_tangents(std::size_t at, std::size_t count, const SpringTangents& tangents) {
  for (float* values : {tangents.axial, tangents.pull, tangents.cross_axial, tangents.cross_pull})
    if (values != nullptr) std::fill_n(values + at, count, 0.0f);
}

}  // namespace

double Statics::respond(const double* u, double* force, const SpringTangents* tangents) const {
  std::fill_n(force, problem_.grid.numbers(), 0.0);
  const double energy =
      problem_.grid.listed ? respond_list(u, force, tangents) : respond_grid(u, force, tangents);
  if (tangents != nullptr && problem_.grid.components == 4) fill_alpha(*tangents);
  return energy + hold_heights(u, force);
}

double Statics::respond_grid(const double* u, double* force, const SpringTangents* tangents) const {
  const StaticGrid& grid = problem_.grid;
  const std::int32_t planes = grid.sites[2], colours = model_.body.reach + 1;
  std::vector<double> energies(static_cast<std::size_t>(planes), 0);
  for (std::int32_t colour = 0; colour < colours; ++colour) {
    ThreadErrors errors;
#pragma omp parallel for num_threads(grid.threads) schedule(static)
    for (std::int32_t k = colour; k < planes; k += colours) {
      const auto plane = static_cast<std::size_t>(k);
      errors.run(plane, [&] { energies[plane] = respond_plane(k, u, force, tangents); });
    }
    errors.rethrow();
  }
  double energy = 0;
  for (const double of_plane : energies) energy += of_plane;
  return energy;
}

double Statics::respond_plane(std::int32_t k, const double* u, double* force,
                              const SpringTangents* tangents) const {
  const StaticGrid& grid = problem_.grid;
  RowBuffers buffer(grid, grid.sites[0]);
  SpringRow& springs = buffer.springs;
  double energy = 0;
  for (std::int32_t j = 0; j < grid.sites[1]; ++j) {
    const StaticRow& row =
        rows_[static_cast<std::size_t>(k) * static_cast<std::size_t>(grid.sites[1]) +
              static_cast<std::size_t>(j)];
    const std::int64_t first = grid.place(row.begin, j, k);
    const auto count = static_cast<std::size_t>(row.end - row.begin),
               padded = (count + lanes - 1) / lanes * lanes;
    for (std::size_t n = 0; n < grid.neighbours.size(); ++n) {
      const NeighbourGeometry& neighbour = grid.neighbours[n];
      const std::int64_t step = grid.step_to(neighbour.site);
      const std::size_t at =
          n * static_cast<std::size_t>(grid.places) + static_cast<std::size_t>(first);
      const float* weight = weight_.data() + at;
      if (std::all_of(weight, weight + count, [](float w) { return w == 0; })) {
        if (tangents != nullptr) no_tangents(at, count, *tangents);
        continue;
      }
      for (std::size_t t = 0; t < padded; ++t) {
        buffer.weight[t] = t < count ? static_cast<double>(weight[t]) : 0.0;
        const auto kind = [&](std::int64_t place) {
          return buffer.weight[t] == 0 || kind_.empty()
                     ? 0
                     : kind_[static_cast<std::size_t>(place) + t];
        };
        const SpringConstants& constants =
            model_.spring_to(static_cast<std::uint32_t>(n), kind(first), kind(first + step));
        buffer.stiffness[t] = constants.stiffness;
        buffer.cross_stiffness[t] = constants.cross_stiffness;
      }
      springs.count = static_cast<int>(count);
      springs.rest = neighbour.rest;
      springs.rest_length = neighbour.rest_length;
      springs.cross_rest_length = neighbour.cross_rest_length;
      for (int c = 0; c < grid.components; ++c) {
        springs.here[c] = u + c * grid.places + first;
        springs.there[c] = springs.here[c] + step;
      }
      energy += linearise_springs(model_, springs);
      add_forces(buffer, grid, grid.places, step, force + first);
      if (tangents != nullptr) keep_tangents(buffer, grid.components == 4, at, *tangents);
    }
  }
  return energy;
}

/// Adds the forces of the alpha springs, of length Delta + 2 h, on the heights; returns their
/// energy, J.
double Statics::hold_heights(const double* u, double* force) const {
  if (problem_.grid.components != 4) return 0;
  const std::int64_t heights = 3 * problem_.grid.places;
  double energy = 0;
  for_runs([&](std::int64_t first, Particle, std::uint64_t count) {
    for (std::int64_t p = first; p < first + static_cast<std::int64_t>(count); ++p) {
      const auto place = static_cast<std::size_t>(p);
      const double alpha = model_.alphas[kind_.empty() ? 0 : kind_[place]] *
                           static_cast<double>(particle_weight_[place]);
      force[heights + p] -= 2 * alpha * u[heights + p];
      energy += alpha * u[heights + p] * u[heights + p];
    }
  });
  return energy;
}

void Statics::fill_alpha(const SpringTangents& tangents) const {
  for (std::size_t place = 0; place < particle_weight_.size(); ++place)
    tangents.alpha[place] = static_cast<float>(2 * model_.alphas[kind_.empty() ? 0 : kind_[place]] *
                                               static_cast<double>(particle_weight_[place]));
}

}  // namespace hyperlattice
