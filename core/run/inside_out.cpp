#include <base/figures.hpp>
#include <run/inside_out.hpp>

#include <spdlog/fmt/fmt.h>

#include <cmath>

namespace hyperlattice {

namespace {

/// Six times the volume of the tetrahedron between three edges; above 0 if they lie round each other as x, y and z do.
double turn(Vec3 a, Vec3 b, Vec3 c) { return dot(a, cross(b, c)); }

Vec3 vector_at(std::span<const double> xyz, std::uint64_t n) { return {xyz[3 * n], xyz[3 * n + 1], xyz[3 * n + 2]}; }

/// Finds the particles at sites i and i + 1 of a row; i must ascend.
class RowCursor {
 public:
  explicit RowCursor(std::span<const Run> runs) : runs_(runs) {}
  /// The particle at i if there is one at i + 1 too, else Body::no_particle.
  Particle pair_at(std::int32_t i) {
    while (run_ < runs_.size() && runs_[run_].end <= i + 1) ++run_;
    if (run_ == runs_.size() || runs_[run_].begin > i) return Body::no_particle;
    return runs_[run_].first + static_cast<Particle>(i - runs_[run_].begin);
  }

 private:
  std::span<const Run> runs_;
  std::size_t run_ = 0;
};

}  // namespace

bool CellWatch::is_due(std::uint64_t step) const {
  constexpr std::uint64_t every = 200;  // steps
  return seen_.has_looked == 0 || step >= seen_.last_looked + every;
}

void CellWatch::count(bool is_inside_out, Particle particle) {
  ++seen_.all;
  if (!is_inside_out) return;
  if (seen_.number == 0) found_ = particle;
  ++seen_.number;
}

bool CellWatch::look(const Simulation& simulation) {
  if (seen_.has_looked != 0 && simulation.steps() == seen_.last_looked) return false;
  is_torn_.clear();
  for (const Breakage& broken : simulation.breakages()) {
    is_torn_.resize(body_.particles, false);
    is_torn_[broken.a] = is_torn_[broken.b] = true;
  }
  seen_.all = seen_.number = 0;
  seen_.last_looked = simulation.steps();
  seen_.has_looked = 1;
  std::vector<double> moved;
  simulation.displacements(moved);
  if (body_.is_listed())
    look_at_list(moved);
  else
    look_at_cells(moved);
  const bool is_first = seen_.most == 0 && seen_.number > 0;
  if (is_first) {
    seen_.first_time = simulation.time();
    seen_.first_place = body_.position(found_);
  }
  seen_.most = std::max(seen_.most, seen_.number);
  return is_first;
}

void CellWatch::look_at_cells(std::span<const double> moved) {
  for (std::int32_t k = body_.low.k; k < body_.high.k; ++k)
    for (std::int32_t j = body_.low.j; j < body_.high.j; ++j) look_at_row(j, k, moved);
}

void CellWatch::look_at_row(std::int32_t j, std::int32_t k, std::span<const double> all_moved) {
  const Basis& basis = body_.grid.basis;
  const double upright = turn(basis[0], basis[1], basis[2]);
  RowCursor others[3] = {RowCursor(body_.row(j + 1, k)), RowCursor(body_.row(j, k + 1)), RowCursor(body_.row(j + 1, k + 1))};
  for (const Run& run : body_.row(j, k))
    for (std::int32_t i = run.begin; i + 1 < run.end; ++i) {
      Particle row[4] = {run.first + static_cast<Particle>(i - run.begin)};
      bool is_whole = true;
      for (std::size_t n = 0; n < 3; ++n) {
        row[n + 1] = others[n].pair_at(i);
        is_whole = is_whole && row[n + 1] != Body::no_particle;
      }
      if (!is_whole) continue;
      Vec3 moved[8];  // by corner: 1 along a1, 2 along a2, 4 along a3
      bool is_torn = false;
      for (std::size_t corner = 0; corner < 8; ++corner) {
        const Particle particle = row[corner >> 1] + (corner & 1);
        moved[corner] = (1 / body_.grid.spacing) * vector_at(all_moved, particle);
        is_torn = is_torn || (!is_torn_.empty() && is_torn_[particle]);
      }
      if (is_torn) continue;
      bool is_inside_out = false;
      for (std::size_t corner = 0; corner < 8; ++corner) {
        const auto edge = [&](std::size_t axis) { return basis[axis] + (moved[corner | 1U << axis] - moved[corner & ~(std::size_t{1} << axis)]); };
        is_inside_out = is_inside_out || turn(edge(0), edge(1), edge(2)) * upright <= 0;
      }
      count(is_inside_out, row[0]);
    }
}

/// Three springs of each particle, the first any, the others as far askew as they come.
void CellWatch::find_triples() {
  constexpr double flattest = 0.3;  // of a cube's corner
  std::vector<std::vector<std::uint32_t>> ends(body_.particles);
  for (const ListedSpring& spring : body_.listed.springs) {
    ends[spring.a].push_back(spring.b);
    ends[spring.b].push_back(spring.a);
  }
  triples_.assign(body_.particles, Triple{});
  for (Particle p = 0; p < body_.particles; ++p) {
    const auto way = [&](std::uint32_t to) {
      const Vec3 rest = body_.position(Particle{to}) - body_.position(p);
      return (1 / norm(rest)) * rest;
    };
    double area = 0, volume = 0;
    Triple triple{};
    if (ends[p].size() < 3) continue;
    triple[0] = ends[p][0];
    for (const std::uint32_t to : ends[p])
      if (const double size = norm(cross(way(triple[0]), way(to))); size > area) {
        area = size;
        triple[1] = to;
      }
    for (const std::uint32_t to : ends[p])
      if (const double size = std::abs(turn(way(triple[0]), way(triple[1]), way(to))); size > volume) {
        volume = size;
        triple[2] = to;
      }
    if (volume >= flattest) triples_[p] = triple;
  }
}

void CellWatch::look_at_list(std::span<const double> moved) {
  if (triples_.empty()) find_triples();
  for (Particle p = 0; p < body_.particles; ++p) {
    const Triple& triple = triples_[p];
    if (triple == Triple{} || (!is_torn_.empty() && is_torn_[p])) continue;
    Vec3 rest[3], now[3];
    for (std::size_t n = 0; n < 3; ++n) {
      rest[n] = (1 / body_.grid.spacing) * (body_.position(Particle{triple[n]}) - body_.position(p));
      now[n] = rest[n] + (1 / body_.grid.spacing) * (vector_at(moved, triple[n]) - vector_at(moved, p));
    }
    count(turn(rest[0], rest[1], rest[2]) * turn(now[0], now[1], now[2]) <= 0, p);
  }
}

std::string CellWatch::sentence() const {
  if (seen_.most == 0) return "";
  const Vec3 x = seen_.first_place;
  const std::string kind = body_.is_listed() ? "particles have neighbours that lie round them the wrong way" : "cells are inside out";
  return fmt::format(
      "the lattice folds through itself, which its springs do not resist: {} of {} {}, first seen at {} around ({:.4g}, {:.4g}, "
      "{:.4g}) m at rest{}; forces and energies there mean nothing",
      count_text(seen_.most), count_text(seen_.all), kind, quantity_text(seen_.first_time, "s"), x.x, x.y, x.z,
      seen_.number < seen_.most ? fmt::format(", {} at the end", count_text(seen_.number)) : "");
}

}  // namespace hyperlattice
