#include <base/figures.hpp>
#include <state/inside_out.hpp>

#include <hyperlattice/volumetric_cell.hpp>

#include <spdlog/fmt/fmt.h>

#include <cmath>

namespace hyperlattice {

namespace {

constexpr double slab_particles = 1 << 19;

/// Returns six times the volume of the tetrahedron between three edges: positive if they are
/// oriented as x, y and z are.
double turn(Vec3 a, Vec3 b, Vec3 c) { return dot(a, cross(b, c)); }

Vec3 vector_at(std::span<const double> xyz, std::uint64_t n) {
  return {xyz[3 * n], xyz[3 * n + 1], xyz[3 * n + 2]};
}

/// Finds the particles at sites i and i + 1 of a row; i must ascend.
class RowCursor {
 public:
  explicit RowCursor(std::span<const Run> runs) : runs_(runs) {}
  /// Returns the particle at i if i + 1 has a particle too, else Body::no_particle.
  Particle pair_at(std::int32_t i) {
    while (run_ < runs_.size() && runs_[run_].end <= i + 1) ++run_;
    if (run_ == runs_.size() || runs_[run_].begin > i) return Body::no_particle;
    return runs_[run_].first + static_cast<Particle>(i - runs_[run_].begin);
  }

 private:
  std::span<const Run> runs_;
  std::size_t run_ = 0;
};

/// The other ends of each particle's springs, in the order of the springs.
class Ends {
 public:
  explicit Ends(const Body& body)
      : first_(body.particles + 1), ends_(2 * body.listed.springs.size()) {
    for (const ListedSpring& spring : body.listed.springs) {
      ++first_[spring.a];
      ++first_[spring.b];
    }
    std::size_t sum = 0;
    // The place behind the particle's last end: the ends are filled in backwards.
    for (std::size_t& first : first_) first = sum += first;
    for (std::size_t n = body.listed.springs.size(); n-- > 0;) {
      const ListedSpring& spring = body.listed.springs[n];
      ends_[--first_[spring.b]] = spring.a;
      ends_[--first_[spring.a]] = spring.b;
    }
  }
  std::span<const std::uint32_t> of(Particle particle) const {
    return std::span(ends_).subspan(first_[particle], first_[particle + 1] - first_[particle]);
  }
  static double bytes(double particles, double springs) {
    return sizeof(std::size_t) * particles + 2 * sizeof(std::uint32_t) * springs;
  }

