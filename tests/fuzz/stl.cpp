// STL files, text or binary: reading, the checks of a solid, points and cubes in it.
#include "target.hpp"

#include <geometry/triangle_mesh.hpp>

using namespace hyperlattice;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::read_or_refuse<std::runtime_error>([&] {
    TriangleMesh mesh = read_stl(fuzz::text_of(data, size), 1e-3);
    if (!solid_fault(mesh).empty() && !sections_are_solids(mesh)) return;
    const SurfaceAreas areas = surface_areas(mesh);
    fuzz::require(areas.outer >= 0 && areas.inner >= 0);
    const InsideTest inside(std::move(mesh));
    if (!orientation_fault(inside).empty()) return;
    const Vec3 low = inside.low(), width = inside.high() - low;
    for (const double at : {-0.1, 0.0, 0.3, 1.0}) {
      inside(low + at * width);
      const Cube cube{low + at * width, 0.3 * width.x};
      inside.side_of(cube);
      inside.volume_in(cube);
      inside.planes_in(cube, 100);
    }
  });
  return 0;
}
