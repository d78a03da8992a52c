#include <state/present_volumes.hpp>

namespace hyperlattice {

PresentVolumes::PresentVolumes(const NodalVolumes& volumes, std::vector<Vec3> moved,
                               std::span<const Breakage> breakages)
    : volumes_(volumes), now_(volumes.state()) {
  now_.moved = std::move(moved);
  for (const Breakage& broken : breakages)
    volumes.for_ended_by(broken.a, broken.b,
                         [this](std::uint32_t particle) { now_.ended[particle] = 1; });
  volumes.evaluate(now_, [](std::size_t size, const auto& work) {
    for (std::size_t n = 0; n < size; ++n) work(n);
  });
}

double PresentVolumes::stiffness(std::size_t particle) const {
  if (now_.ended[particle] != 0 || volumes_.modulus(particle) == 0) return 0;
  return volumes_.response(particle, now_.growths).stiffness / volumes_.rest_volume(particle);
}

}  // namespace hyperlattice
