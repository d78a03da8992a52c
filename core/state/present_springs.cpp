#include <state/block_set.hpp>
#include <state/present_springs.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

std::size_t whole_vectors(std::size_t springs) {
  return (springs + std::size_t{lanes} - 1) / lanes * lanes;
}

/// The plane's first particle; the number of all particles if there is none from this plane on.
Particle first_of_plane(const Body& body, std::int32_t k) {
  const std::size_t row =
      static_cast<std::size_t>(k) * static_cast<std::size_t>(body.grid.sites[1]);
  const std::size_t run = body.row_runs[row];
  return run < body.runs.size() ? body.runs[run].first : body.particles;
}

}  // namespace

/// Springs of one law and one set of constants to one neighbour, for the vector functions of the
/// law.
class PresentSprings::Row {
 public:
  Row(const Model& model, std::size_t most) : width_(whole_vectors(most)) {
    numbers_.assign(13 * width_, 0);
    double* next = numbers_.data();
    const auto take = [&] { return std::exchange(next, next + width_); };
    for (int c = 0; c < model.degrees_of_freedom; ++c) {
      row_.here[c] = here_[c] = take();
      row_.there[c] = there_[c] = take();
    }
    row_.stiffness = stiffness_ = take();
    row_.cross_stiffness = cross_stiffness_ = take();
    row_.weight = weight_ = take();
    row_.pull = take();
    row_.cross_pull = take();
    unused_.assign(width_, 0);
    row_.axial = row_.cross_axial = unused_.data();
    row_.membrane_distance = model.body.grid.membrane_distance;
    row_.spacing = model.body.grid.spacing;
  }

  /// Returns force over length of each spring of a piece, 0 for those that are broken.
  void pulls(const PresentSprings& all, const Piece& piece, const SpringConstants& constants,
             const Law& law, double* pull) {
    const NeighbourGeometry& to = all.model_.springs.neighbours[piece.neighbour];
    row_.count = static_cast<int>(piece.count);
    row_.rest = to.rest;
    row_.rest_length = to.rest_length;
    row_.cross_rest_length = to.cross_rest_length;
    for (std::size_t cross = 0; cross < 2; ++cross) row_.law[cross] = constants.law[cross];
    for (std::size_t t = 0; t < piece.count; ++t) {
      const std::size_t a = piece.a + t, b = piece.b + t;
      for (std::size_t c = 0; c < 3; ++c) {
        here_[c][t] = all.displacements_[3 * a + c];
        there_[c][t] = all.displacements_[3 * b + c];
      }
      if (here_[3] != nullptr) {
        here_[3][t] = all.heights_[a];
        there_[3][t] = all.heights_[b];
      }
      stiffness_[t] = constants.stiffness;
      cross_stiffness_[t] = constants.cross_stiffness;
      weight_[t] = all.lives(a, piece.neighbour) ? 1 : 0;
    }
    std::fill(weight_ + piece.count, weight_ + whole_vectors(piece.count), 0.0);
    linearise_springs(law, row_);
    const bool has_cross = all.model_.springs.choice.membrane != KernelChoice::Membrane::none;
    for (std::size_t t = 0; t < piece.count; ++t)
      pull[t] = row_.pull[t] + (has_cross ? row_.cross_pull[t] : 0);
  }

 private:
  std::size_t width_;
  std::vector<double> numbers_, unused_;
  double *here_[4] = {}, *there_[4] = {};
  double *stiffness_ = nullptr, *cross_stiffness_ = nullptr, *weight_ = nullptr;
  SpringRow row_;
};

PresentSprings::PresentSprings(const Model& model, const Simulation& simulation)
    : model_(model), simulation_(simulation) {
  simulation.displacements(displacements_);
  simulation.heights(heights_);
  if (!model.body.is_listed()) {
    simulation.alive(alive_);
    soft_.resize(model.body.neighbours.size());
    for (const SoftSpring& spring : simulation.soft_springs()) {
      std::uint16_t& bits = alive_[spring.a];
      bits = static_cast<std::uint16_t>(bits | 1U << spring.neighbour);
      soft_[spring.neighbour].push_back(spring);
    }
    for (const SoftCell& cell : simulation.soft_cells())
      soft_cells_.emplace_back(cell.lowest, cell.factor);
    for (const SoftParticle& soft : simulation.soft_particles())
      soft_alphas_.emplace_back(soft.particle, soft.alpha_factor);
    return;
  }
  for (const Breakage& breakage : simulation.breakages()) {
    if (breakage.softened) continue;  // the spring is still there
    broken_.resize(model.body.listed.springs.size(), 0);
    broken_[breakage.neighbour] = 1;
  }
  if (model.springs.memory == 0) return;
  memory_.resize(model.body.listed.springs.size());
  simulation.for_springs_of_list(
      [&](const Simulation::SpringMemory& spring) { memory_[spring.index] = spring; });
}

