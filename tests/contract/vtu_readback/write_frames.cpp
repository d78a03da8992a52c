// Writes a series with writers.vtu, and the same numbers as plain binary dumps: positions,
// displacement, velocity, broken_open, material.
// Usage: vtu_readback FOLDER CODEC PRECISION FILE REGION DEFORMED
#include <support/output.hpp>

using namespace hyperlattice;
using namespace hyperlattice::test;

namespace {

void dump(const std::string& path, const std::vector<double>& values,
          const std::vector<Particle>& particles, std::size_t components) {
  std::ofstream out(path, std::ios::binary);
  for (const Particle particle : particles)
    out.write(reinterpret_cast<const char*>(&values[particle * components]),
              static_cast<std::streamsize>(components * sizeof(double)));
}

std::vector<double> materials;
bool (*other_field)(void* self, std::string_view name, Field& field) noexcept = nullptr;

/// Adds the field "material" to the fields of the body.
Snapshot with_materials(Snapshot snapshot) {
  other_field = snapshot.get_field;
  snapshot.get_field = [](void* self, std::string_view name, Field& field) noexcept {
    if (name != "material") return other_field(self, name, field);
    field = {1, materials};
    return true;
  };
  return snapshot;
}

}  // namespace

int main(int, char** arguments) {
  const std::string folder = arguments[1], codec = arguments[2], precision = arguments[3],
                    file = arguments[4], region = arguments[5], deformed = arguments[6];
  // The arrays have more than one compressed block, and not a whole number of them.
  FakeBody body({31, 29, 37});
  Plugin writer("writers.vtu",
                {{"codec", codec},
                 {"precision", precision},
                 {"file", file},
                 {"region", region},
                 {"deformed", deformed == "true"},
                 {"fields", {"displacement", "broken_open", "velocity", "material"}}});
  writer.begin(body.context(folder));
  for (std::size_t n = 0; n < body.positions().size() / 3; ++n)
    materials.push_back(static_cast<double>(n % 3));
  std::vector<Particle> particles = body.some();
  if (region == "all") {
    particles.clear();
    for (Particle n = 0; n < body.positions().size() / 3; ++n) particles.push_back(n);
  }
  int number = 0;
  for (const double time : {0.0, 1.0 / 3 * 1e-6, 2e-6}) {
    writer.frame(with_materials(body.at(time)));
    const std::string base = folder + "/" + file + std::to_string(number++);
    std::vector<double> points = body.positions();
    if (deformed == "true")
      for (std::size_t n = 0; n < points.size(); ++n) points[n] += body.displacements[n];
    dump(base + ".points", points, particles, 3);
    dump(base + ".displacement", body.displacements, particles, 3);
    dump(base + ".velocity", body.velocities, particles, 3);
    dump(base + ".broken_open", body.open, particles, 1);
    dump(base + ".material", materials, particles, 1);
    std::ofstream(base + ".time", std::ios::binary)
        .write(reinterpret_cast<const char*>(&time), sizeof time);
  }
  writer.end();
}
