#include <model/spring_calls.hpp>
#include <state/other_rows.hpp>

#include <algorithm>
#include <cmath>

namespace hyperlattice {
namespace {

/// The springs of one row, with all that is alike for them.
class SeveralLaws {
 public:
  SeveralLaws(const Model& model, const KernelRequest& request, bool measures)
      : model_(model),
        time_step_(2 * request.back),
        delta_(request.membrane_distance),
        kinds_(model.springs.choice.membrane == KernelChoice::Membrane::none ? 1 : 2),
        free_(model.springs.choice.membrane == KernelChoice::Membrane::free),
        measures_(measures) {}

  /// A spring between two particles: displacements and heights there less those here, and the sum
  /// of the heights, m.
  struct Spring {
    SpringProperties properties;
    double difference[4] = {};
    double height_sum = 0;
    double weight = 1;
    Layout::Memory memory[2];
  };
  /// Force on the end here, N, and its fourth component there.
  struct Result {
    double force[4] = {}, height_force_there = 0;
    double elongation = 0;  ///< of the base spring, m
    bool gone = false;      ///< whether the integrity of the base spring became 0
  };

  /// Computes the forces of a spring and adds its energies. In a step the spring's memory advances.
  Result forces(const Spring& spring, RowEnergies& energies) const {
    const SpringProperties& of = spring.properties;
    const Vec3 d{spring.difference[0], spring.difference[1], spring.difference[2]};
    const Vec3 r = of.rest + d;
    Result result;
    for (std::size_t cross = 0; cross < kinds_; ++cross) {
      const double rise = cross == 0 ? spring.difference[3] : spring.height_sum,
                   growth = of.growth(cross, d, rise, delta_),
                   rest_length = of.rest_length_of(cross), length = of.length(cross, growth),
                   elongation = growth / (length + rest_length);
      const CompositeAnswer answer =
          advance(of, cross, elongation, spring.memory[cross], cross == 0 ? &result : nullptr);
      energies.stored += spring.weight * answer.stored;
      energies.dissipated += spring.weight * answer.dissipated;
      energies.fractured += spring.weight * answer.fractured;
      if (cross == 0) result.elongation = elongation;
      const double pull = spring.weight * answer.force / length;
      result.force[0] += pull * r.x;
      result.force[1] += pull * r.y;
      result.force[2] += pull * r.z;
      if (!free_) continue;
      const double along = pull * (cross == 0 ? rise : delta_ + rise);
      result.force[3] += cross == 0 ? along : -along;
      result.height_force_there -= along;
    }
    return result;
  }

 private:
  CompositeAnswer advance(const SpringProperties& of, std::size_t cross, double elongation,
                          const Layout::Memory& memory, Result* result) const {
    LawNumbers kept = read_numbers(memory, model_.springs.memory);
    const bool was_there = result != nullptr && model_.springs.softens && !measures_ &&
                           ask_spring(model_, of, cross, elongation, kept.data()).integrity > 0;
    const CompositeAnswer answer =
        take_spring(model_, of, cross, elongation, time_step_, kept.data());
    if (result != nullptr) result->gone = was_there && answer.integrity <= 0;
    for (std::uint32_t n = 0; n < model_.springs.memory && !measures_; ++n)
      memory.first[n * memory.stride] = kept[n];
    return answer;
  }

