// Buffers for rows of springs that the material's kernel evaluates, and the use of its results.
#pragma once

#include <model/spring_calls.hpp>

#include <hyperlattice/statics.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace hyperlattice {

/// Numbers of one row of springs to one neighbour.
struct RowBuffers {
  std::vector<double> stiffness, cross_stiffness, weight, pull, axial, cross_pull, cross_axial;
  SpringRow springs;

  /// Allocates the buffers for up to `most` springs.
  RowBuffers(const StaticGrid& grid, int most) {
    const std::size_t width = static_cast<std::size_t>(most + lanes - 1) / lanes * lanes;
    for (auto* buffer :
         {&stiffness, &cross_stiffness, &weight, &pull, &axial, &cross_pull, &cross_axial})
      buffer->assign(width, 0);
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

/// Copies `count` springs of a row, from `start` on, into a row of their own.
inline void copy_row(const RowBuffers& from, std::size_t start, std::size_t count, int components,
                     RowBuffers& to) {
  std::fill(to.weight.begin(), to.weight.end(), 0.0);
  for (std::size_t t = 0; t < count; ++t) {
    to.weight[t] = from.weight[start + t];
    to.stiffness[t] = from.stiffness[start + t];
    to.cross_stiffness[t] = from.cross_stiffness[start + t];
  }
  to.springs.count = static_cast<int>(count);
  to.springs.rest = from.springs.rest;
  to.springs.rest_length = from.springs.rest_length;
  to.springs.cross_rest_length = from.springs.cross_rest_length;
  for (int c = 0; c < components; ++c) {
    to.springs.here[c] = from.springs.here[c] + start;
    to.springs.there[c] = from.springs.there[c] + start;
    if (from.springs.here_before[c] == nullptr) continue;
    to.springs.here_before[c] = from.springs.here_before[c] + start;
    to.springs.there_before[c] = from.springs.there_before[c] + start;
  }
  to.springs.forward = from.springs.forward;
  to.springs.time_step = from.springs.time_step;
}

/// Writes the results of such a row into the whole row.
inline void keep_results(const RowBuffers& from, std::size_t start, RowBuffers& to) {
  for (std::size_t t = 0; t < static_cast<std::size_t>(from.springs.count); ++t) {
    to.pull[start + t] = from.pull[t];
    to.axial[start + t] = from.axial[t];
    to.cross_pull[start + t] = from.cross_pull[t];
    to.cross_axial[start + t] = from.cross_axial[t];
  }
}

/// Adds the forces of a row of springs to both of their ends. `force` points to the row's first
/// place; the other ends are `step` places on, the next component is `places` on.
inline void add_forces(const RowBuffers& row, const StaticGrid& grid, std::int64_t places,
                       std::int64_t step, double* force) {
  const SpringRow& springs = row.springs;
  const double rest[3] = {springs.rest.x, springs.rest.y, springs.rest.z};
  for (int c = 0; c < 3; ++c) {
    double *own = force + c * places, *other = own + step;
    for (std::int64_t t = 0; t < springs.count; ++t) {
      const auto s = static_cast<std::size_t>(t);
      const double f = (row.pull[s] + row.cross_pull[s]) *
                       (rest[c] + (springs.there[c][t] - springs.here[c][t]));
      own[t] += f;
      other[t] -= f;
    }
  }
  if (grid.components < 4) return;
  double *own = force + 3 * places, *other = own + step;
  for (std::int64_t t = 0; t < springs.count; ++t) {
    const auto s = static_cast<std::size_t>(t);
    const double along = row.pull[s] * (springs.there[3][t] - springs.here[3][t]);
    const double both =
        row.cross_pull[s] * (grid.membrane_distance + springs.there[3][t] + springs.here[3][t]);
    own[t] += along - both;
    other[t] -= along + both;
  }
}

/// Writes a row's tangents from place `at` on.
inline void keep_tangents(const RowBuffers& row, bool has_heights, std::size_t at,
                          const SpringTangents& tangents) {
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

/// The answer of a spring to its elongation.
struct LinearisedSpring {
  double force = 0, tangent = 0, stored = 0;  ///< N, N/m and J
};

/// The ends of the one spring of a row at one time: displacement of b less that of a, and heights.
inline SpringMotion motion_of_one(const double* const* here, const double* const* there) {
  const auto apart = [&](int c) { return here[c] == nullptr ? 0 : there[c][0] - here[c][0]; };
  const bool has_heights = here[3] != nullptr;
  return {
      {apart(0), apart(1), apart(2)}, has_heights ? here[3][0] : 0, has_heights ? there[3][0] : 0};
}

/// Elongations of a spring, m: at the start and the end of a step in time, and between them where
/// the forces of the step lie. All are the same at rest.
struct StepElongations {
  double start = 0, mean = 0, end = 0;
};

/// Linearises the one spring of a row and, with `kinds` = 2, its cross spring, whose answers are
/// answer(cross, rest length, elongations). Returns their energy, J.
template <class Answer>
double linearise_one(RowBuffers& buffer, std::size_t kinds, const Answer& answer) {
  const SpringRow& row = buffer.springs;
  const SpringMotion mean = motion_of_one(row.here, row.there);
  SpringProperties spring;
  spring.rest = row.rest;
  spring.rest_length = row.rest_length;
  spring.cross_rest_length = row.cross_rest_length;
  double energy = 0;
  for (std::size_t cross = 0; cross < kinds; ++cross) {
    const double rest_length = spring.rest_length_of(cross);
    const auto elongation_at = [&](const SpringMotion& at) {
      const double rise = cross == 0 ? at.height_b - at.height_a : at.height_b + at.height_a;
      return spring.elongation(cross, spring.growth(cross, at.apart, rise, row.membrane_distance));
    };
    StepElongations at;
    at.start = at.mean = at.end = elongation_at(mean);
    if (row.here_before[0] != nullptr) {  // as in kernels/tangent.hpp
      const SpringMotion before = motion_of_one(row.here_before, row.there_before);
      const auto after = [&](double from, double to) { return from + (to - from) / row.forward; };
      SpringMotion end{
          {}, after(before.height_a, mean.height_a), after(before.height_b, mean.height_b)};
      for (int c = 0; c < 3; ++c) end.apart[c] = after(before.apart[c], mean.apart[c]);
      at.start = elongation_at(before);
      at.end = elongation_at(end);
      at.mean = (1 - row.forward) * at.start + row.forward * at.end;
    }
    const double length = rest_length + at.mean;
    const LinearisedSpring found = answer(cross, rest_length, at);
    const double pull = found.force / length;
    (cross == 0 ? row.pull : row.cross_pull)[0] = row.weight[0] * pull;
    (cross == 0 ? row.axial : row.cross_axial)[0] =
        row.weight[0] * (found.tangent - pull) * row.spacing * row.spacing / (length * length);
    energy += row.weight[0] * found.stored;
  }
  return energy;
}

}  // namespace hyperlattice