 private:
  /// The first place of each particle in ends_; one more entry at the end.
  std::vector<std::size_t> first_;
  std::vector<std::uint32_t> ends_;
};

}  // namespace

bool CellWatch::is_due(std::uint64_t step) const {
  // In a run on many threads a look takes as long as many steps.
  constexpr std::uint64_t every = 1000;
  return seen_.has_looked == 0 || step >= seen_.last_looked + every;
}

double CellWatch::bytes(const Model& model) {
  const auto particles = static_cast<double>(model.body.particles),
             springs = static_cast<double>(model.body.listed.springs.size());
  const double two_planes = 2.0 * model.body.grid.sites[0] * model.body.grid.sites[1];
  const double at_a_time = model.body.is_listed()
                               ? particles
                               : std::min(particles, std::max(slab_particles, two_planes));
  double bytes = 3 * sizeof(double) * at_a_time;  // displacements
  // One bit: torn or not.
  if (model.springs.breakable || model.body.cut_springs() > 0) bytes += particles / 8;
  if (!model.body.is_listed()) return bytes;
  bytes += sizeof(Triple) * particles;
  return bytes + Ends::bytes(particles, springs);
}

void CellWatch::count(bool is_inside_out, Particle particle) {
  ++seen_.all;
  if (!is_inside_out) return;
  if (seen_.number == 0) found_ = particle;
  ++seen_.number;
}

/// Compares the volume of a cell whose corners moved by `moved`, spacings, with the least so far.
void CellWatch::measure(const std::array<Vec3, 8>& moved, Particle particle) {
  constexpr double spacing = 1, modulus = 1;
  const double growth = cell_response(moved, spacing, modulus).volume_growth;
  if (!(growth < least_growth_)) return;
  least_growth_ = growth;
  least_ = particle;
}

bool CellWatch::look(const Simulation& simulation) {
  if (seen_.has_looked != 0 && simulation.steps() == seen_.last_looked) return false;
  is_torn_.clear();
  body_.for_cut_springs([this](Particle a, Particle b, std::uint32_t) {
    is_torn_.resize(body_.particles, false);
    is_torn_[a] = is_torn_[b] = true;
  });
  for (const Breakage& broken : simulation.breakages()) {
    is_torn_.resize(body_.particles, false);
    is_torn_[broken.a] = is_torn_[broken.b] = true;
  }
  seen_.all = seen_.number = 0;
  least_growth_ = 0;
  seen_.last_looked = simulation.steps();
  seen_.has_looked = 1;
  if (body_.is_listed()) {
    first_ = 0;
    simulation.copy_to_first(Simulation::Motion::displacement, moved_);
    if (!moved_.empty()) look_at_list();  // in the first rank
  } else {
    look_at_cells(simulation);
  }
  moved_ = {};
  seen_.least_volume = 1 + least_growth_;
  seen_.least_time = simulation.time();
  if (least_growth_ < 0) seen_.least_place = body_.position(least_);
  const bool is_first = seen_.most == 0 && seen_.number > 0;
  if (is_first) {
    seen_.first_time = simulation.time();
    seen_.first_place = body_.position(found_);
  }
  seen_.most = std::max(seen_.most, seen_.number);
  return is_first;
}

/// Works on a slab of planes at a time, so that a large body's displacements are never in memory
/// twice.
void CellWatch::look_at_cells(const Simulation& simulation) {
  const auto planes = static_cast<std::size_t>(std::int64_t{body_.high.k} - body_.low.k + 1);
  std::vector<Particle> before(planes + 1);  // number of particles before each plane
  for (std::size_t plane = 0; plane < planes; ++plane) {
    before[plane + 1] = before[plane];
    for (std::int32_t j = body_.low.j; j <= body_.high.j; ++j)
      for (const Run& run : body_.row(j, body_.low.k + static_cast<std::int32_t>(plane)))
        before[plane + 1] += static_cast<Particle>(run.end - run.begin);
  }
  for (std::size_t plane = 0; plane + 1 < planes;) {  // cells stand between a plane and the next
    std::size_t last = plane + 1;
    while (last + 1 < planes &&
           static_cast<double>(before[last + 2] - before[plane]) <= slab_particles)
      ++last;
    first_ = before[plane];
    const bool are_here =
        simulation.displacements_in_first(moved_, first_, before[last + 1] - first_);
    for (; plane < last; ++plane)
      for (std::int32_t j = body_.low.j; are_here && j < body_.high.j; ++j)
        look_at_row(j, body_.low.k + static_cast<std::int32_t>(plane));
  }
}

void CellWatch::look_at_row(std::int32_t j, std::int32_t k) {
  const Basis& basis = body_.grid.basis;
  const double upright = turn(basis[0], basis[1], basis[2]);
  RowCursor others[3] = {RowCursor(body_.row(j + 1, k)), RowCursor(body_.row(j, k + 1)),
                         RowCursor(body_.row(j + 1, k + 1))};
  for (const Run& run : body_.row(j, k))
    for (std::int32_t i = run.begin; i + 1 < run.end; ++i) {
      Particle row[4] = {run.first + static_cast<Particle>(i - run.begin)};
      bool is_whole = true;
      for (std::size_t n = 0; n < 3; ++n) {
        row[n + 1] = others[n].pair_at(i);
        is_whole = is_whole && row[n + 1] != Body::no_particle;
      }
      if (!is_whole) continue;
      std::array<Vec3, 8> moved;  // by corner: 1 along a1, 2 along a2, 4 along a3
      bool is_torn = false;
      for (std::size_t corner = 0; corner < 8; ++corner) {
        const Particle particle = row[corner >> 1] + (corner & 1);
        moved[corner] = (1 / body_.grid.spacing) * vector_at(moved_, particle - first_);
        is_torn = is_torn || (!is_torn_.empty() && is_torn_[particle]);
      }
      if (is_torn) continue;
      bool is_inside_out = false;
      for (std::size_t corner = 0; corner < 8; ++corner) {
        const auto edge = [&](std::size_t axis) {
          return basis[axis] +
                 (moved[corner | 1U << axis] - moved[corner & ~(std::size_t{1} << axis)]);
        };
        is_inside_out = is_inside_out || turn(edge(0), edge(1), edge(2)) * upright <= 0;
      }
      count(is_inside_out, row[0]);
      if (is_volumetric_) measure(moved, row[0]);
    }
}

/// Chooses three springs of each particle: the first one, and two that are as far from collinear
/// and coplanar as possible.
void CellWatch::find_triples() {
  constexpr double flattest = 0.3;  // least volume, relative to a cube's corner
  const Ends all_ends(body_);
  triples_.assign(body_.particles, Triple{});
  for (Particle p = 0; p < body_.particles; ++p) {
    const auto way = [&](std::uint32_t to) {
      const Vec3 rest = body_.position(Particle{to}) - body_.position(p);
      return (1 / norm(rest)) * rest;
    };
    double area = 0, volume = 0;
    Triple triple{};
    const std::span<const std::uint32_t> ends = all_ends.of(p);
    if (ends.size() < 3) continue;
    triple[0] = ends[0];
    for (const std::uint32_t to : ends)
      if (const double size = norm(cross(way(triple[0]), way(to))); size > area) {
        area = size;
        triple[1] = to;
      }
    for (const std::uint32_t to : ends)
      if (const double size = std::abs(turn(way(triple[0]), way(triple[1]), way(to)));
          size > volume) {
        volume = size;
        triple[2] = to;
      }
    if (volume >= flattest) triples_[p] = triple;
  }
}

void CellWatch::look_at_list() {
  if (triples_.empty()) find_triples();
  for (Particle p = 0; p < body_.particles; ++p) {
    const Triple& triple = triples_[p];
    if (triple == Triple{} || (!is_torn_.empty() && is_torn_[p])) continue;
    Vec3 rest[3], now[3];
    for (std::size_t n = 0; n < 3; ++n) {
      rest[n] =
          (1 / body_.grid.spacing) * (body_.position(Particle{triple[n]}) - body_.position(p));
      now[n] = rest[n] +
               (1 / body_.grid.spacing) * (vector_at(moved_, triple[n]) - vector_at(moved_, p));
    }
    count(turn(rest[0], rest[1], rest[2]) * turn(now[0], now[1], now[2]) <= 0, p);
  }
}

std::string CellWatch::sentence() const {
  if (seen_.most == 0) return "";
  const Vec3 x = seen_.first_place;
  const std::string kind = body_.is_listed()
                               ? "particles have neighbours that lie round them the wrong way"
                               : "cells are inside out";
  return fmt::format(
      "the lattice folds through itself, which its springs do not resist: {} of {} {}, first seen "
      "at {} around ({:.4g}, {:.4g}, "
      "{:.4g}) m at rest{}; forces and energies there mean nothing",
      count_text(seen_.most), count_text(seen_.all), kind, quantity_text(seen_.first_time, "s"),
      x.x, x.y, x.z,
      seen_.number < seen_.most ? fmt::format(", {} at the end", count_text(seen_.number)) : "");
}

std::string CellWatch::stiffened() const {
  constexpr double noticeable = 0.8;  // the stiffness p' of a cell is then 1.55 times that at rest
  if (!(seen_.least_volume < noticeable)) return "";
  const Vec3 x = seen_.least_place;
  const double stiffer = std::sqrt(volumetric_response(seen_.least_volume - 1).stiffness);
  return fmt::format(
      "a cell at ({:.4g}, {:.4g}, {:.4g}) m at rest had {:.3g} of its volume at {}; its volumetric "
      "energy stiffens when compressed, so that the body at rest allows too long a step: expected "
      "a `safety` up to {:.2g} times smaller",
      x.x, x.y, x.z, seen_.least_volume, quantity_text(seen_.least_time, "s"), stiffer);
}

}  // namespace hyperlattice
