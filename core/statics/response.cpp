// Forces, energy and tangents of all springs and cells; of springs from the material's own kernels;
// on a grid by rows and neighbours. The springs of a plane act on it and on planes after it. Planes
// that share none of these are computed in parallel, so that sums have the same order for any
// number of threads.
#include <base/thread_errors.hpp>
#include <model/law.hpp>
#include <statics/spring_rows.hpp>
#include <statics/statics.hpp>

#include <algorithm>
#include <array>
#include <cmath>

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
  const double of_heights = hold_heights(u, force);
  if (moves()) {
    add_inertia(u, force);
    add_answers(step_->factor, mean_motion(u), force);
  }
  if (tangents != nullptr && tangents->own != nullptr) fill_own(*tangents);
  return energy + of_heights + (soft_.empty() ? 0 : respond_soft(u, force, tangents));
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
        const SpringConstants& constants = constants_of(n, first, step, t, buffer.weight[t] != 0);
        buffer.stiffness[t] = constants.stiffness;
        buffer.cross_stiffness[t] = constants.cross_stiffness;
      }
      springs.count = static_cast<int>(count);
      springs.rest = neighbour.rest;
      springs.rest_length = neighbour.rest_length;
      springs.cross_rest_length = neighbour.cross_rest_length;
      place_row(u, first, step, springs);
      energy += linearise_row(n, row.begin, j, k, buffer);
      add_forces(buffer, grid, grid.places, step, force + first);
      if (tangents != nullptr) keep_tangents(buffer, grid.components == 4, at, *tangents);
    }
    if (grid.cells) energy += respond_cells(first, count, u, force, tangents);
  }
  return energy;
}

/// Linearises the springs of a row, in runs of springs of one law and of one set of constants.
/// Returns their energy, J.
double Statics::linearise_row(std::size_t neighbour, std::int32_t begin, std::int32_t j,
                              std::int32_t k, RowBuffers& buffer) const {
  const StaticGrid& grid = problem_.grid;
  const std::int64_t first = grid.place(begin, j, k),
                     step = grid.step_to(grid.neighbours[neighbour].site);
  const auto count = static_cast<std::size_t>(buffer.springs.count);
  const auto constants = [&](std::size_t t) -> const SpringConstants& {
    return constants_of(neighbour, first, step, t, buffer.weight[t] != 0);
  };
  const auto memory = [&](std::size_t t) {
    LawMemory found;
    if (model_.springs.memory == 0) return found;
    const Site low = model_.body.low;
    const Particle particle =
        model_.body.at({begin + static_cast<std::int32_t>(t) + low.i, j + low.j, k + low.k});
    for (const bool cross : {false, true})
      if (!cross || model_.springs.choice.membrane != KernelChoice::Membrane::none)
        found[cross ? 1 : 0] =
            simulation_.law_memory(particle, static_cast<std::uint32_t>(neighbour), cross);
    return found;
  };
  const auto material = [&](std::size_t t) {
    const std::uint32_t kind =
        kind_.empty() || buffer.weight[t] == 0 ? 0 : kind_[static_cast<std::size_t>(first) + t];
    return model_.kinds.mixtures.empty()
               ? static_cast<std::uint8_t>(kind)
               : model_.kinds.mixtures.material_of_spring(kind, grid.neighbours[neighbour].site);
  };
  const bool alike = model_.springs.laws.size() == 1 && model_.springs.composites.empty() &&
                     (model_.materials.size() == 1 || model_.springs.kernels().linear);
  if (alike) return linearise({constants(0), 0, 0, memory(0)}, buffer);
  double energy = 0;
  RowBuffers part(grid, grid.sites[0]);
  for (std::size_t start = 0, end; start < count; start = end) {
    const SpringConstants& own = constants(start);
    const bool composite = model_.springs.composite(own) != nullptr;
    end = start + 1;
    while (!composite && end < count && &constants(end) == &own) ++end;
    copy_row(buffer, start, end - start, grid.components, part);
    energy += linearise({own, material(start), own.stiffness, memory(start)}, part);
    keep_results(part, start, buffer);
  }
  return energy;
}

/// Linearises springs with the same constants; a composite spring alone. Returns their energy, J.
double Statics::linearise(const AlikeSprings& alike, RowBuffers& buffer) const {
  SpringRow& row = buffer.springs;
  const CompositeSpring* composite = model_.springs.composite(alike.constants);
  if (composite != nullptr) return linearise_composite(*composite, alike, buffer);
  for (std::size_t cross = 0; cross < 2; ++cross) {
    row.law[cross] = alike.constants.law[cross];
    row.memory[cross] = alike.memory[cross].first;
    if (row.memory[cross] != nullptr) row.memory_stride = alike.memory[cross].stride;
  }
  return linearise_springs(model_.springs.laws[model_.materials[alike.material].law], row);
}

double Statics::linearise_composite(const CompositeSpring& composite, const AlikeSprings& alike,
                                    RowBuffers& buffer) const {
  const std::size_t kinds = model_.springs.choice.membrane == KernelChoice::Membrane::none ? 1 : 2;
  return linearise_one(
      buffer, kinds, [&](std::size_t cross, double rest_length, const StepElongations& at) {
        const CompositeSpring::Spring spring{cross, alike.stiffness / alike.constants.stiffness,
                                             rest_length, at.mean};
        std::array<double, max_spring_memory> kept{};
        const Layout::Memory& memory = alike.memory[cross];
        for (std::uint32_t n = 0; n < model_.springs.memory; ++n)
          kept[n] = memory.first[n * memory.stride];
        const double time_step = buffer.springs.time_step,
                     tangent = composite.tangent(spring, time_step, kept.data());
        const CompositeAnswer answer = composite.take(spring, time_step, kept.data());
        return LinearisedSpring{answer.force, tangent, answer.stored};
      });
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
      const double alpha = model_.kinds.alphas[kind_.empty() ? 0 : kind_[place]] *
                           static_cast<double>(particle_weight_[place]);
      force[heights + p] -= 2 * alpha * u[heights + p];
      energy += alpha * u[heights + p] * u[heights + p];
    }
  });
  return energy;
}

void Statics::fill_own(const SpringTangents& tangents) const {
  const auto places = static_cast<std::size_t>(problem_.grid.places);
  std::fill_n(tangents.own, problem_.grid.numbers(), static_cast<float>(hold_));
  for (std::size_t place = 0; problem_.grid.components == 4 && place < particle_weight_.size();
       ++place)
    tangents.own[3 * places + place] +=
        static_cast<float>(2 * model_.kinds.alphas[kind_.empty() ? 0 : kind_[place]] *
                           static_cast<double>(particle_weight_[place]));
  if (!moves()) return;
  const double factor = step_->inertia();
  for_numbers([&](std::size_t n, std::size_t place, int, bool) {
    tangents.own[n] += static_cast<float>(factor * mass_[place]);
  });
  // Loads give bounds of their tangents. Those of particles that they do not push now are left out.
  for (std::size_t l = 0; l < watching_.size(); ++l)
    for (std::size_t n = 0; n < watching_[l].places.size(); ++n) {
      if (watching_[l].answers[n] == Vec3{}) continue;
      const LoadStiffnessBound& bound = model_.loads[l].watched[n].reaction;
      const double stiffness =
          bound.stiffness + bound.viscosity / (step_->of.forward * step_->of.length);
      for (std::size_t c = 0; c < 3; ++c)
        tangents.own[c * places + static_cast<std::size_t>(watching_[l].places[n])] +=
            static_cast<float>(stiffness);
    }
}

}  // namespace hyperlattice
