#include <model/build.hpp>
#include <model/cut_springs.hpp>
#include <model/nodal_volumes.hpp>

#include <hyperlattice/volumetric_cell.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Returns the tetrahedra of a listed body of which no cut crosses an edge.
Tetrahedra uncut_tetrahedra(const Model& model, RegionIndex& regions) {
  Tetrahedra all = tetrahedra_of(model.body.listed);
  const std::vector<Cut>& cuts = model.scene->of(Family::lattices).front()->cuts;
  if (cuts.empty()) return all;
  constexpr std::size_t edges = 6;
  std::vector<Segment> segments;
  segments.reserve(edges * all.size());
  for (std::size_t t = 0; t < all.size(); ++t)
    for (std::size_t n = 0; n < 4; ++n)
      for (std::size_t m = n + 1; m < 4; ++m)
        segments.push_back({Particle{all[t][n]}, Particle{all[t][m]}});
  const std::vector<bool> is_crossed = crossed(model.body, cuts, regions, segments);
  std::vector<Corners> kept;
  kept.reserve(all.size());
  for (std::size_t t = 0; t < all.size(); ++t) {
    const auto first = is_crossed.begin() + static_cast<std::ptrdiff_t>(edges * t);
    if (std::find(first, first + edges, true) == first + edges) kept.push_back(all[t]);
  }
  return {model.body.listed.positions.size(), std::move(kept)};
}

}  // namespace

NodalVolumes::NodalVolumes(const Listed& listed, Tetrahedra tetrahedra, std::vector<double> moduli)
    : listed_(&listed),
      tetrahedra_(std::move(tetrahedra)),
      volumes_(listed.positions.size()),
      moduli_(std::move(moduli)) {
  for (std::size_t p = 0; p < volumes_.size(); ++p)
    for (const Tetrahedra::Use use : tetrahedra_.of(p))
      volumes_[p] += volume_of(edges_at_rest(tetrahedra_[use.tetrahedron])) / 4;
  for (std::size_t p = 0; p < volumes_.size(); ++p)
    if (!(volumes_[p] > 0)) moduli_[p] = 0;
}

double NodalVolumes::bytes() const {
  return tetrahedra_.bytes() + static_cast<double>(2 * volumes_.size() * sizeof(double));
}

std::array<Vec3, 3> NodalVolumes::edges_at_rest(const Corners& corners) const {
  const std::vector<Vec3>& rest = listed_->positions;
  const Vec3 first = rest[corners[0]];
  return {rest[corners[1]] - first, rest[corners[2]] - first, rest[corners[3]] - first};
}

std::array<Vec3, 3> NodalVolumes::edges(const Corners& corners, std::span<const Vec3> moved) const {
  const std::vector<Vec3>& rest = listed_->positions;
  const auto edge = [&](std::size_t n) {
    return (rest[corners[n]] - rest[corners[0]]) + (moved[corners[n]] - moved[corners[0]]);
  };
  return {edge(1), edge(2), edge(3)};
}

std::vector<VolumeDerivative> NodalVolumes::derivatives(std::size_t particle) const {
  std::vector<VolumeDerivative> found;
  for (const Tetrahedra::Use use : tetrahedra_.of(particle)) {
    const Corners& corners = tetrahedra_[use.tetrahedron];
    const std::array<Vec3, 4> gradients = volume_gradients(edges_at_rest(corners));
    for (std::size_t n = 0; n < 4; ++n) add_derivative(found, corners[n], 0.25 * gradients[n]);
  }
  return found;
}

VolumeState NodalVolumes::state() const {
  VolumeState state;
  state.moved.resize(particles());
  state.ended.resize(particles());
  state.growths.resize(tetrahedra_.size());
  state.pressures.resize(particles());
  state.energies.resize(particles());
  return state;
}

double NodalVolumes::growth(std::size_t tetrahedron, std::span<const Vec3> moved) const {
  const Corners& of = tetrahedra_[tetrahedron];
  const std::vector<Vec3>& rest = listed_->positions;
  const auto edge = [&](std::span<const Vec3> at, std::size_t n) { return at[of[n]] - at[of[0]]; };
  const Vec3 a = edge(rest, 1), b = edge(rest, 2), c = edge(rest, 3), x = edge(moved, 1),
             y = edge(moved, 2), z = edge(moved, 3);
  // (a + x) . ((b + y) x (c + z)) - a . (b x c)
  const Vec3 turned = cross(b, z) + cross(y, c) + cross(y, z);
  return (dot(x, cross(b, c)) + dot(a, turned) + dot(x, turned)) / 6;
}

NodalVolumes::Response NodalVolumes::response(std::size_t particle,
                                              std::span<const double> growths) const {
  if (moduli_[particle] == 0) return {};
  double sum = 0;
  for (const Tetrahedra::Use use : tetrahedra_.of(particle)) sum += growths[use.tetrahedron];
  const VolumetricResponse of = volumetric_response(sum / (4 * volumes_[particle]));
  return {moduli_[particle] * of.pressure, moduli_[particle] * of.stiffness,
          moduli_[particle] * volumes_[particle] * of.energy};
}

std::array<Vec3, 4> NodalVolumes::gradients(std::size_t tetrahedron,
                                            std::span<const Vec3> moved) const {
  return volume_gradients(edges(tetrahedra_[tetrahedron], moved));
}

double NodalVolumes::pressure(std::size_t tetrahedron, std::span<const double> pressures) const {
  const Corners& of = tetrahedra_[tetrahedron];
  return 0.25 * ((pressures[of[0]] + pressures[of[1]]) + (pressures[of[2]] + pressures[of[3]]));
}

Vec3 NodalVolumes::force(std::size_t particle, std::span<const Vec3> moved,
                         std::span<const double> pressures) const {
  Vec3 sum;
  for (const Tetrahedra::Use use : tetrahedra_.of(particle))
    sum -= pressure(use.tetrahedron, pressures) * gradients(use.tetrahedron, moved)[use.corner];
  return sum;
}

void set_nodal_volumes(Model& model, RegionIndex& regions, Faults& faults) {
  bool has_energy = false;
  for (const Material& material : model.materials) {
    has_energy |= material.constants.volumetric != 0;
    if (material.constants.volumetric < 0)
      faults.add(material.stage->pointer, material.stage->component->type(),
                 "no K_v below zero on a list of springs: the list is not known to be stable");
  }
  if (!has_energy || !faults.empty()) return;
  std::vector<double> moduli(model.body.particles);
  for (Particle p = 0; p < model.body.particles; ++p)
    moduli[p] = model.materials[model.kinds.material(p)].constants.volumetric;
  auto volumes = std::make_shared<const NodalVolumes>(
      model.body.listed, uncut_tetrahedra(model, regions), std::move(moduli));
  if (volumes->tetrahedra().size() == 0)
    return faults.add("/pipeline", "",
                      "a list whose particles are the corners of tetrahedra, for a Poisson ratio "
                      "above that of the springs: this one has none");
  model.nodal_volumes = std::move(volumes);
}

}  // namespace hyperlattice
