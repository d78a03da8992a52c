#include <model/body_figures.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

namespace hyperlattice {

namespace {

/// A set has the boxes of its parts, which other parts may have cut.
bool has_tight_box(const Region& region) {
  constexpr std::string_view loose[] = {"half_space", "voxels"};
  if (region.kind == Region::Kind::set_union)
    return std::all_of(region.parts.begin(), region.parts.end(), [](const auto& part) { return has_tight_box(*part); });
  return region.kind == Region::Kind::solid && std::find(std::begin(loose), std::end(loose), region.primitive) == std::end(loose);
}

template <class Value, class Text>
std::string beside(const Value& is, const std::optional<Value>& asked, const Text& text) {
  std::string made = text(is);
  if (!asked || text(*asked) == made) return made;
  return fmt::format("{}; its shape asks for {}", made, text(*asked));
}

}  // namespace

BodyFigures body_figures(const Model& model) {
  const Body& body = model.body;
  BodyFigures figures;
  if (body.is_cubic()) {
    const double rim = body.cells.empty() ? body.grid.spacing : 0;  // whole particles fill half a cell more on both sides
    figures.size = body.highest - body.lowest + Vec3{rim, rim, rim};
  }
  double particles = static_cast<double>(body.cells.empty() ? body.particles : body.cells.count());  // whole ones
  if (!body.listed.shares.empty()) {
    particles = 0;
    for (const double share : body.listed.shares) particles += share;
  }
  figures.volume = particles * body.grid.site_volume;
  if (model.materials.size() == 1)
    figures.mass = particles * model.masses.front();
  else
    for (Particle particle = 0; particle < body.particles; ++particle) figures.mass += model.mass(particle);
  figures.parts = count_parts(body);
  if (body.grid.shape == nullptr) return figures;
  const auto& shape = *static_cast<const Region*>(body.grid.shape->self);
  if (has_tight_box(shape)) figures.asked_size = shape.high - shape.low;
  if (shape.volume > 0) figures.asked_volume = shape.volume;
  if (shape.volume > 0 && model.materials.size() == 1) figures.asked_mass = shape.volume * model.materials.front().constants.density;
  return figures;
}

std::vector<std::pair<std::string, std::string>> body_lines(const BodyFigures& figures) {
  std::vector<std::pair<std::string, std::string>> lines;
  if (figures.size) {
    const auto size = [](Vec3 v) { return fmt::format("{:.6g} x {:.6g} x {:.6g} m", v.x, v.y, v.z); };
    lines.emplace_back("size", beside(*figures.size, figures.asked_size, size));
  }
  lines.emplace_back("volume", beside(figures.volume, figures.asked_volume, [](double v) { return fmt::format("{:.6g} m3", v); }));
  lines.emplace_back("mass", beside(figures.mass, figures.asked_mass, [](double m) { return fmt::format("{:.6g} kg", m); }));
  lines.emplace_back("bodies", figures.parts == 1 ? "1: springs join all particles" : fmt::format("{}, which no spring joins", figures.parts));
  return lines;
}

std::vector<std::string> size_warnings(const BodyFigures& figures, double spacing) {
  constexpr double noticeable = 0.01;
  std::vector<std::string> warnings;
  if (!figures.size || !figures.asked_size) return warnings;
  const auto compare = [&](char axis, double width, double asked) {
    const double error = width / asked - 1;
    if (std::abs(error) <= noticeable) return;
    warnings.push_back(fmt::format(
        "along {} the body is {:.6g} m wide, {:.3g} % {} than the {:.6g} m that its shape asks for: cells of {:.6g} m do not fill that evenly", axis,
        width, 100 * std::abs(error), error > 0 ? "more" : "less", asked, spacing));
  };
  compare('x', figures.size->x, figures.asked_size->x);
  compare('y', figures.size->y, figures.asked_size->y);
  compare('z', figures.size->z, figures.asked_size->z);
  return warnings;
}

}  // namespace hyperlattice
