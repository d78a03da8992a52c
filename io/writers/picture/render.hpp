// Draws particles as cubes or spheres with light and shade.
#pragma once

#include "image.hpp"

#include <picture/camera.hpp>

#include <cstdint>

namespace hyperlattice::picture {

enum class Form : std::uint32_t { cubes, spheres };

struct Particles {
  std::span<const double> positions;  ///< x y z of each particle, m
  std::span<const Colour> colours;    ///< one for each particle
  double size = 0;                    ///< edge or diameter, m
  Form form = Form::cubes;
};

/// Draws the particles as the camera sees them; pixels without a particle become white.
void render(const Particles& particles, const Camera& camera, Image& image);

/// Returns the bytes that render() allocates for a picture of so many pixels and particles.
double render_bytes(double pixels, double particles);

}  // namespace hyperlattice::picture