double PresentSprings::factor_of(Particle particle, const Factors& factors) {
  const auto found =
      std::lower_bound(factors.begin(), factors.end(), particle,
                       [](const auto& factor, Particle wanted) { return factor.first < wanted; });
  return found != factors.end() && found->first == particle ? found->second : 1;
}

/// The memory is that of the last step's start and stays so, as in a measurement.
SpringPull PresentSprings::ask(const SpringProperties& properties, Particle a, Particle b,
                               const Layout::Memory (&memory)[2], std::uint32_t first,
                               double remains) const {
  return pull_of(
      model_, properties, {displacement(b) - displacement(a), height(a), height(b)},
      simulation_.last_step(),
      [&](std::size_t cross) {
        const Layout::Memory& all = memory[cross];
        if (all.first == nullptr) return LawNumbers{};
        return read_numbers({all.first + first * all.stride, all.stride},
                            model_.springs.memory - first);
      },
      remains);
}

void PresentSprings::find_memory(Particle a, std::uint32_t neighbour,
                                 Layout::Memory (&memory)[2]) const {
  if (model_.springs.memory == 0) return;
  for (const bool cross : {false, true})
    if (!cross || model_.springs.choice.membrane != KernelChoice::Membrane::none)
      memory[cross ? 1 : 0] = simulation_.law_memory(a, neighbour, cross);
}

SpringPull PresentSprings::part_of(Particle a, Particle b, std::uint32_t neighbour,
                                   std::uint8_t material) const {
  if (!lives(a, neighbour)) return {};
  const auto soft = soft_in({neighbour, a, b, 1});
  const double remains = soft.empty() ? 1 : soft.front().factor;
  SpringProperties properties = model_.spring_properties(a, b, neighbour);
  const SpringConstants& own = model_.springs.spring(material, material, properties.spring_class);
  std::uint32_t first = 0;
  if (properties.composite != nullptr) {
    const auto parts = properties.composite->parts();
    for (std::size_t n = 0; n < parts.size(); ++n)
      if (parts[n].material == material) first = properties.composite->first_number(n);
  }
  properties.composite = nullptr;
  properties.stiffness = own.stiffness;
  properties.cross_stiffness = own.cross_stiffness;
  properties.law = model_.materials[material].law;
  for (const std::size_t cross : {0U, 1U}) properties.constants[cross] = own.law[cross];
  Layout::Memory memory[2];
  find_memory(a, neighbour, memory);
  return ask(properties, a, b, memory, first, remains);
}

template <class Visit>
void PresentSprings::for_pieces(std::int32_t k, std::uint32_t neighbours,
                                const Visit& visit) const {
  const Body& body = model_.body;
  for (std::int32_t j = body.low.j; j <= body.high.j; ++j)
    for (std::uint32_t n = 0; n < body.neighbours.size(); ++n) {
      if ((neighbours >> n & 1U) == 0) continue;
      const Neighbour& to = body.neighbours[n];
      for (const Range& range : body.springs_of(j, k, to))
        visit(Piece{n, body.at({range.begin, j, k}),
                    body.at({range.begin + to.dx, j + to.dy, k + to.dz}),
                    static_cast<std::uint64_t>(range.end - range.begin)});
    }
}

/// Computes the springs of a piece, in runs of one set of constants: with the vector functions of
/// the law, or one after another if the law has a memory, if the springs are composite, or if
/// their energies are asked for.
void PresentSprings::compute(const Piece& piece, Asked asked, Row& row,
                             PlaneSprings& springs) const {
  const auto constants = [&](std::uint64_t t) -> const SpringConstants& {
    return model_.springs.spring_to(piece.neighbour, model_.kinds.of(piece.a + t),
                                    model_.kinds.of(piece.b + t));
  };
  for (std::uint64_t start = 0, end = 0; start < piece.count; start = end) {
    const SpringConstants& own = constants(start);
    const bool alike = model_.materials.size() == 1;
    for (end = alike ? piece.count : start + 1; end < piece.count && &constants(end) == &own;)
      ++end;
    const Piece part{piece.neighbour, piece.a + start, piece.b + start, end - start};
    const SpringProperties properties = model_.spring_properties(part.a, part.b, part.neighbour);
    const std::size_t at = springs.index(part.neighbour, part.a);
    const Law& law = model_.springs.laws[properties.law];
    if (asked == Asked::forces && properties.composite == nullptr && law.kernels.memory == 0) {
      row.pulls(*this, part, own, law, &springs.pull[at]);
      continue;
    }
    for (std::uint64_t t = 0; t < part.count; ++t) {
      if (!lives(part.a + t, part.neighbour)) continue;
      Layout::Memory memory[2];
      find_memory(part.a + t, part.neighbour, memory);
      const SpringPull answer = ask(properties, part.a + t, part.b + t, memory);
      springs.pull[at + t] = answer.pull;
      if (asked == Asked::energies) springs.energy[at + t] = answer.energy;
    }
  }
  for (const SoftSpring& soft : soft_in(piece)) {
    const SpringPull answer = ask(model_.spring_properties(soft.a, soft.b, piece.neighbour), soft.a,
                                  soft.b, {}, 0, soft.factor);
    const std::size_t at = springs.index(piece.neighbour, soft.a);
    springs.pull[at] = answer.pull;
    if (asked == Asked::energies) springs.energy[at] = answer.energy;
  }
}