  const Model& model_;
  double time_step_, delta_;
  std::size_t kinds_;
  bool free_, measures_;
};

/// Sets the forces on the row in work to zero, up to whole vectors.
void clear_own(const ScratchRows<double>& scratch, int components, int count) {
  for (int c = 0; c < components; ++c)
    std::fill_n(scratch.own(c), (count + lanes - 1) / lanes * lanes, 0.0);
}

/// Returns the properties of a spring with these constants. `material`: one of its materials.
SpringProperties properties_of(const Model& model, const SpringConstants& constants,
                               std::uint8_t material) {
  SpringProperties of;
  of.stiffness = constants.stiffness;
  of.cross_stiffness = constants.cross_stiffness;
  of.law = model.materials[material].law;
  of.constants[0] = constants.law[0];
  of.constants[1] = constants.law[1];
  of.composite = model.springs.composite(constants);
  return of;
}

}  // namespace

void OtherRows::compute(Block& block, const KernelRequest& request, const RowPlace& place,
                        bool measures) const {
  const Row& row = request.rows[place.index];
  RowEnergies energies;
  const std::int32_t number = row.law == first_law_and_more ? 0 : row.law;
  if (number >= 0) {
    const Law& law = model_.springs.laws[static_cast<std::size_t>(number)];
    energies = call_row_kernel(law, measures ? law.kernels.measure_row : law.kernels.step_row,
                               request, place);
  } else {
    energies = model_.body.is_listed() ? several_laws_of_list(block, request, place, measures)
                                       : several_laws_of_grid(block, request, place, measures);
  }
  // Kernels measure in doubles, and so do laws with a memory step.
  const bool in_floats = model_.springs.choice.precision == Precision::floats && !measures &&
                         model_.springs.kernels().memory == 0;
  if (!pressures_.empty())
    energies.stored += in_floats ? add_volumes<float>(block, request, row)
                                 : add_volumes<double>(block, request, row);
  const bool owned = place.index >= block.layout->first_own && place.index < block.layout->last_own;
  if (!owned) return;
  const auto add = [&](const auto& source) {
    energies.stored += in_floats ? add_forces<float>(source, block, request, place)
                                 : add_forces<double>(source, block, request, place);
  };
  if (!damage_.empty()) add(damage_);
  if (!local_.empty()) add(local_);
  if (measures) {
    block.other_sums[place.index] = energies;
    return;
  }
  block.damped_work[place.index] += energies.dissipated;
  if (!block.fracture_work.empty()) block.fracture_work[place.index] += energies.fractured;
}

/// Adds the forces of nodal volumes to those on the row. Returns their energy, J.
template <class Real>
double OtherRows::add_volumes(const Block& block, const KernelRequest& request,
                              const Row& row) const {
  const ScratchRows<Real> scratch(request, model_.degrees_of_freedom);
  const Particle first = pressures_.first_of(block, row);
  double energy = 0;
  for (std::int32_t t = 0; t < row.end; ++t) {
    const Particle particle = first + static_cast<Particle>(t);
    const Vec3 force = pressures_.force(particle);
    for (int c = 0; c < 3; ++c) scratch.own(c)[t] += static_cast<Real>(force[c]);
    energy += pressures_.energy(particle);
  }
  return energy;
}

/// Adds the forces of springs that kernels do not see to those on the row. Returns their energy, J.
template <class Real, class Source>
double OtherRows::add_forces(const Source& source, const Block& block, const KernelRequest& request,
                             const RowPlace& place) const {
  const ScratchRows<Real> scratch(request, model_.degrees_of_freedom);
  const std::int32_t begin = request.rows[place.index].begin;
  double energy = 0;
  source.for_row(block, place.index, [&](const auto& particle) {
    for (std::size_t c = 0;
         c < particle.force.size() && c < static_cast<std::size_t>(model_.degrees_of_freedom); ++c)
      scratch.own(static_cast<int>(c))[particle.site - begin] +=
          static_cast<Real>(particle.force[c]);
    energy += particle.stored;
  });
  return energy;
}

RowEnergies OtherRows::several_laws_of_grid(Block& block, const KernelRequest& request,
                                            const RowPlace& place, bool measures) const {
  const Row& row = request.rows[place.index];
  const int components = model_.degrees_of_freedom, sites = row.end - row.begin;
  const bool owned = place.k >= 0;
  const ScratchRows<double> scratch(request, components);
  clear_own(scratch, components, sites);
  const double* displacement[4] = {};  // the model refuses floats where there are several laws
  for (int c = 0; c < components; ++c)
    displacement[c] = static_cast<const double*>(request.displacement[c]);
  const SeveralLaws laws(model_, request, measures);
  RowEnergies energies;
  for (std::uint32_t n = 0; n < model_.springs.neighbours.size(); ++n) {
    const NeighbourGeometry& neighbour = model_.springs.neighbours[n];
    const Neighbour& to = neighbour.site;
    if ((row.neighbours >> n & 1U) == 0 || (!owned && place.k + to.dz < 0)) continue;
    const Row& other =
        request
            .rows[static_cast<std::int64_t>(place.index) + to.dz * request.rows_per_plane + to.dy];
    std::vector<std::int32_t> rung;
    std::vector<double> elongations;
    SeveralLaws::Spring spring;
    const SpringConstants* known = nullptr;  // of spring.properties
    for (std::int32_t i = row.begin; i < row.end; ++i) {
      const std::uint64_t here = row.start + static_cast<std::uint64_t>(i - row.begin);
      if ((block.alive[here] >> n & 1U) == 0) continue;
      const std::uint64_t there = other.start + static_cast<std::uint64_t>(i + to.dx - other.begin);
      const bool cells = !model_.kinds.mixtures.empty();
      const std::uint32_t kind = cells ? block.mixture[here] : block.material[here];
      const SpringConstants& constants =
          model_.springs.spring_to(n, kind, cells ? 0 : block.material[there]);
      if (&constants != known) {
        known = &constants;
        spring.properties = properties_of(model_, constants,
                                          cells ? model_.kinds.mixtures.material_of_spring(kind, to)
                                                : static_cast<std::uint8_t>(kind));
        spring.properties.rest = neighbour.rest;
        spring.properties.rest_length = neighbour.rest_length;
        spring.properties.cross_rest_length = neighbour.cross_rest_length;
        spring.properties.spring_class = to.spring_class;
      }
      for (int c = 0; c < components; ++c)
        spring.difference[c] = displacement[c][there] - displacement[c][here];
      if (components == 4) spring.height_sum = displacement[3][there] + displacement[3][here];
      if (row.weights != no_weights) {
        const auto t = static_cast<std::uint64_t>(i - row.begin);
        const std::uint32_t set = request.weight_sets[row.weights + t / lanes];
        spring.weight = request.weights[set + lanes * (std::uint64_t{n} + 1) + t % lanes];
      }
      for (const bool cross : {false, true})
        if (model_.springs.memory > 0 &&
            (!cross || model_.springs.choice.membrane != KernelChoice::Membrane::none))
          spring.memory[cross ? 1 : 0] = blocks_.layout().memory(block, place.index, n, i, cross);
      const SeveralLaws::Result result = laws.forces(spring, energies);
      for (int c = 0; c < components; ++c) {
        scratch.own(c)[i - row.begin] += result.force[c];
        scratch.received(c, place.j + to.dy, place.k + to.dz)[i + to.dx] +=
            c == 3 ? result.height_force_there : -result.force[c];
      }
      if (measures || !owned) continue;
      if (result.gone) blocks_.note_gone(block, {place.index, n, {&i, 1}, {&result.elongation, 1}});
      if (!model_.springs.breakable || !reaches_alarm(model_, spring.properties, constants.alarm,
                                                      result.elongation, spring.memory[0]))
        continue;
      rung.push_back(i);
      elongations.push_back(result.elongation);
    }
    if (rung.empty()) continue;
    const std::uint8_t* broken = review_.review(block, {place.index, n, rung, elongations});
    for (std::size_t s = 0; s < rung.size(); ++s)
      if (broken[s] != 0) blocks_.layout().remove(block, place.index, n, rung[s]);
  }
  for (int c = 0; c < components; ++c) {
    double* received = scratch.received(c, place.j, place.k) + row.begin;
    for (int t = 0; t < sites; ++t) {
      scratch.own(c)[t] += received[t];
      received[t] = 0;
    }
  }
  return energies;
}

RowEnergies OtherRows::several_laws_of_list(Block& block, const KernelRequest& request,
                                            const RowPlace& place, bool measures) const {
  const Row& row = request.rows[place.index];
  const int components = model_.degrees_of_freedom;
  const ListedSlots& slots = request.listed;
  const ScratchRows<double> scratch(request, components);
  clear_own(scratch, components, row.end);
  const SeveralLaws laws(model_, request, measures);
  const auto record = [&](std::uint64_t index) {
    return static_cast<const double*>(slots.records) + record_numbers * index;
  };
  const auto* stiffness = static_cast<const double*>(slots.stiffness);
  RowEnergies energies;
  for (std::int32_t t = 0; t < row.end; ++t) {
    const std::uint64_t here = row.start + static_cast<std::uint64_t>(t), lane = here % lanes;
    const double* own = record(here);
    for (std::uint32_t slot = slots.first[here / lanes]; slot < slots.first[here / lanes + 1];
         ++slot) {
      const std::uint32_t there = slots.neighbour[std::uint64_t{slot} * lanes + lane];
      if (there == here) continue;
      const double* other = record(there);
      const auto material = static_cast<std::uint8_t>(own[record_material]);
      const SpringConstants& constants =
          model_.springs.spring(material, static_cast<std::uint8_t>(other[record_material]), 0);
      SeveralLaws::Spring spring;
      SpringProperties& of = spring.properties = properties_of(model_, constants, material);
      of.rest = {other[0] - own[0], other[1] - own[1], other[2] - own[2]};
      of.rest_length = norm(of.rest);
      of.cross_rest_length = std::hypot(of.rest_length, request.membrane_distance);
      of.stiffness = stiffness[(std::uint64_t{slot} * 2) * lanes + lane];
      of.cross_stiffness = stiffness[(std::uint64_t{slot} * 2 + 1) * lanes + lane];
      of.factor = of.stiffness / constants.stiffness;
      for (int c = 0; c < components; ++c)
        spring.difference[c] = other[record_moved + static_cast<std::size_t>(c)] -
                               own[record_moved + static_cast<std::size_t>(c)];
      if (components == 4) spring.height_sum = other[record_moved + 3] + own[record_moved + 3];
      for (const bool cross : {false, true})
        if (model_.springs.memory > 0 &&
            (!cross || model_.springs.choice.membrane != KernelChoice::Membrane::none))
          spring.memory[cross ? 1 : 0] =
              blocks_.layout().memory(block, place.index, slot, t, cross);
      const SeveralLaws::Result result = laws.forces(spring, energies);
      for (int c = 0; c < components; ++c) scratch.own(c)[t] += result.force[c];
      if (measures) continue;
      if (result.gone)
        blocks_.note_gone(block, {place.index, slot, {&t, 1}, {&result.elongation, 1}});
      if (!model_.springs.breakable) continue;
      const double growth =
          static_cast<const double*>(slots.alarm)[std::uint64_t{slot} * lanes + lane];
      const double alarm = std::sqrt(of.rest_length * of.rest_length + growth) - of.rest_length;
      if (reaches_alarm(model_, of, alarm, result.elongation, spring.memory[0]) &&
          *review_.review(block, {place.index, slot, {&t, 1}, {&result.elongation, 1}}) != 0)
        blocks_.layout().remove(block, place.index, slot, t);
    }
  }
  energies.stored *= 0.5;  // the other half is counted at the other end
  energies.dissipated *= 0.5;
  energies.fractured *= 0.5;
  return energies;
}

}  // namespace hyperlattice
