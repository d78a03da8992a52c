#include <run/failing_motion.hpp>
#include <run/table.hpp>

#include <hyperlattice/files.hpp>

#include <algorithm>

namespace hyperlattice {

void write_failing_motion(const std::filesystem::path& directory, const Body& body, std::span<const double> motion) {
  double largest = 0;
  const auto of = [&](Particle p) { return Vec3{motion[3 * p], motion[3 * p + 1], motion[3 * p + 2]}; };
  for (Particle p = 0; p < body.particles; ++p) largest = std::max(largest, norm(of(p)));
  if (!(largest > 0)) return;
  AtomicFile file((directory / failing_motion_file).string());
  std::string text = "x,y,z,motion_x,motion_y,motion_z\n";
  for (Particle p = 0; p < body.particles; ++p) {
    const Vec3 x = body.position(p), m = (1 / largest) * of(p);
    append_row(text, std::initializer_list<double>{x.x, x.y, x.z, m.x, m.y, m.z});
    if (text.size() < 65536 && p + 1 < body.particles) continue;
    file.write(text);
    text.clear();
  }
  file.commit();
}

}  // namespace hyperlattice