/// Returns the soft springs of a piece.
std::span<const SoftSpring> PresentSprings::soft_in(const Piece& piece) const {
  const std::vector<SoftSpring>& all = soft_[piece.neighbour];
  const auto from = [&](Particle first) {
    return std::lower_bound(
        all.begin(), all.end(), first,
        [](const SoftSpring& spring, Particle particle) { return spring.a < particle; });
  };
  return {from(piece.a), from(piece.a + piece.count)};
}

PlaneSprings PresentSprings::plane(std::int32_t k, Asked asked, std::uint32_t neighbours) const {
  PlaneSprings springs;
  springs.first = first_of_plane(model_.body, k);
  springs.count = first_of_plane(model_.body, k + 1) - springs.first;
  if (asked == Asked::motion) return springs;
  const std::size_t numbers = springs.count * model_.body.neighbours.size();
  springs.pull.assign(numbers, 0);
  if (asked == Asked::energies) springs.energy.assign(numbers, 0);
  Row row(model_, static_cast<std::size_t>(model_.body.grid.sites[0]));
  for_pieces(k, neighbours, [&](const Piece& piece) { compute(piece, asked, row, springs); });
  return springs;
}

void PresentSprings::for_springs(Asked asked,
                                 const std::function<void(const PresentSpring&)>& visit) const {
  const Body& body = model_.body;
  if (body.is_listed()) return visit_list(asked, visit);
  // The springs of a plane act on it and on `reach` planes after it.
  const std::int32_t colours = body.reach + 1;
  for (std::int32_t colour = 0; colour < colours; ++colour) {
    const std::int32_t planes = (body.high.k - body.low.k - colour + colours) / colours;
    simulation_.in_parallel(static_cast<std::size_t>(planes), [&](std::size_t n) {
      visit_plane(body.low.k + colour + static_cast<std::int32_t>(n) * colours, asked, visit);
    });
  }
}

void PresentSprings::visit_plane(std::int32_t k, Asked asked,
                                 const std::function<void(const PresentSpring&)>& visit) const {
  const PlaneSprings springs = plane(k, asked);
  PresentSpring spring;
  for_pieces(k, ~0U, [&](const Piece& piece) {
    const Neighbour& to = model_.body.neighbours[piece.neighbour];
    spring.neighbour = piece.neighbour;
    spring.rest = model_.springs.neighbours[piece.neighbour].rest;
    Site site = model_.body.site(piece.a);
    for (std::uint64_t t = 0; t < piece.count; ++t, ++site.i) {
      spring.a = piece.a + t;
      spring.b = piece.b + t;
      if (!lives(spring.a, spring.neighbour)) continue;
      spring.apart = displacement(spring.b) - displacement(spring.a);
      if (!model_.body.cells.empty()) spring.share = model_.body.share(site, to);
      const std::size_t at = springs.index(spring.neighbour, spring.a);
      if (asked != Asked::motion) spring.pull = springs.pull[at];
      if (asked == Asked::energies) spring.energy = springs.energy[at];
      visit(spring);
    }
  });
}

void PresentSprings::visit_list(Asked asked,
                                const std::function<void(const PresentSpring&)>& visit) const {
  constexpr std::size_t piece = 1024;  // springs, for any number of threads
  const std::vector<ListedSpring>& listed = model_.body.listed.springs;
  const auto is_broken = [&](std::size_t n) { return !broken_.empty() && broken_[n] != 0; };
  std::vector<SpringPull> answers(asked == Asked::motion ? 0 : listed.size());
  simulation_.in_parallel((answers.size() + piece - 1) / piece, [&](std::size_t part) {
    for (std::size_t n = part * piece; n < std::min(listed.size(), (part + 1) * piece); ++n) {
      if (is_broken(n)) continue;
      Layout::Memory memory[2];
      for (const std::size_t cross : {0U, 1U})
        if (!memory_.empty()) memory[cross] = memory_[n].of[cross];
      const Particle a = listed[n].a, b = listed[n].b;
      answers[n] = ask(model_.spring_properties(a, b, static_cast<std::uint32_t>(n)), a, b, memory);
    }
  });
  PresentSpring spring;
  for (std::size_t n = 0; n < listed.size(); ++n) {
    if (is_broken(n)) continue;
    spring.a = listed[n].a;
    spring.b = listed[n].b;
    spring.neighbour = static_cast<std::uint32_t>(n);
    spring.rest = model_.body.position(spring.b) - model_.body.position(spring.a);
    spring.apart = displacement(spring.b) - displacement(spring.a);
    if (asked != Asked::motion) {
      spring.pull = answers[n].pull;
      spring.energy = answers[n].energy;
    }
    visit(spring);
  }
}

}  // namespace hyperlattice
