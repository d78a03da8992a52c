// Draws particles as lit cubes or spheres.
#pragma once

#include "camera.hpp"
#include "image.hpp"

#include <cstdint>

namespace hyperlattice::picture {

enum class Form : std::uint32_t { cubes, spheres };

struct Particles {
  std::span<const double> positions;  ///< x y z of each, metres
  std::span<const Colour> colours;    ///< one each
  double size = 0;                    ///< edge or diameter, metres
  Form form = Form::cubes;
};

void render(const Particles& particles, const Camera& camera, Image& image);

}  // namespace hyperlattice::picture
