// Writes a series with writers.vtu, and the same numbers as plain binary dumps: positions,
// displacement, velocity, broken_open.
// Usage: vtu_readback FOLDER COMPRESS FILE REGION DEFORMED
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

}  // namespace

int main(int, char** arguments) {
  const std::string folder = arguments[1], compress = arguments[2], file = arguments[3],
                    region = arguments[4], deformed = arguments[5];
  // The arrays have more than one compressed block, and not a whole number of them.
  FakeBody body({31, 29, 37});
  Plugin writer("writers.vtu", {{"compress", compress == "true"},
                                {"file", file},
                                {"region", region},
                                {"deformed", deformed == "true"},
                                {"fields", {"displacement", "broken_open", "velocity"}}});
  writer.begin(body.context(folder));
  std::vector<Particle> particles = body.some();
  if (region == "all") {
    particles.clear();
    for (Particle n = 0; n < body.positions().size() / 3; ++n) particles.push_back(n);
  }
  int number = 0;
  for (const double time : {0.0, 1.0 / 3 * 1e-6, 2e-6}) {
    writer.frame(body.at(time));
    const std::string base = folder + "/" + file + std::to_string(number++);
    std::vector<double> points = body.positions();
    if (deformed == "true")
      for (std::size_t n = 0; n < points.size(); ++n) points[n] += body.displacements[n];
    dump(base + ".points", points, particles, 3);
    dump(base + ".displacement", body.displacements, particles, 3);
    dump(base + ".velocity", body.velocities, particles, 3);
    dump(base + ".broken_open", body.open, particles, 1);
    std::ofstream(base + ".time", std::ios::binary)
        .write(reinterpret_cast<const char*>(&time), sizeof time);
  }
  writer.end();
}
