#include <model/build.hpp>

#include <algorithm>
#include <array>
#include <compare>
#include <map>
#include <utility>

namespace hyperlattice {

Mixtures::Mixtures(const Body& body, std::span<const std::uint8_t> material_of,
                   std::size_t materials) {
  for (std::size_t material = 0; material < materials; ++material) {
    Around& whole = around_.emplace_back();
    whole.materials.fill(static_cast<std::uint8_t>(material));
    whole.shares.fill(1);
  }
  std::map<Around, std::uint32_t> known;
  for (const Run& run : body.runs)
    for (std::int32_t i = run.begin; i < run.end; ++i) {
      Around here;
      here.materials.fill(no_cell);
      std::uint8_t first = no_cell;
      bool alike = true;
      for_cells_of({}, [&](int di, int dj, int dk) {
        const Particle cell = body.cells.at({i + di, run.j + dj, run.k + dk});
        if (cell == Body::no_particle) return;
        const std::uint8_t material = here.materials[place(di, dj, dk)] = material_of[cell];
        here.shares[place(di, dj, dk)] = static_cast<float>(body.cells.share_of_cell(cell));
        alike = alike && (first == no_cell || first == material);
        first = material;
      });
      if (alike) {
        of_particle_.push_back(first);
        continue;
      }
      const auto [entry, is_new] =
          known.try_emplace(here, static_cast<std::uint32_t>(around_.size()));
      if (is_new) around_.push_back(here);
      of_particle_.push_back(entry->second);
    }
}

std::uint8_t Mixtures::commonest(std::uint32_t mixture) const {
  std::array<double, no_cell> shares{};
  for_cells(mixture, {}, [&](std::uint8_t material, double share) { shares[material] += share; });
  return static_cast<std::uint8_t>(std::max_element(shares.begin(), shares.end()) - shares.begin());
}

std::uint8_t Mixtures::material_of_spring(std::uint32_t mixture, const Neighbour& to) const {
  std::uint8_t found = no_cell;
  for_cells(mixture, to, [&](std::uint8_t material, double) { found = std::min(found, material); });
  return found == no_cell ? commonest(mixture) : found;
}

double Mixtures::bytes() const {
  return of_particle_.bytes() + static_cast<double>(around_.size() * sizeof(Around));
}

namespace {

/// A cell of a spring or a particle, by what it gives to their mean.
struct Cell {
  std::uint8_t material;
  double share;
  auto operator<=>(const Cell&) const = default;
};

double sum_of_shares(const std::vector<Cell>& cells) {
  double sum = 0;
  for (const Cell& cell : cells) sum += cell.share;
  return sum;
}

/// Returns the mean stiffness of the springs of these cells' materials. The lowest alarm of them
/// decides when the spring is checked for failure. Constants of laws have no mean.
SpringConstants mean_spring(const Model& model, const std::vector<Cell>& cells,
                            std::uint32_t spring_class) {
  const double whole = sum_of_shares(cells);
  SpringConstants mean;
  for (const Cell& cell : cells) {
    const SpringConstants& own = model.springs.spring(cell.material, cell.material, spring_class);
    const double part = cell.share / whole;
    mean.stiffness += part * own.stiffness;
    mean.cross_stiffness += part * own.cross_stiffness;
    mean.alarm = std::min(mean.alarm, own.alarm);
  }
  return mean;
}

/// Returns whether the cells' materials have one linear law without constants.
bool is_one_spring(const Model& model, const std::vector<Cell>& cells) {
  const std::uint32_t law = model.materials[cells.front().material].law;
  return model.springs.laws[law].kernels.linear &&
         std::all_of(cells.begin(), cells.end(),
                     [&](const Cell& cell) { return model.materials[cell.material].law == law; });
}

/// Returns the springs of the cells' materials, side by side. `cells` is sorted.
CompositeSpring side_by_side(const Model& model, const std::vector<Cell>& cells,
                             std::uint32_t spring_class) {
  const double whole = sum_of_shares(cells);
  std::vector<SpringPart> parts;
  for (const Cell& cell : cells) {
    if (parts.empty() || parts.back().material != cell.material)
      parts.push_back(part_of(model, cell.material, spring_class, 0));
    parts.back().weight += cell.share / whole;
  }
  return {model.springs.laws, std::move(parts), CompositeSpring::Joined::side_by_side};
}

}  // namespace

void add_mixtures(Model& model) {
  const auto mixtures = static_cast<std::uint32_t>(model.kinds.mixtures.count()),
             materials = static_cast<std::uint32_t>(model.materials.size());
  std::map<std::pair<std::uint32_t, std::vector<Cell>>, std::uint32_t>
      known;  // key: spring class and cells
  std::vector<Cell> cells;
  const auto take = [&](std::uint32_t mixture, const Neighbour& to) {
    cells.clear();
    model.kinds.mixtures.for_cells(mixture, to, [&](std::uint8_t material, double share) {
      cells.push_back({material, share});
    });
    std::sort(cells.begin(), cells.end());  // makes sums independent of the order of the cells
  };
  for (std::uint32_t mixture = 0; mixture < mixtures; ++mixture) {
    for (const Neighbour& to : model.body.neighbours) {
      take(mixture, to);
      const std::uint8_t first = cells.empty() ? std::uint8_t{0} : cells.front().material;
      std::uint32_t place =
          (first * materials + first) * model.body.grid.spring_classes + to.spring_class;
      if (!cells.empty() && cells.back().material != first) {
        const auto [entry, is_new] = known.try_emplace(
            {to.spring_class, cells}, static_cast<std::uint32_t>(model.springs.constants.size()));
        if (is_new) {
          model.springs.constants.push_back(mean_spring(model, cells, to.spring_class));
          if (!is_one_spring(model, cells))
            model.springs.add_composite(entry->second, side_by_side(model, cells, to.spring_class));
        }
        place = entry->second;
      }
      model.springs.mixture_springs.push_back(place);
    }
    if (mixture < materials) continue;
    take(mixture, {});
    double mass = 0, alpha = 0;
    for (const Cell& cell : cells) {
      mass += cell.share * model.kinds.masses[cell.material];
      alpha += cell.share * model.kinds.alphas[cell.material];
    }
    model.kinds.masses.push_back(mass / sum_of_shares(cells));
    model.kinds.alphas.push_back(alpha / sum_of_shares(cells));
  }
}

}  // namespace hyperlattice
