#include <equilibrium/spring_multigrid.hpp>

namespace hyperlattice::equilibrium {

namespace {

constexpr std::int64_t few_sites = 300;  // largest level that is factorised

}  // namespace

void SpringMultigrid::build() {
  cycle_.reset();
  coarse_.clear();
  std::vector<TrilinearTransfer> transfers;
  const auto sites = [](const GridLevel& level) {
    return level.layout().sites[0] * level.layout().sites[1] * level.layout().sites[2];
  };
  do {
    TrilinearTransfer transfer(at(coarse_.size()).layout().sites);
    if (!coarse_.empty() && !transfer.coarsens()) break;
    auto next = coarse_.empty() ? coarsen(finest_, transfer) : coarsen(*coarse_.back(), transfer);
    transfers.push_back(transfer);
    coarse_.push_back(std::move(next));
  } while (sites(*coarse_.back()) > few_sites);
  coarsest_ = std::make_unique<Coarsest>(*coarse_.back());
  std::vector<const GridLevel*> all;
  for (std::size_t level = 0; level < levels(); ++level) all.push_back(&at(level));
  cycle_.emplace(std::move(all), std::move(transfers),
                 [this](const double* b, double* x) { coarsest_->solve(b, x); });
}

}  // namespace hyperlattice::equilibrium
