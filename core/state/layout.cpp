#include <model/kernel_calls.hpp>
#include <state/grid_layout.hpp>
#include <state/listed_layout.hpp>

#include <algorithm>

namespace hyperlattice {

std::unique_ptr<Layout> make_layout(const Model& model, int threads) {
  if (model.body.is_listed()) return std::make_unique<ListedLayout>(model, threads);
  return std::make_unique<GridLayout>(model, threads);
}

void Layout::start_memory(const Block& block, std::uint32_t row, std::uint32_t neighbour,
                          std::int32_t site, Particle a, Particle b, std::uint32_t index) const {
  const SpringProperties properties = model_.spring_properties(a, b, index);
  if (model_.body.is_listed()) {
    a = model_.body.listed.source[a];
    b = model_.body.listed.source[b];
  }
  for (std::size_t cross = 0; cross < kept_numbers() / model_.kernels.memory; ++cross) {
    double kept[max_law_memory + 2] = {};
    start_spring(model_, cross == 0 ? properties.law : properties.cross_law,
                 {std::min(a, b), std::max(a, b)}, kept);
    const Memory memory = this->memory(block, row, neighbour, site, cross != 0);
    for (std::uint32_t n = 0; n < model_.kernels.memory; ++n)
      memory.first[n * memory.stride] = kept[n];
  }
}

}  // namespace hyperlattice
