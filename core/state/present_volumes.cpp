#include <state/present_volumes.hpp>

namespace hyperlattice {

PresentVolumes::PresentVolumes(const NodalVolumes& volumes, std::vector<Vec3> moved,
                               std::span<const Breakage> breakages)
    : volumes_(volumes),
      moved_(std::move(moved)),
      pressures_(moved_.size()),
      energies_(moved_.size()) {
  std::vector<std::uint8_t> ended(moved_.size());
  for (const Breakage& broken : breakages)
    volumes.for_corners_at_edge(static_cast<std::uint32_t>(broken.a),
                                static_cast<std::uint32_t>(broken.b),
                                [&](std::uint32_t corner) { ended[corner] = 1; });
  std::vector<double> growths(volumes.tetrahedra().size());
  for (std::size_t n = 0; n < growths.size(); ++n) growths[n] = volumes.growth(n, moved_);
  for (std::size_t p = 0; p < moved_.size(); ++p) {
    if (ended[p] != 0) continue;
    const NodalVolumes::Response response = volumes.response(p, growths);
    pressures_[p] = response.pressure;
    energies_[p] = response.energy;
  }
}

}  // namespace hyperlattice
