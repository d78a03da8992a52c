#include <host/plugin_call.hpp>
#include <model/region_index.hpp>

#include <spdlog/fmt/fmt.h>

namespace hyperlattice {

namespace {

bool is_surface(const Region& region) {
  return region.kind == Region::Kind::surface || region.kind == Region::Kind::inner_surface ||
         region.kind == Region::Kind::outer_surface;
}

bool is_set(const Region& region) { return !region.parts.empty(); }

std::string text(Vec3 v) { return fmt::format("({:.6g}, {:.6g}, {:.6g})", v.x, v.y, v.z); }

std::string what(const Region& region) {
  switch (region.kind) {
    case Region::Kind::all:
      return "all particles";
    case Region::Kind::surface:
      return "the particles with an open face";
    case Region::Kind::inner_surface:
      return "the particles around closed cavities";
    case Region::Kind::outer_surface:
      return "the particles with a face to the outside";
    case Region::Kind::face:
      return "the outermost layer of one side";
    case Region::Kind::solid:
      return fmt::format("a {} between {} and {} m", region.primitive, text(region.low),
                         text(region.high));
    default:
      break;
  }
  std::string parts;
  for (const auto& part : region.parts) parts += (parts.empty() ? "" : "; ") + what(*part);
  const char* name = region.kind == Region::Kind::set_union      ? "union"
                     : region.kind == Region::Kind::intersection ? "intersection"
                                                                 : "difference";
  return fmt::format("the {} of ({})", name, parts);
}

}  // namespace

const Region& RegionIndex::existing(RegionId region) const {
  if (region.index >= regions_.size())
    throw PluginMistake(
        fmt::format("it asks about region {}; there are {}", region.index, regions_.size()));
  return regions_[region];
}

const Surfaces& RegionIndex::surfaces() {
  if (!surfaces_) surfaces_ = std::make_unique<Surfaces>(body_);
  return *surfaces_;
}

const Skin& RegionIndex::skin() {
  if (!skin_) skin_ = std::make_unique<Skin>(body_);
  return *skin_;
}

const Region* RegionIndex::filled() const {
  return body_.grid.shape == nullptr
             ? nullptr
             : static_cast<const Region*>(body_.grid.shape->self);  // see Regions::shape
}

std::span<const Particle> RegionIndex::particles(RegionId region) {
  const Region& wanted = existing(region);  // checks the id before an entry is made
  const auto [entry, is_new] = particles_.try_emplace(region.index);
  if (is_new)
    entry->second = body_.is_cubic()
                        ? particles_in(body_, surfaces(), wanted)
                        : particles_in(
                              body_, [this]() -> const Skin& { return skin(); }, wanted);
  return entry->second;
}

void RegionIndex::for_particles(RegionId region, const std::function<void(Particle)>& visit) {
  if (body_.is_cubic() && !particles_.contains(region.index))
    return for_particles_in(body_, surfaces(), existing(region), visit);
  for (const Particle particle : particles(region)) visit(particle);
}

std::vector<Particle> RegionIndex::cells(RegionId region) {
  return cells_in(body_, surfaces(), regions_[region]);
}

std::span<const OpenArea> RegionIndex::open_areas(RegionId region) {
  const Region& wanted = existing(region);
  const auto [entry, is_new] = open_areas_.try_emplace(region.index);
  if (is_new)
    entry->second = body_.is_cubic()
                        ? hyperlattice::open_areas(body_, surfaces(), wanted)
                        : hyperlattice::open_areas(
                              body_, [this]() -> const Skin& { return skin(); }, wanted);
  return entry->second;
}

double RegionIndex::true_area(RegionId region) const {
  const Region* shape = filled();
  if (shape == nullptr) return 0;
  switch (existing(region).kind) {
    case Region::Kind::inner_surface:
      return shape->inner_area;
    case Region::Kind::outer_surface:
      return shape->outer_area;
    case Region::Kind::surface:
      return shape->outer_area > 0 ? shape->outer_area + shape->inner_area : 0;
    default:
      return 0;
  }
}

Vec3 RegionIndex::centre(RegionId region) {
  const Region* of = &existing(region);
  while (is_set(*of)) of = of->parts.front().get();
  if (is_surface(*of) || of->kind == Region::Kind::all) of = filled();
  if (of != nullptr && of->is_solid() && std::isfinite(norm(of->high - of->low))) return of->centre;
  Vec3 sum;
  for (const Particle particle : particles(region)) sum += body_.position(particle);
  const std::size_t count = particles(region).size();
  return count == 0 ? sum : (1 / static_cast<double>(count)) * sum;
}

std::string RegionIndex::expected_particles(RegionId region) const {
  return expected(region, "particles", "none of the body's, which stand");
}

std::string RegionIndex::expected_cells(RegionId region) const {
  return expected(region, "cells", "the centre of none of the body's, whose corners stand");
}

std::string RegionIndex::expected(RegionId region, const char* members, const char* held) const {
  const std::string& name = regions_.name(region);
  const std::string named =
      name.starts_with('{')
          ? ""
          : fmt::format("\"{}\", ", name);  // a region without a name begins with {
  return fmt::format("a region with {}; {}{}, holds {} between {} and {} m", members, named,
                     what(regions_[region]), held, text(body_.lowest), text(body_.highest));
}

}  // namespace hyperlattice
