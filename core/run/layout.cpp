#include <run/grid_layout.hpp>
#include <run/listed_layout.hpp>

namespace hyperlattice {

std::unique_ptr<Layout> make_layout(const Model& model, int threads) {
  if (model.body.is_listed()) return std::make_unique<ListedLayout>(model, threads);
  return std::make_unique<GridLayout>(model, threads);
}

}  // namespace hyperlattice
