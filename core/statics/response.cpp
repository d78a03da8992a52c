// Forces, energy and tangents of all springs, by the material's own kernels, a row and a neighbour at a time. A plane's springs pull at it and at
// planes after it: planes that share none are summed at once, so that sums have one order for any number of threads.
#include <statics/statics.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Numbers of one row of springs.
struct RowBuffers {
  std::vector<double> stiffness, cross_stiffness, weight, pull, axial, cross_pull, cross_axial;

  explicit RowBuffers(std::size_t width) {
    for (auto* buffer : {&stiffness, &cross_stiffness, &weight, &pull, &axial, &cross_pull, &cross_axial}) buffer->assign(width, 0);
  }
};

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
  const auto places = grid.places;
  const int components = grid.components;
  const bool has_cross = model_.choice.membrane != KernelChoice::Membrane::none, has_heights = components == 4;
  RowBuffers buffer(static_cast<std::size_t>((grid.sites[0] + lanes - 1) / lanes * lanes));
  SpringRow springs;
  springs.membrane_distance = grid.membrane_distance;
  springs.spacing = grid.spacing;
  springs.stiffness = buffer.stiffness.data();
  springs.cross_stiffness = buffer.cross_stiffness.data();
  springs.weight = buffer.weight.data();
  springs.pull = buffer.pull.data();
  springs.axial = buffer.axial.data();
  springs.cross_pull = buffer.cross_pull.data();
  springs.cross_axial = buffer.cross_axial.data();

  double energy = 0;
  for (std::int32_t j = 0; j < grid.sites[1]; ++j) {
    const StaticRow& row = rows_[static_cast<std::size_t>(k) * static_cast<std::size_t>(grid.sites[1]) + static_cast<std::size_t>(j)];
    const std::int64_t first = grid.place(row.begin, j, k);
    const auto count = static_cast<std::size_t>(row.end - row.begin), padded = (count + lanes - 1) / lanes * lanes;
    for (std::size_t n = 0; n < grid.neighbours.size(); ++n) {
      const NeighbourGeometry& neighbour = grid.neighbours[n];
      const std::int64_t step = grid.step_to(neighbour.site), at = static_cast<std::int64_t>(n) * places + first;
      const float* weight = weight_.data() + at;
      if (std::all_of(weight, weight + count, [](float w) { return w == 0; })) {
        if (tangents != nullptr)
          for (float* values : {tangents->axial, tangents->pull, tangents->cross_axial, tangents->cross_pull})
            if (values != nullptr) std::fill_n(values + at, count, 0.0f);
        continue;
      }
      for (std::size_t t = 0; t < padded; ++t) {
        buffer.weight[t] = t < count ? static_cast<double>(weight[t]) : 0.0;
        const bool exists = buffer.weight[t] != 0;
        const std::uint8_t a = !exists || material_.empty() ? std::uint8_t{0} : material_[static_cast<std::size_t>(first) + t];
        const std::uint8_t b =
            !exists || material_.empty() ? std::uint8_t{0} : material_[static_cast<std::size_t>(first + step + static_cast<std::int64_t>(t))];
        const SpringConstants& constants = model_.spring(a, b, neighbour.site.spring_class);
        buffer.stiffness[t] = constants.stiffness;
        buffer.cross_stiffness[t] = constants.cross_stiffness;
      }
      springs.count = static_cast<int>(count);
      springs.rest = neighbour.rest;
      springs.rest_length = neighbour.rest_length;
      springs.cross_rest_length = neighbour.cross_rest_length;
      for (int c = 0; c < components; ++c) {
        springs.here[c] = u + c * places + first;
        springs.there[c] = springs.here[c] + step;
      }
      energy += model_.kernels.linearise(springs);

      const auto number = static_cast<std::int64_t>(count);
      const double rest[3] = {neighbour.rest.x, neighbour.rest.y, neighbour.rest.z};
      for (int c = 0; c < 3; ++c) {
        double *own = force + c * places + first, *other = own + step;
        for (std::int64_t t = 0; t < number; ++t) {
          const auto s = static_cast<std::size_t>(t);
          const double pull = buffer.pull[s] + (has_cross ? buffer.cross_pull[s] : 0.0);
          const double f = pull * (rest[c] + (springs.there[c][t] - springs.here[c][t]));
          own[t] += f;
          other[t] -= f;
        }
      }
      if (has_heights) {
        double *own = force + 3 * places + first, *other = own + step;
        for (std::int64_t t = 0; t < number; ++t) {
          const auto s = static_cast<std::size_t>(t);
          const double along = buffer.pull[s] * (springs.there[3][t] - springs.here[3][t]);
          const double both = buffer.cross_pull[s] * (grid.membrane_distance + springs.there[3][t] + springs.here[3][t]);
          own[t] += along - both;
          other[t] -= along + both;
        }
      }
      if (tangents == nullptr) continue;
      for (std::size_t t = 0; t < count; ++t) {
        const std::size_t to = static_cast<std::size_t>(at) + t;
        const bool joined = has_cross && !has_heights;
        tangents->axial[to] = static_cast<float>(buffer.axial[t] + (joined ? buffer.cross_axial[t] : 0.0));
        tangents->pull[to] = static_cast<float>(buffer.pull[t] + (joined ? buffer.cross_pull[t] : 0.0));
        if (!has_heights) continue;
        tangents->cross_axial[to] = static_cast<float>(buffer.cross_axial[t]);
        tangents->cross_pull[to] = static_cast<float>(buffer.cross_pull[t]);
      }
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
