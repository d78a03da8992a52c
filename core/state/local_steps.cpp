#include <model/law.hpp>
#include <model/local_limits.hpp>
#include <state/local_steps.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <tuple>

namespace hyperlattice {

namespace {

constexpr std::uint32_t piece_length = 256;  // springs, or ends

/// Buffers for the springs of a piece.
struct Buffers {
  double here[3][piece_length], there[3][piece_length], pull[piece_length], axial[piece_length],
      cross_pull[piece_length], cross_axial[piece_length];
};

}  // namespace

std::vector<LocalMove> local_moves(std::int64_t parts) {
  constexpr double nu = 0.01;
  const auto p = static_cast<double>(parts);
  const double at = std::acosh(1 + nu / (p * p));
  const auto chebyshev = [&](std::int64_t m) { return std::cosh(static_cast<double>(m) * at); };
  // T_p'(cosh a) = p sinh(p a) / sinh a
  const double c = 2 * p * std::tanh(p * at) / std::sinh(at);
  std::vector<LocalMove> moves(static_cast<std::size_t>(parts));
  for (std::int64_t m = 0; m < parts; ++m) {
    LocalMove& move = moves[static_cast<std::size_t>(m)];
    move.keeps = m == 0 ? 0 : chebyshev(m - 1) / chebyshev(m + 1);
    move.kick = (m == 0 ? 1 : 2) * chebyshev(m) / (c * chebyshev(m + 1));
  }
  // A kick counts in the place at the end by what all later moves keep of it.
  double later = 0;
  for (std::size_t m = moves.size(); m-- > 0;) {
    const double kept = m + 1 < moves.size() ? moves[m + 1].keeps : 0;
    later = 1 + kept * later;
    moves[m].weight = 2 * moves[m].kick * later;
  }
  return moves;
}

void LocalForces::start(double time_step, std::int64_t parts) {
  stiff_.clear();
  if (parts > 1) {
    moves_ = local_moves(parts);
    const LocalLimits limits(model_);
    constexpr double round_off = 1e-9;
    stiff_.resize(model_.body.particles);
    for (Particle p = 0; p < stiff_.size(); ++p)
      stiff_[p] = limits[p] < time_step * (1 - round_off) ? 1 : 0;
  }
  arrange();
}

/// Finds the springs that exist now, so that a run that is resumed has the same arrays.
void LocalForces::arrange() {
  for (const End& end : ends_) {
    Block& block = blocks_[end.block];
    block.rows[end.row].law = block.layout->rows[end.row].law;
  }
  ends_.clear();
  springs_.clear();
  if (stiff_.empty()) return;
  find_ends();
  add_springs();
  find_pieces();
}

/// Finds the stiff particles and those beside them.
void LocalForces::find_ends() {
  std::vector<std::uint8_t> chosen = stiff_;
  for (const Block& block : blocks_)
    blocks_.layout().for_springs(block, [&](const SpringPlace& spring) {
      const Particle a = spring.ends.a, b = spring.ends.b;
      if (spring.counts && (stiff_[a] | stiff_[b]) != 0) chosen[a] = chosen[b] = 1;
    });
  particles_.clear();
  rows_.assign(blocks_.size(), {});
  for (Block& block : blocks_) {
    rows_[block.number].resize(block.rows.size());
    block.other_sums.resize(block.rows.size());
  }
  for (Particle p = 0; p < chosen.size(); ++p) {
    if (chosen[p] == 0) continue;
    const Place place = blocks_.layout().place(p);
    End end;
    end.block = static_cast<std::uint32_t>(place.block);
    end.row = place.row;
    end.site = place.site;
    end.index = place.index;
    end.mass = model_.mass(p);
    end.stiff = stiff_[p] != 0;
    Block& block = blocks_[place.block];
    const auto& supports = block.boundary_particles;
    for (std::uint32_t n = block.rows[place.row].first_boundary_particle;
         n < block.rows[place.row].last_boundary_particle; ++n)
      if (supports[n].index == place.index) end.support = n;
    auto& [begin, last] = rows_[place.block][place.row];
    const auto number = static_cast<std::uint32_t>(ends_.size());
    if (last == 0) begin = number;
    last = number + 1;
    if (block.rows[place.row].law == 0) block.rows[place.row].law = first_law_and_more;
    ends_.push_back(end);
    particles_.push_back(p);
  }
  for (auto* fields : {&moved_, &change_, &outer_})
    for (std::vector<double>& field : *fields) field.assign(ends_.size(), 0);
}

void LocalForces::add_springs() {
  const auto number_of = [&](Particle p) {
    return static_cast<std::uint32_t>(std::lower_bound(particles_.begin(), particles_.end(), p) -
                                      particles_.begin());
  };
  for (const Block& block : blocks_)
    blocks_.layout().for_springs(block, [&](const SpringPlace& place) {
      const auto [a, b, neighbour, is_first] = place.ends;
      if (!place.counts || (stiff_[a] | stiff_[b]) == 0) return;
      springs_.push_back(
          {number_of(a), number_of(b), neighbour,
           &model_.springs.spring_to(neighbour, model_.kinds.of(a), model_.kinds.of(b)),
           model_.spring_properties(a, b, neighbour).share,
           static_cast<std::uint32_t>(block.number), place.row, place.site});
    });
  std::sort(springs_.begin(), springs_.end(), [](const Spring& l, const Spring& r) {
    return std::tie(l.neighbour, l.constants, l.a) < std::tie(r.neighbour, r.constants, r.a);
  });
  bits_.assign(blocks_.size(), {});
  for (const Block& block : blocks_)
    blocks_.layout().for_springs(block, [&](const SpringPlace& place) {
      const auto [a, b, neighbour, is_first] = place.ends;
      if ((stiff_[a] | stiff_[b]) == 0) return;
      const SpringConstants* constants =
          &model_.springs.spring_to(neighbour, model_.kinds.of(a), model_.kinds.of(b));
      const std::uint32_t first = number_of(a);
      const auto found = std::lower_bound(
          springs_.begin(), springs_.end(), std::tuple(neighbour, constants, first),
          [](const Spring& spring, const auto& key) {
            return std::tuple(spring.neighbour, spring.constants, spring.a) < key;
          });
      // The bits of ghosts may be out of date.
      if (found == springs_.end() || found->neighbour != neighbour ||
          found->constants != constants || found->a != first)
        return;
      const Row& row = block.rows[place.row];
      bits_[block.number].push_back({row.start + static_cast<std::uint64_t>(place.site - row.begin),
                                     static_cast<std::uint16_t>(1U << place.neighbour),
                                     static_cast<std::uint32_t>(found - springs_.begin())});
    });
  for (std::vector<double>& field : force_) field.assign(springs_.size(), 0);
}

void LocalForces::find_pieces() {
  pieces_.clear();
  for (std::uint32_t n = 0; n < springs_.size(); ++n) {
    const bool goes_on = !pieces_.empty() &&
                         springs_[n].neighbour == springs_[pieces_.back().begin].neighbour &&
                         springs_[n].constants == springs_[pieces_.back().begin].constants &&
                         n - pieces_.back().begin < piece_length;
    if (!goes_on) {
      pieces_.emplace_back();
      pieces_.back().begin = n;
    }
    pieces_.back().end = n + 1;
  }
  for (Piece& piece : pieces_) {
    const std::uint32_t count = piece.end - piece.begin,
                        padded = (count + lanes - 1) / lanes * lanes;
    for (std::uint32_t t = 0; t < padded; ++t) {
      const Spring& spring = springs_[piece.begin + std::min(t, count - 1)];
      piece.a.push_back(spring.a);
      piece.b.push_back(spring.b);
      piece.weight.push_back(t < count ? spring.share : 0);
      piece.stiffness.push_back(spring.constants->stiffness);
      piece.cross_stiffness.push_back(spring.constants->cross_stiffness);
    }
  }
  first_pull_.assign(ends_.size() + 1, 0);
  for (const Spring& spring : springs_)
    for (const std::uint32_t end : {spring.a, spring.b}) ++first_pull_[end + 1];
  for (std::size_t n = 0; n < ends_.size(); ++n) first_pull_[n + 1] += first_pull_[n];
  pulls_.resize(2 * springs_.size());
  std::vector<std::uint32_t> next(first_pull_.begin(), first_pull_.end() - 1);
  for (std::uint32_t n = 0; n < springs_.size(); ++n) {
    pulls_[next[springs_[n].a]++] = {n, 1};
    pulls_[next[springs_[n].b]++] = {n, -1};
  }
}

/// Calls visit(block, bit) for the bits of all springs, and of their copies in other blocks.
template <class Visit>
void LocalForces::for_bits(const Visit& visit) {
  blocks_.team().for_each(blocks_.size(), [&](std::size_t b) {
    for (const Bit& bit : bits_[b]) visit(blocks_[b], bit);
  });
}

void LocalForces::clear(Block& block, const Bit& bit) {
  block.alive[bit.index] = static_cast<std::uint16_t>(block.alive[bit.index] & ~bit.bit);
}

void LocalForces::give_back() {
  for_bits([](Block& block, const Bit& bit) {
    block.alive[bit.index] = static_cast<std::uint16_t>(block.alive[bit.index] | bit.bit);
  });
}

/// Asks the failure criteria about the springs, in the present state, and removes those that break.
void LocalForces::review() {
  blocks_.team().for_each(blocks_.size(), [&](std::size_t b) {
    for (Spring& spring : springs_) {
      if (spring.block != b || !(spring.constants->alarm < infinity)) continue;
      const SpringEnds ends{particles_[spring.a], particles_[spring.b], spring.neighbour, true};
      const double elongation =
          blocks_.elongation(ends, model_.spring_properties(ends.a, ends.b, ends.neighbour));
      if (elongation > spring.constants->alarm &&
          *review_.review(blocks_[b],
                          {spring.row, spring.neighbour, {&spring.site, 1}, {&elongation, 1}}) != 0)
        spring.broken = true;
    }
  });
  if (std::none_of(springs_.begin(), springs_.end(), [](const Spring& one) { return one.broken; }))
    return;
  for_bits([&](Block& block, const Bit& bit) {
    if (springs_[bit.spring].broken) clear(block, bit);
  });
  arrange();
}

void LocalForces::read_motion() {
  const Vec3 acceleration = loads_.gravity() * model_.loads.acceleration;
  for (std::size_t n = 0; n < ends_.size(); ++n) {
    const End& end = ends_[n];
    const Block& block = blocks_[end.block];
    const BoundaryParticle* support =
        end.support == no_support ? nullptr : &block.boundary_particles[end.support];
    for (int c = 0; c < 3; ++c) {
      const auto axis = static_cast<std::size_t>(c);
      moved_[axis][n] = block.displacement[c][end.index];
      change_[axis][n] = 0;
      outer_[axis][n] = end.mass * acceleration[c] + (support == nullptr ? 0 : support->force[c]);
    }
  }
}

/// Computes the forces of the springs of a piece, and its energy.
void LocalForces::find_forces(Piece& piece, bool keeps_energy) {
  // Not in the thread's own memory: a program that loads this library later, as Python does, has
  // only about 1 kB of it left.
  thread_local const auto own_buffer = std::make_unique<Buffers>();
  Buffers& buffer = *own_buffer;
  const Spring& first = springs_[piece.begin];
  const NeighbourGeometry& geometry = model_.springs.neighbours[first.neighbour];
  const std::uint32_t count = piece.end - piece.begin;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t t = 0; t < piece.a.size(); ++t) {
      buffer.here[c][t] = moved_[c][piece.a[t]];
      buffer.there[c][t] = moved_[c][piece.b[t]];
    }
  SpringRow row;
  row.count = static_cast<int>(count);
  for (int c = 0; c < 3; ++c) {
    row.here[c] = buffer.here[c];
    row.there[c] = buffer.there[c];
  }
  row.rest = geometry.rest;
  row.rest_length = geometry.rest_length;
  row.cross_rest_length = geometry.cross_rest_length;
  row.membrane_distance = model_.body.grid.membrane_distance;
  row.spacing = model_.body.grid.spacing;
  row.stiffness = piece.stiffness.data();
  row.cross_stiffness = piece.cross_stiffness.data();
  row.weight = piece.weight.data();
  row.pull = buffer.pull;
  row.axial = buffer.axial;
  row.cross_pull = buffer.cross_pull;
  row.cross_axial = buffer.cross_axial;
  for (const std::size_t cross : {0U, 1U}) row.law[cross] = first.constants->law[cross];
  const bool has_cross = model_.springs.choice.membrane != KernelChoice::Membrane::none;
  const double energy = linearise_springs(model_.springs.laws.front(), row);
  if (keeps_energy) piece.stored = energy;
  for (std::uint32_t t = 0; t < count; ++t) {
    const double pull = buffer.pull[t] + (has_cross ? buffer.cross_pull[t] : 0);
    for (int c = 0; c < 3; ++c)
      force_[static_cast<std::size_t>(c)][piece.begin + t] =
          pull * (geometry.rest[c] + (buffer.there[c][t] - buffer.here[c][t]));
  }
}

