#include <model/spring_calls.hpp>
#include <state/failure_record.hpp>
#include <state/lost_cells.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <tuple>

namespace hyperlattice {
namespace {

/// The end of a spring: its displacement and height, and their changes in a step.
struct End {
  Vec3 place;
  double height = 0;
  Vec3 moved;
  double raised = 0;
};

/// Returns the end as it was `time`, s, before now, if its velocity was the present one since then.
End end_of(const Block& block, std::uint64_t n, int components, double time) {
  const auto moved = [&](int c) { return time * block.velocity[c][n]; };
  const auto place = [&](int c) { return block.displacement[c][n] - moved(c); };
  End end{{place(0), place(1), place(2)}, 0, {moved(0), moved(1), moved(2)}, 0};
  if (components == 4) {
    end.height = place(3);
    end.raised = moved(3);
  }
  return end;
}

std::uint32_t number_of(const Block& block) { return static_cast<std::uint32_t>(block.number); }

}  // namespace

void FailureRecord::collect(double step, bool in_ranks) {
  // The rank that found a breakage has all that its energy depends on.
  for (Block& block : blocks_)
    for (Block::Broken& broken : block.broken)
      if (broken.spring.is_first && !broken.softened)
        broken.energy = energy_of(block, broken, ends_of(block, broken), step);
  if (in_ranks && !blocks_.is_whole()) blocks_.gather_broken();
  /// What a breakage costs, J.
  struct Loss {
    double nodal_volumes = 0, spring = 0;
    std::size_t last_cell = 0;
  };
  std::vector<Loss> losses;
  std::vector<double> of_cells;
  for (Block& block : blocks_) {
    // Damage ends springs before the kernel breaks others.
    if (!blocks_.model().cohesive.empty())
      std::stable_sort(block.broken.begin(), block.broken.end(),
                       [](const Block::Broken& a, const Block::Broken& b) {
                         return std::tie(a.row, a.neighbour, a.site) <
                                std::tie(b.row, b.neighbour, b.site);
                       });
    for (const Block::Broken& broken : block.broken) {
      const SpringEnds& spring = broken.spring;
      if (!spring.is_first) continue;
      Breakage breakage;
      breakage.step = clock_.steps();
      breakage.time = clock_.time();
      breakage.a = spring.a;
      breakage.b = spring.b;
      breakage.neighbour = spring.neighbour;
      breakage.elongation = broken.elongation;
      breakage.softened = broken.softened;
      breakage.again = !broken.softened && softened_.contains({breakage.a, breakage.neighbour});
      breakages_.push_back(breakage);
      note(breakage, ends_of(block, broken));
      Loss& loss = losses.emplace_back();
      lose_cells(blocks_, breakage.a, breakage.neighbour, step, of_cells);
      loss.last_cell = of_cells.size();
      if (!pressures_.empty()) loss.nodal_volumes = pressures_.lose(breakage.a, breakage.b, step);
      if (!broken.softened) loss.spring = broken.energy;
    }
    block.broken.clear();
  }
  share(of_cells);
  std::size_t cell = 0;
  for (const Loss& loss : losses) {
    double cells = 0;
    for (; cell < loss.last_cell; ++cell) cells += of_cells[cell];
    energy_ += cells;
    energy_ += loss.nodal_volumes;
    energy_ += loss.spring;
  }
}

/// Completes numbers of which each is known to one rank and 0 in the others.
void FailureRecord::share(std::vector<double>& numbers) const {
  Ranks& ranks = blocks_.ranks();
  if (numbers.empty() || ranks.is_alone() || blocks_.is_whole()) return;
  ranks.meet(Ranks::Meeting::failures);
  std::vector<std::int64_t> bits(numbers.size());  // of 0 they are 0
  const auto to_bits = [](double number) { return std::bit_cast<std::int64_t>(number); };
  const auto to_number = [](std::int64_t of) { return std::bit_cast<double>(of); };
  std::transform(numbers.begin(), numbers.end(), bits.begin(), to_bits);
  ranks.sum(bits);
  std::transform(bits.begin(), bits.end(), numbers.begin(), to_number);
}

/// Adds what follows from the last breakage.
void FailureRecord::note(const Breakage& breakage, Ends ends) {
  ends.neighbour = breakage.neighbour;
  ends.counts = !breakage.again;
  ends_.push_back(ends);
  if (breakage.softened) softened_.insert({breakage.a, breakage.neighbour});
  if (breakage.again) ++again_;
}

FailureRecord::Ends FailureRecord::find_ends(Particle a, Particle b) const {
  const auto [block_a, place_a] = blocks_.at(a);
  const auto [block_b, place_b] = blocks_.at(b);
  return {place_a, place_b, number_of(*block_a), number_of(*block_b)};
}

/// Returns the same as find_ends() of a spring that a kernel named. The kernel of a structured body
/// knows the places of ends in its own block: no search through the body is needed.
FailureRecord::Ends FailureRecord::ends_of(const Block& block, const Block::Broken& broken) const {
  const SpringEnds& spring = broken.spring;
  if (blocks_.model().body.is_listed()) return find_ends(spring.a, spring.b);
  const Row& row = block.rows[broken.row];
  const std::uint64_t a = row.start + static_cast<std::uint64_t>(broken.site - row.begin),
                      b = blocks_.layout().other_end(block.number, broken.row, broken.neighbour,
                                                     broken.site);
  if (b < block.rows[block.layout->last_own].start)
    return {a, b, number_of(block), number_of(block)};
  const auto [block_b, place_b] = blocks_.at(spring.b);
  return {a, place_b, number_of(block), number_of(*block_b)};
}

/// Returns the energy lost with a base spring and its cross springs, J. They pulled during the step
/// that found them broken, so the lost energy includes half a step of that work: this keeps the
/// scheme's balance exact to second order.
double FailureRecord::energy_of(const Block& block, const Block::Broken& broken, const Ends& where,
                                double step) const {
  const Model& model = blocks_.model();
  const SpringProperties properties =
      model.spring_properties(broken.spring.a, broken.spring.b, broken.spring.neighbour);
  const End a = end_of(blocks_[where.block_a], where.a, model.degrees_of_freedom, step),
            b = end_of(blocks_[where.block_b], where.b, model.degrees_of_freedom, step);

  const Vec3 d = b.place - a.place, moved = b.moved - a.moved;
  const double rate_in_space = 2 * dot(properties.rest + d, moved);
  // Growth and its rate are those of the squared length, as in kernels/springs.hpp.
  const double delta = model.body.grid.membrane_distance;
  const auto lost = [&](std::size_t cross, double rise, double rate) {
    const double growth = properties.growth(cross, d, rise, delta),
                 length = properties.length(cross, growth);
    const LawNumbers memory =
        blocks_.law_numbers(block, broken.row, broken.neighbour, broken.site, cross != 0);
    const CompositeAnswer answer =
        ask_spring(model, properties, cross, properties.elongation(cross, growth), memory.data());
    return answer.stored + 0.5 * answer.force * rate / (2 * length);
  };
  const double difference = b.height - a.height, total = b.height + a.height;
  double energy = lost(0, difference, rate_in_space + 2 * difference * (b.raised - a.raised));
  if (model.springs.choice.membrane != KernelChoice::Membrane::none)
    energy += lost(1, total, rate_in_space + 2 * (delta + total) * (b.raised + a.raised));
  return energy * properties.share;
}

/// Returns the growth of the squared length of a broken base spring, m2, and its rest length, m.
FailureRecord::Growth FailureRecord::growth_now(const Ends& where) const {
  const Model& model = blocks_.model();
  SpringProperties geometry;  // its rest vector and length are all that is needed
  if (model.body.is_listed()) {
    const Listed& list = model.body.listed;
    const ListedSpring& spring = list.springs[where.neighbour];
    geometry.rest = list.positions[spring.b] - list.positions[spring.a];
    geometry.rest_length = norm(geometry.rest);
  } else {
    const NeighbourGeometry& to = model.springs.neighbours[where.neighbour];
    geometry.rest = to.rest;
    geometry.rest_length = to.rest_length;
  }
  const auto& from = blocks_[where.block_a].displacement;
  const auto& to = blocks_[where.block_b].displacement;
  const auto apart = [&](int c) { return to[c][where.b] - from[c][where.a]; };
  const double rise = model.degrees_of_freedom == 4 ? apart(3) : 0;
  return {
      geometry.growth(0, {apart(0), apart(1), apart(2)}, rise, model.body.grid.membrane_distance),
      geometry.rest_length};
}

double FailureRecord::elongation_now(std::size_t index) const {
  const Growth now = growth_now(ends_[index]);
  SpringProperties geometry;
  geometry.rest_length = now.rest_length;
  return geometry.elongation(0, now.of_square);
}

std::uint64_t FailureRecord::open() {
  arrange();
  std::array<std::int64_t, 1> open{static_cast<std::int64_t>(
      count_open(by_place_) + count_open(std::span(ends_).subspan(by_place_.size())))};
  Ranks& ranks = blocks_.ranks();
  ranks.meet(Ranks::Meeting::failures);
  ranks.sum(open);
  return static_cast<std::uint64_t>(open[0]);
}

/// Arranges failures by their places: a count then reads the state in the order of the memory. The
/// latest failures wait until they are many.
void FailureRecord::arrange() {
  const std::size_t before = by_place_.size();
  if (ends_.size() - before <= before / 4) return;
  const auto precedes = [](const Ends& l, const Ends& r) {
    return l.block_a != r.block_a ? l.block_a < r.block_a : l.a < r.a;
  };
  const auto next = static_cast<std::ptrdiff_t>(before);
  by_place_.insert(by_place_.end(), ends_.begin() + next, ends_.end());
  std::sort(by_place_.begin() + next, by_place_.end(), precedes);
  std::inplace_merge(by_place_.begin(), by_place_.begin() + next, by_place_.end(), precedes);
}

std::uint64_t FailureRecord::count_open(std::span<const Ends> failures) const {
  constexpr std::size_t piece = 1024;  // failures
  std::atomic<std::uint64_t> open = 0;
  blocks_.team().for_each((failures.size() + piece - 1) / piece, [&](std::size_t number) {
    const std::size_t first = number * piece;
    std::uint64_t here = 0;
    for (const Ends& ends : failures.subspan(first, std::min(piece, failures.size() - first)))
      here +=
          ends.counts && blocks_.is_mine(blocks_[ends.block_a]) && growth_now(ends).of_square > 0
              ? 1
              : 0;
    open += here;
  });
  return open;
}

void FailureRecord::archive(Archive& archive) {
  archive(breakages_);
  archive(energy_);
  if (!archive.restores()) return;
  ends_.clear();
  by_place_.clear();
  softened_.clear();
  again_ = 0;
  for (const Breakage& breakage : breakages_) {
    note(breakage, find_ends(breakage.a, breakage.b));
    if (!pressures_.empty()) pressures_.lose(breakage.a, breakage.b, 0);
  }
}

}  // namespace hyperlattice
