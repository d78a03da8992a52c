// Strains of springs below which no stress reaches a strength surface.
#pragma once

#include <hyperlattice/lattice.hpp>
#include <hyperlattice/material.hpp>
#include <hyperlattice/strength_surface.hpp>

#include <functional>
#include <span>

namespace hyperlattice {

/// Strains: a stress whose springs are stretched by less than `stretch` and shortened by less than
/// `shortening` is below the surface. Infinite shortening: any.
struct SurfaceAlarm {
  double stretch = 0, shortening = 0;
};

/// Writes the ratio of each stress to the surface.
using SurfaceRatios = std::function<void(std::span<const PrincipalStress>, double*)>;

/// Returns the alarm of a convex surface on a lattice with these springs and elastic constants.
SurfaceAlarm surface_alarm(std::span<const NeighbourGeometry> springs,
                           const ElasticConstants& constants, const SurfaceRatios& ratios);

}  // namespace hyperlattice
