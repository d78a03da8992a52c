// Forces, energy and tangents of all springs, by the material's own kernels, a row and a neighbour at a time. A plane's springs pull at it and at
// planes after it: planes that share none are summed at once, so that sums have one order for any number of threads.
#include <statics/statics.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Numbers of one row of springs to one neighbour.
struct RowBuffers {
  std::vector<double> stiffness, cross_stiffness, weight, pull, axial, cross_pull, cross_axial;
  SpringRow springs;

  explicit RowBuffers(const StaticGrid& grid) {
    const std::size_t width = static_cast<std::size_t>(grid.sites[0] + lanes - 1) / lanes * lanes;
    for (auto* buffer : {&stiffness, &cross_stiffness, &weight, &pull, &axial, &cross_pull, &cross_axial}) buffer->assign(width, 0);
    springs.membrane_distance = grid.membrane_distance;
    springs.spacing = grid.spacing;
    springs.stiffness = stiffness.data();
    springs.cross_stiffness = cross_stiffness.data();
    springs.weight = weight.data();
    springs.pull = pull.data();
    springs.axial = axial.data();
    springs.cross_pull = cross_pull.data();
    springs.cross_axial = cross_axial.data();
  }
};

/// Adds what a row of springs pulls at both of its ends; `force` is at the row's first place, the other ends `step` places on.
void add_forces(const RowBuffers& row, const StaticGrid& grid, std::int64_t step, double* force) {
  const SpringRow& springs = row.springs;
  const double rest[3] = {springs.rest.x, springs.rest.y, springs.rest.z};
  for (int c = 0; c < 3; ++c) {
    double *own = force + c * grid.places, *other = own + step;
    for (std::int64_t t = 0; t < springs.count; ++t) {
      const auto s = static_cast<std::size_t>(t);
      const double f = (row.pull[s] + row.cross_pull[s]) * (rest[c] + (springs.there[c][t] - springs.here[c][t]));
      own[t] += f;
      other[t] -= f;
    }
  }
  if (grid.components < 4) return;
  double *own = force + 3 * grid.places, *other = own + step;
  for (std::int64_t t = 0; t < springs.count; ++t) {
    const auto s = static_cast<std::size_t>(t);
    const double along = row.pull[s] * (springs.there[3][t] - springs.here[3][t]);
    const double both = row.cross_pull[s] * (grid.membrane_distance + springs.there[3][t] + springs.here[3][t]);
    own[t] += along - both;
    other[t] -= along + both;
  }
}

/// Writes a row's tangents from place `at` on.
void keep_tangents(const RowBuffers& row, bool has_heights, std::size_t at, const SpringTangents& tangents) {
  for (std::size_t t = 0; t < static_cast<std::size_t>(row.springs.count); ++t) {
    if (has_heights) {
      tangents.axial[at + t] = static_cast<float>(row.axial[t]);
      tangents.pull[at + t] = static_cast<float>(row.pull[t]);
      tangents.cross_axial[at + t] = static_cast<float>(row.cross_axial[t]);
      tangents.cross_pull[at + t] = static_cast<float>(row.cross_pull[t]);
    } else {
      tangents.axial[at + t] = static_cast<float>(row.axial[t] + row.cross_axial[t]);
      tangents.pull[at + t] = static_cast<float>(row.pull[t] + row.cross_pull[t]);
    }
  }
}

void no_tangents(std::size_t at, std::size_t count, const SpringTangents& tangents) {
  for (float* values : {tangents.axial, tangents.pull, tangents.cross_axial, tangents.cross_pull})
    if (values != nullptr) std::fill_n(values + at, count, 0.0f);
}

}  // namespace

double Statics::respond(const double* u, double* force, const SpringTangents* tangents) const {
  const StaticGrid& grid = problem_.grid;
  std::fill_n(force, grid.numbers(), 0.0);
  const std::int32_t planes = grid.sites[2], colours = model_.body.reach + 1;
  std::vector<double> energies(static_cast<std::size_t>(planes), 0);
  for (std::int32_t colour = 0; colour < colours; ++colour) {
#pragma omp parallel for num_threads(grid.threads) schedule(static)
    for (std::int32_t k = colour; k < planes; k += colours) energies[static_cast<std::size_t>(k)] = respond_plane(k, u, force, tangents);
  }
  double energy = hold_heights(u, force);
  for (const double of_plane : energies) energy += of_plane;
  if (tangents != nullptr && grid.components == 4) fill_alpha(*tangents);
  return energy;
}

double Statics::respond_plane(std::int32_t k, const double* u, double* force, const SpringTangents* tangents) const {
  const StaticGrid& grid = problem_.grid;
  RowBuffers buffer(grid);
  SpringRow& springs = buffer.springs;
  double energy = 0;
  for (std::int32_t j = 0; j < grid.sites[1]; ++j) {
    const StaticRow& row = rows_[static_cast<std::size_t>(k) * static_cast<std::size_t>(grid.sites[1]) + static_cast<std::size_t>(j)];
    const std::int64_t first = grid.place(row.begin, j, k);
    const auto count = static_cast<std::size_t>(row.end - row.begin), padded = (count + lanes - 1) / lanes * lanes;
    for (std::size_t n = 0; n < grid.neighbours.size(); ++n) {
      const NeighbourGeometry& neighbour = grid.neighbours[n];
      const std::int64_t step = grid.step_to(neighbour.site);
      const std::size_t at = n * static_cast<std::size_t>(grid.places) + static_cast<std::size_t>(first);
      const float* weight = weight_.data() + at;
      if (std::all_of(weight, weight + count, [](float w) { return w == 0; })) {
        if (tangents != nullptr) no_tangents(at, count, *tangents);
        continue;
      }
      for (std::size_t t = 0; t < padded; ++t) {
        buffer.weight[t] = t < count ? static_cast<double>(weight[t]) : 0.0;
        const auto material = [&](std::int64_t place) {
          return buffer.weight[t] == 0 || material_.empty() ? std::uint8_t{0} : material_[static_cast<std::size_t>(place) + t];
        };
        const SpringConstants& constants = model_.spring(material(first), material(first + step), neighbour.site.spring_class);
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
      energy += model_.kernels.linearise(springs);
      add_forces(buffer, grid, step, force + first);
      if (tangents != nullptr) keep_tangents(buffer, grid.components == 4, at, *tangents);
    }
  }
  return energy;
}

/// Adds what the alpha springs, of length Delta + 2 h, pull at the heights; returns their energy.
double Statics::hold_heights(const double* u, double* force) const {
  if (problem_.grid.components != 4) return 0;
  const std::int64_t heights = 3 * problem_.grid.places;
  double energy = 0;
  for_runs([&](std::int64_t first, Particle, std::uint64_t count) {
    for (std::int64_t p = first; p < first + static_cast<std::int64_t>(count); ++p) {
      const auto place = static_cast<std::size_t>(p);
      const double alpha = stiffness_of_alpha_[material_.empty() ? 0 : material_[place]] * static_cast<double>(particle_weight_[place]);
      force[heights + p] -= 2 * alpha * u[heights + p];
      energy += alpha * u[heights + p] * u[heights + p];
    }
  });
  return energy;
}

void Statics::fill_alpha(const SpringTangents& tangents) const {
  for (std::size_t place = 0; place < particle_weight_.size(); ++place)
    tangents.alpha[place] =
        static_cast<float>(2 * stiffness_of_alpha_[material_.empty() ? 0 : material_[place]] * static_cast<double>(particle_weight_[place]));
}

}  // namespace hyperlattice
