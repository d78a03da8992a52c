#include <base/figures.hpp>
#include <model/body_figures.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace hyperlattice {

namespace {

/// Returns the distance of the lattice's planes of sites along each axis, m. A particle stands for
/// half of it on both sides.
Vec3 between_planes(const Grid& grid) {
  const auto least = [&](int axis) {
    double step = 1;
    for (const Vec3 a : grid.basis)
      if (a[axis] != 0) step = std::min(step, std::abs(a[axis]));
    return grid.spacing * step;
  };
  return {least(0), least(1), least(2)};
}

template <class Value, class Text>
std::string beside(const Value& is, const std::optional<Value>& asked, const Text& text,
                   std::string_view more = "", bool at_most = false) {
  std::string made = text(is);
  if (!asked || text(*asked) == made) return fmt::format("{}{}", made, more);
  return fmt::format("{}{} (shape: {}{})", made, more, at_most ? "at most " : "", text(*asked));
}

}  // namespace

BodyFigures body_figures(const Model& model) {
  const Body& body = model.body;
  BodyFigures figures;
  figures.size = body.highest - body.lowest;
  figures.of_particles = body.is_listed();
  figures.is_centred = !body.is_listed() && !body.is_cubic();
  figures.is_partial = body.grid.boundary == Boundary::partial_cells;
  if (!body.is_listed() && body.cells.empty()) figures.size += between_planes(body.grid);
  double particles =
      body.cells.empty() ? static_cast<double>(body.particles) : body.cells.volume();  // whole ones
  if (!body.listed.shares.empty()) {
    particles = 0;
    for (const double share : body.listed.shares) particles += share;
  }
  figures.cells = body.cells.count();
  figures.partial_cells = body.cells.partial().size();
  figures.volume = particles * body.grid.site_volume;
  if (model.materials.size() == 1)
    figures.mass = particles * model.kinds.masses.front();
  else
    for (Particle particle = 0; particle < body.particles; ++particle)
      figures.mass += model.mass(particle);
  figures.cut_springs = body.cut_springs();
  figures.parts = parts_of(body);
  if (body.grid.shape == nullptr) return figures;
  const auto& shape = *static_cast<const Region*>(body.grid.shape->self);
  const SolidExtent extent = extent_of(shape);
  if (const Vec3 asked = extent.high - extent.low; std::isfinite(norm(asked)))
    (figures.is_partial ? figures.size : figures.asked_size.emplace()) = asked;
  figures.asked_at_most = !extent.attained;
  if (shape.volume > 0) figures.asked_volume = shape.volume;
  if (shape.volume > 0 && model.materials.size() == 1)
    figures.asked_mass = shape.volume * model.materials.front().constants.density;
  return figures;
}

std::vector<std::pair<std::string, std::string>> body_lines(const BodyFigures& figures) {
  std::vector<std::pair<std::string, std::string>> lines;
  const auto size = [](Vec3 v) { return fmt::format("{:.6g} x {:.6g} x {:.6g} m", v.x, v.y, v.z); };
  const std::string_view of = figures.of_particles ? " between its outermost particles"
                              : figures.is_partial
                                  ? ", as its shape; particles stand up to one spacing outside"
                                  : "";
  lines.emplace_back("size",
                     beside(figures.size, figures.asked_size, size, of, figures.asked_at_most));
  lines.emplace_back("volume", beside(figures.volume, figures.asked_volume,
                                      [](double v) { return fmt::format("{:.6g} m3", v); }));
  lines.emplace_back("mass", beside(figures.mass, figures.asked_mass,
                                    [](double m) { return fmt::format("{:.6g} kg", m); }));
  if (figures.is_partial)
    lines.emplace_back("cells",
                       fmt::format("{}, of which {} count by the share of their volume "
                                   "that lies inside the shape",
                                   count_text(figures.cells), count_text(figures.partial_cells)));
  const Parts& parts = figures.parts;
  std::string bodies = "1: springs join all particles";
  if (parts.count > 1) bodies = fmt::format("{}, which no spring joins", parts.count);
  if (parts.loose > 0)
    bodies += fmt::format("; {} of them {} without springs", parts.loose,
                          parts.loose == 1 ? "is a particle" : "are particles");
  lines.emplace_back("bodies", std::move(bodies));
  if (figures.cut_springs > 0) lines.emplace_back("cut springs", count_text(figures.cut_springs));
  return lines;
}

std::string loose_warning(const Body& body, const Parts& parts) {
  if (parts.loose == 0) return "";
  const Vec3 x = body.position(parts.first_loose);
  return fmt::format(
      "{} particle{} without springs, the first at ({:.6g}, {:.6g}, {:.6g}) m: nothing but loads "
      "moves {}{}",
      count_text(parts.loose), parts.loose == 1 ? " is" : "s are", x.x, x.y, x.z,
      parts.loose == 1 ? "it" : "them",
      body.cut_springs() > 0 ? "; cuts that are less than a few spacings apart, or along an edge, "
                               "leave such particles"
                             : "");
}

std::vector<std::string> size_warnings(const BodyFigures& figures, double spacing) {
  constexpr double noticeable = 0.01, noticeable_volume = 0.02;
  std::vector<std::string> warnings;
  if (figures.of_particles) return warnings;
  const auto compare = [&](char axis, double width, double asked) {
    const double error = width / asked - 1;
    if (std::abs(error) <= noticeable || (figures.asked_at_most && error < 0)) return;
    warnings.push_back(
        fmt::format("along {} the body is {:.6g} m wide, {:.3g} % {} than the {:.6g} m that its "
                    "shape asks for{}: cells of {:.6g} m do not fill that evenly",
                    axis, width, 100 * std::abs(error), error > 0 ? "more" : "less", asked,
                    figures.asked_at_most ? " at most" : "", spacing));
  };
  if (figures.asked_size) {
    compare('x', figures.size.x, figures.asked_size->x);
    compare('y', figures.size.y, figures.asked_size->y);
    compare('z', figures.size.z, figures.asked_size->z);
  }
  if (!warnings.empty() || !(figures.is_centred || figures.is_partial) || !figures.asked_volume)
    return warnings;
  if (const double error = figures.volume / *figures.asked_volume - 1;
      std::abs(error) > noticeable_volume)
    warnings.push_back(fmt::format(
        "the body has {:.3g} % {} volume than its shape asks for: {}", 100 * std::abs(error),
        error > 0 ? "more" : "less",
        figures.is_partial ? "cells with less than least_share inside are left out"
                           : fmt::format("cells of {:.6g} m do not fill that evenly", spacing)));
  return warnings;
}

}  // namespace hyperlattice
