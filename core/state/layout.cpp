#include <model/spring_calls.hpp>
#include <state/grid_layout.hpp>
#include <state/listed_layout.hpp>

#include <algorithm>
#include <array>

namespace hyperlattice {

std::unique_ptr<Layout> make_layout(const Model& model, int threads) {
  if (model.body.is_listed()) return std::make_unique<ListedLayout>(model, threads);
  return std::make_unique<GridLayout>(model, threads);
}

bool Layout::starts_memory() const {
  return std::any_of(model_.springs.laws.begin(), model_.springs.laws.end(),
                     [](const Law& law) { return law.kernels.start != nullptr; });
}

std::int32_t Layout::law_between(const Materials& materials) const {
  std::int32_t law = -1;
  for (std::size_t m = 0; m < model_.materials.size(); ++m) {
    if (!materials[m]) continue;
    const auto own = static_cast<std::int32_t>(model_.materials[m].law);
    if (law >= 0 && law != own) return -1;
    law = own;
  }
  const bool one_spring =
      materials.count() <= 1 || model_.springs.laws[static_cast<std::size_t>(law)].kernels.linear;
  return one_spring ? law : -1;
}

void Layout::start_memory(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                          std::int32_t site, Particle a, Particle b, std::uint32_t index) const {
  const SpringProperties properties = model_.spring_properties(a, b, index);
  if (model_.body.is_listed()) {
    a = model_.body.listed.source[a];
    b = model_.body.listed.source[b];
  }
  const SpringIdentity identity{std::min(a, b), std::max(a, b)};
  for (std::size_t cross = 0; cross < kept_numbers() / model_.springs.memory; ++cross) {
    std::array<double, max_spring_memory> kept{};
    start_memory_of(model_, properties, cross, identity, kept.data());
    const Memory memory = this->memory(block, row, neighbour, site, cross != 0);
    for (std::uint32_t n = 0; n < model_.springs.memory; ++n)
      memory.first[n * memory.stride] = kept[n];
  }
}

}  // namespace hyperlattice