/// Adds the forces on these ends to their means, and moves the stiff ones.
void LocalForces::move(std::uint32_t first, std::uint32_t last, const LocalMove& move,
                       double step) {
  for (std::uint32_t n = first; n < last; ++n) {
    End& end = ends_[n];
    double force[3] = {};
    for (std::uint32_t p = first_pull_[n]; p < first_pull_[n + 1]; ++p)
      for (std::size_t c = 0; c < 3; ++c) force[c] += pulls_[p].sign * force_[c][pulls_[p].spring];
    const std::uint32_t held =
        end.support == no_support ? 0 : blocks_[end.block].boundary_particles[end.support].axes;
    for (std::size_t c = 0; c < 3; ++c) {
      end.force[c] += move.weight * force[c];
      if (!end.stiff || (held >> c & 1U) != 0) continue;
      change_[c][n] = move.keeps * change_[c][n] +
                      step * step * move.kick / end.mass * (force[c] + outer_[c][n]);
      moved_[c][n] += change_[c][n];
    }
  }
}

LocalForces::Taken LocalForces::compute(double step, bool breaks) {
  if (empty()) return Taken(nullptr);
  if (breaks && model_.springs.criteria) review();
  if (empty()) return Taken(nullptr);
  for_bits([](Block& block, const Bit& bit) { clear(block, bit); });
  Taken taken(this);
  read_motion();
  for (End& end : ends_) {
    end.force = {};
    end.stored = 0;
  }
  const auto count = static_cast<std::uint32_t>(ends_.size());
  const std::vector<LocalMove> at_once{{0, 0, 1}};  // the forces of the present state
  const std::vector<LocalMove>& moves = step > 0 ? moves_ : at_once;
  for (const LocalMove& one : moves) {
    const bool first = &one == &moves.front();
    blocks_.team().for_each(pieces_.size(), [&](std::size_t n) { find_forces(pieces_[n], first); });
    blocks_.team().for_each((count + piece_length - 1) / piece_length, [&](std::size_t n) {
      const auto begin = static_cast<std::uint32_t>(n) * piece_length;
      move(begin, std::min(begin + piece_length, count), one, step);
    });
  }
  for (const Piece& piece : pieces_)  // only sums over the whole body have a meaning
    ends_[springs_[piece.begin].a].stored += piece.stored;
  return taken;
}

}  // namespace hyperlattice
