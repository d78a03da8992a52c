#include <equilibrium/search_memory.hpp>

#include <stdexcept>

namespace hyperlattice::equilibrium {

void remember(const Newton& newton, std::vector<double>& all) {
  const Newton::Memory of = newton.memory();
  const std::span<const double> made_from = newton.system().made_from();
  all.insert(all.end(),
             {of.scale, of.report.residual, of.report.displacement_error,
              static_cast<double>(of.report.iterations), static_cast<double>(made_from.size())});
  all.insert(all.end(), made_from.begin(), made_from.end());
}

std::span<const double> recall(std::span<const double> all, Newton& newton) {
  constexpr std::size_t own = 5;
  if (all.size() < own || !(all[4] <= static_cast<double>(all.size() - own)))
    throw std::runtime_error("the checkpoint is of another solver");
  newton.recall({{all[1], all[2], static_cast<std::uint64_t>(all[3])}, all[0]});
  const auto numbers = static_cast<std::size_t>(all[4]);
  newton.system().make_again(all.subspan(own, numbers));
  return all.subspan(own + numbers);
}

}  // namespace hyperlattice::equilibrium
