#include <state/force_sums.hpp>

#include <algorithm>

namespace hyperlattice {

ForcesId ForceSums::add(Followed followed) {
  all_.push_back(std::move(followed));
  return {static_cast<std::uint32_t>(all_.size() - 1)};
}

ForcesId ForceSums::follow(const PlaneSection& section) {
  return add(SectionForces(blocks_, clock_, pressures_, damage_, section));
}
ForcesId ForceSums::follow(std::size_t load) {
  return add(ExternalForces(blocks_, clock_, loads_, load));
}
ForcesId ForceSums::follow(std::span<const Particle> particles) {
  return add(ExternalForces(blocks_, clock_, loads_, particles));
}

void ForceSums::measure() {
  if (std::any_of(all_.begin(), all_.end(), [](const Followed& followed) {
        return std::holds_alternative<ExternalForces>(followed);
      }))
    sweeps_.measure(Sweep::present(clock_.last_step()));
  else if (std::any_of(all_.begin(), all_.end(), [](const Followed& followed) {
             const auto* section = std::get_if<SectionForces>(&followed);
             return section != nullptr && section->asks_pressures();
           }))
    pressures_.update();  // a measurement does this too
}

Resultant ForceSums::sum(ForcesId forces, Vec3 about) const {
  return std::visit([&](const auto& followed) { return followed.sum(about); }, all_[forces.index]);
}

}  // namespace hyperlattice
