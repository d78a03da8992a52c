// Bodies for tests. A function of position gives the shape; lattices.cubic, loaded by the host,
// fills it.
#pragma once

#include <host/host.hpp>
#include <model/body.hpp>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <string>

namespace hyperlattice::test {

/// A solid region. The anchor and the centre are at the middle of a symmetric box, and at the low
/// corner of any other box.
inline Region solid(Vec3 low, Vec3 high, std::function<bool(Vec3)> inside) {
  Region region;
  region.kind = Region::Kind::solid;
  region.primitive = "test";
  region.inside = std::move(inside);
  region.low = low;
  region.high = high;
  region.centre = 0.5 * (low + high);
  region.anchor = low == -1.0 * high ? Vec3{} : low;
  return region;
}

inline Region ball(double inner, double outer) {
  return solid({-outer, -outer, -outer}, {outer, outer, outer},
               [=](Vec3 p) { return dot(p, p) >= inner * inner && dot(p, p) <= outer * outer; });
}

inline Region box(Vec3 size) {
  return solid({}, size, [=](Vec3 p) {
    return std::min({p.x, p.y, p.z}) >= 0 && p.x <= size.x && p.y <= size.y && p.z <= size.z;
  });
}

/// The body that lattices.cubic makes of a region. Throws as build_body does.
inline Body cubic_body(const Region& region, double spacing,
                       Boundary boundary = Boundary::particles) {
  static Host host({std::string(HYPERLATTICE_BUILD) + "/lib/hyperlattice"});
  const Component* cubic = host.find("lattices.cubic");
  if (cubic == nullptr) throw std::runtime_error(host.why_not("lattices.cubic"));
  const Shape shape{&region,
                    [](const void* self, Vec3 point) noexcept {
                      return static_cast<const Region*>(self)->inside(point);
                    },
                    region.low, region.high, region.anchor};
  const Complaint silent{nullptr, [](void*, std::string_view) noexcept {}};
  const std::unique_ptr<void, void (*)(void*)> options(cubic->info.create_options(silent),
                                                       cubic->info.destroy_options);
  for (const Option& option : cubic->info.options) {
    OptionValue value;
    value.number = spacing;
    // `boundary` is the lattice's only choice option
    value.integer = static_cast<std::int64_t>(boundary);
    value.shape = &shape;
    value.absent = option.optional;
    option.set(options.get(), value, silent);
  }
  const std::unique_ptr<void, void (*)(void*)> lattice(cubic->info.create(options.get(), silent),
                                                       cubic->info.destroy);
  Body body =
      build_body(*static_cast<const LatticeFunctions*>(cubic->info.functions), lattice.get());
  body.grid.shape = nullptr;  // `shape` is local to this function
  return body;
}

}  // namespace hyperlattice::test
