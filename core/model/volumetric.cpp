#include <model/build.hpp>
#include <model/spring_lattice.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Returns the ranges where a row and the next site of the row both have particles.
std::vector<Range> pairs(std::span<const Run> runs) {
  std::vector<Range> found;
  for (const Run& run : runs)
    if (run.begin + 1 < run.end) found.push_back({run.begin, run.end - 1});
  return found;
}

std::vector<Range> intersection(const std::vector<Range>& a, const std::vector<Range>& b) {
  std::vector<Range> found;
  for (auto x = a.begin(), y = b.begin(); x != a.end() && y != b.end();) {
    const Range both{std::max(x->begin, y->begin), std::min(x->end, y->end)};
    if (both.begin < both.end) found.push_back(both);
    ++(x->end < y->end ? x : y);
  }
  return found;
}

}  // namespace

Volumetric::Volumetric(const Body& body, const ParticleKinds& kinds,
                       std::vector<double> of_materials)
    : body_(&body), kinds_(&kinds) {
  if (std::any_of(of_materials.begin(), of_materials.end(), [](double k) { return k != 0; }))
    of_materials_ = std::move(of_materials);
  if (!empty()) find_cut_cells();
}

void Volumetric::find_cut_cells() {
  body_->for_cut_springs([&](Particle a, Particle, std::uint32_t neighbour) {
    const Neighbour& to = body_->neighbours[neighbour];
    if (std::max({std::abs(to.dx), std::abs(to.dy), std::abs(to.dz)}) > 1)
      return;  // such a spring belongs to no cell
    const Site site = body_->site(a);
    for_cells_of(to, [&](int di, int dj, int dk) {
      const Particle lowest = body_->at({site.i + di, site.j + dj, site.k + dk});
      if (lowest != Body::no_particle) cut_.push_back(lowest);
    });
  });
  std::sort(cut_.begin(), cut_.end());
  cut_.erase(std::unique(cut_.begin(), cut_.end()), cut_.end());
}

double Volumetric::largest() const {
  return empty() ? 0 : *std::max_element(of_materials_.begin(), of_materials_.end());
}
double Volumetric::least() const {
  return empty() ? 0 : *std::min_element(of_materials_.begin(), of_materials_.end());
}

std::vector<Range> Volumetric::row(std::int32_t j, std::int32_t k) const {
  if (!body_->cells.empty()) {
    std::vector<Range> found;
    for (const Run& run : body_->cells.row(j, k)) found.push_back({run.begin, run.end});
    return found;
  }
  std::vector<Range> found = pairs(body_->row(j, k));
  for (std::int32_t n = 1; n < 4 && !found.empty(); ++n)
    found = intersection(found, pairs(body_->row(j + (n & 1), k + (n >> 1))));
  return found;
}

bool Volumetric::holds(Site cell) const {
  if (!body_->cells.empty()) return body_->cells.holds(cell);
  const std::array<Particle, 8> all = corners(cell);
  return std::find(all.begin(), all.end(), Body::no_particle) == all.end();
}

double Volumetric::modulus(Site cell) const {
  if (!cut_.empty() && std::binary_search(cut_.begin(), cut_.end(), body_->at(cell))) return 0;
  if (uniform()) return of_materials_.front();
  return body_->cells.has_partial() ? body_->cells.share_of_cell(cell) * whole_modulus(cell)
                                    : whole_modulus(cell);
}

double Volumetric::whole_modulus(Site cell) const {
  if (of_materials_.size() == 1) return of_materials_.front();
  if (!kinds_->mixtures.empty())
    return of_materials_[kinds_->mixtures.cell_above(kinds_->mixtures.of(body_->at(cell)))];
  double inverse = 0, mean = 0, least = infinity, largest = -infinity;
  for (const Particle corner : corners(cell)) {
    const double own = of_materials_[kinds_->material(corner)];
    inverse += 1 / own / 8;
    mean += own / 8;
    least = std::min(least, own);
    largest = std::max(largest, own);
  }
  if (least == largest) return least;
  if (least == 0 || largest == 0) return 0;
  return (least > 0) == (largest > 0) ? 1 / inverse : mean;
}

std::array<Particle, 8> Volumetric::corners(Site cell) const {
  std::array<Particle, 8> found{};
  for (std::int32_t n = 0; n < 8; ++n)
    found[static_cast<std::size_t>(n)] =
        body_->at({cell.i + (n & 1), cell.j + (n >> 1 & 1), cell.k + (n >> 2)});
  return found;
}

void set_volumetric(Model& model, RegionIndex& regions, Faults& faults) {
  if (model.body.is_listed()) return set_nodal_volumes(model, regions, faults);
  const bool has_cells = facts_of(geometry_from(model.body)).has_cells;
  std::vector<double> moduli;
  for (const Material& material : model.materials) {
    const double modulus = material.constants.volumetric;
    moduli.push_back(modulus);
    const auto refuse = [&](const Stage& at, const char* expected) {
      faults.add(at.pointer, at.component->type(), expected);
    };
    const std::vector<Stage>& failures = material.stage->failures;
    if (modulus != 0 && !has_cells)
      refuse(
          *material.stage,
          "no volumetric energy on this lattice: its particles are not the corners of cubic cells");
    if (modulus < 0 && (model.springs.breakable || model.springs.softens))
      refuse(failures.empty() ? *material.stage : failures.front(),
             "no failure in the body: a volumetric energy with K_v below zero would give energy to "
             "what breaks");
  }
  if (faults.empty()) model.volumetric = Volumetric(model.body, model.kinds, std::move(moduli));
}

}  // namespace hyperlattice
