#include <run/failing_motion.hpp>
#include <run/table.hpp>

#include <hyperlattice/files.hpp>

#include <algorithm>

namespace hyperlattice {

void write_failing_motion(const std::filesystem::path& directory, const Body& body,
                          std::span<const double> motion, std::span<const double> heights) {
  double largest = 0;
  const auto of = [&](Particle p) {
    return Vec3{motion[3 * p], motion[3 * p + 1], motion[3 * p + 2]};
  };
  for (Particle p = 0; p < body.particles; ++p) largest = std::max(largest, norm(of(p)));
  for (const double height : heights) largest = std::max(largest, std::abs(height));
  if (!(largest > 0)) return;
  AtomicFile file((directory / failing_motion_file).string());
  std::string text = heights.empty() ? "x,y,z,motion_x,motion_y,motion_z\n"
                                     : "x,y,z,motion_x,motion_y,motion_z,motion_height\n";
  for (Particle p = 0; p < body.particles; ++p) {
    const Vec3 x = body.position(p), m = (1 / largest) * of(p);
    if (heights.empty())
      append_row(text, std::initializer_list<double>{x.x, x.y, x.z, m.x, m.y, m.z});
    else
      append_row(text,
                 std::initializer_list<double>{x.x, x.y, x.z, m.x, m.y, m.z, heights[p] / largest});
    if (text.size() < 65536 && p + 1 < body.particles) continue;
    file.write(text);
    text.clear();
  }
  file.commit();
}

}  // namespace hyperlattice
