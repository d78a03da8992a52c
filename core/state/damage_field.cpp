#include <state/damage_field.hpp>
#include <state/damage_growth.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace hyperlattice {

namespace {

/// A wave takes two to three steps from one particle to the next.
constexpr std::uint64_t steps_of_rest = 4;
/// Ratio of the strength below which a particle without damage rests.
constexpr double safe_ratio = 0.8;

/// c_d in spacings per step. The wave of d is stable below 0.866.
constexpr double damage_speed = 0.8 * 0.866;

/// Adds pull r (x) r.
void add_virial(Symmetric& sum, double pull, Vec3 r) {
  const Vec3 force = pull * r;
  sum[0] += force.x * r.x;
  sum[1] += force.y * r.y;
  sum[2] += force.z * r.z;
  sum[3] += force.y * r.z;
  sum[4] += force.x * r.z;
  sum[5] += force.x * r.y;
}

/// Returns the stress from the virial, of which `heights` is the part of the heights.
Symmetric corrected(const Symmetric& virial, const Symmetric& heights,
                    const VirialCorrection& correction) {
  const double trace = heights[0] + heights[1] + heights[2];
  Symmetric stress{};
  for (std::size_t row = 0; row < 6; ++row) {
    stress[row] = correction.heights[row] * trace;
    for (std::size_t column = 0; column < 6; ++column)
      stress[row] += correction.strains[6 * row + column] * (virial[column] - heights[column]);
  }
  return stress;
}

}  // namespace

/// Displacement and height of a particle, m.
struct DamageField::Motion {
  Vec3 moved;
  double height = 0;
};

inline DamageField::Motion DamageField::motion_of(const Block& block, std::uint64_t index) const {
  return {
      {block.displacement[0][index], block.displacement[1][index], block.displacement[2][index]},
      model_.degrees_of_freedom == 4 ? block.displacement[3][index] : 0.0};
}

inline double DamageField::elongation(const DamageDirection& direction, std::size_t cross,
                                      const Motion& here, const Motion& there) const {
  const Vec3 d = there.moved - here.moved;
  const double rise = cross == 0 ? there.height - here.height : there.height + here.height;
  const double twice = cross == 0 ? 0 : 2 * model_.body.grid.membrane_distance;
  const double growth = dot(d, 2 * direction.rest + d) + rise * (twice + rise),
               length = direction.rest_length[cross];
  return growth / (SpringProperties::present_length(length, growth) + length);
}

void DamageField::evaluate() {
  is_whole_ = is_whole_ && blocks_.ranks().is_alone();
  compute_cells(Part::all);
  records_.for_pieces(records_.mine(),
                      [this](std::span<const std::uint32_t> records) { compute(records); });
  count_dissipation();
}

void DamageField::compute(std::span<const std::uint32_t> records) {
  for (std::size_t n = 0; n < records.size(); ++n) {
    if (n + 1 < records.size() && !rests(records[n + 1])) records_.prefetch(records[n + 1]);
    compute(records[n]);
  }
}

/// Moves what the last step dissipated from the records to their rows.
void DamageField::count_dissipation() {
  const std::span<const std::uint32_t> order = records_.order();
  for (const DamageRecords::RowOfRecords& row : records_.rows()) {
    if (!blocks_.is_mine(blocks_[row.block])) continue;
    double& work = blocks_[row.block].fracture_work[row.row];
    for (const std::uint32_t number : order.subspan(row.begin, row.end - row.begin))
      work += std::exchange(records_.note(number).dissipated, 0);
  }
  forward_ = 0;
}

/// Computes a record's springs in their order.
///
/// The energy of the scheme at n is E_n = 1/2 v(n-1/2).M.v(n+1/2) plus the stored energy. For a
/// spring with the stiffness f_n k and the elongation u_n,
///   kinetic energy:  1/2 (u_{n+1} - u_n) (-f_n k u_n - f_{n+1} k u_{n+1}),
///   stored energy:   1/2 k (f_{n+1} u_{n+1}^2 - f_n u_n^2),
/// whose sum is -1/2 (f_n - f_{n+1}) k u_n u_{n+1}. So the spring dissipates
///   D = 1/2 (f_n - f_{n+1}) k u_n u_{n+1}
/// in the step, and the balance is as exact as that of springs that do not change. In an implicit
/// step the force is the change of the energy with the new factor over the change of elongation
/// (statics/soft_springs.cpp): without numerical damping D = 1/2 (f_n - f_{n+1}) k u_n^2.
void DamageField::compute(std::uint32_t number, Part part) {
  const bool whole = part == Part::all;
  if (whole && rests(number)) return;
  DamageRecord& record = records_[number];
  double dissipated = 0;
  const Motion here = motion_of(blocks_[record.block], record.index);
  const double own = records_.remaining(number), delta = model_.body.grid.membrane_distance;
  const std::size_t kinds = model_.springs.choice.membrane == KernelChoice::Membrane::none ? 1 : 2;
  if (whole) record.force = {}, record.stored = 0;
  // In a step nothing drives damage that is 1.
  const bool is_driven = record.material != nullptr && (!whole || records_.damage(number) < 1);
  Symmetric virial{}, of_heights{};
  double spread = 0;
  for (DamageSpring& spring : record.springs()) {
    if (is_driven)
      spread += spring.spread * (records_.damage_of(spring.to) - records_.damage(number));
    if (!spring.present) continue;
    if (!spring.handed_over && !records_.exists(record, spring)) {
      spring.present = false;
      continue;
    }
    const Motion there = motion_of(blocks_[spring.block], spring.index);
    const DamageDirection& direction = records_.direction(spring);
    const Vec3 r = direction.rest + (there.moved - here.moved);
    const double other = records_.remaining_of(spring.to), factor = in_series(own, other),
                 share = own + other > 0 ? 2 * other / (own + other) : 1;  // f over own omega
    double pull_of_virial = 0;
    for (std::size_t cross = 0; cross < kinds; ++cross) {
      const double u = elongation(direction, cross, here, there),
                   over_length = spring.stiffness[cross] * u / (direction.rest_length[cross] + u);
      const bool degrades = cross == 1 || u > 0;
      pull_of_virial += (degrades ? share : 1) * over_length;
      if (record.correction && cross == 1) {
        const double total = there.height + here.height, length = direction.rest_length[1] + u;
        add_virial(of_heights,
                   share * spring.stiffness[1] * total * (2 * delta + total) /
                       ((length + direction.rest_length[1]) * length),
                   r);
      }
      if (!whole) continue;
      const double f = degrades ? factor : 1;
      if (spring.handed_over) {
        const double pull = f * over_length;
        record.force[0] += pull * r.x;
        record.force[1] += pull * r.y;
        record.force[2] += pull * r.z;
        record.force[3] += cross == 0 ? pull * (there.height - here.height)
                                      : -pull * (delta + (there.height + here.height));
        record.stored += 0.25 * spring.stiffness[cross] * f * u * u;
        dissipated += 0.5 * spring.stiffness[cross] *
                      lost({spring.factor[cross], spring.elongation[cross]}, {f, u},
                           [&](double at) { return cross == 1 || at > 0 ? factor : 1; });
      }
      spring.elongation[cross] = u;
      spring.factor[cross] = f;
    }
    if (is_driven) add_virial(virial, pull_of_virial, r);
  }
  if (whole &&
      record.alpha > 0) {  // the kernel has computed the whole spring: 2 alpha s, alpha s^2
    const double f = alpha_factor(own);
    record.force[3] += 2 * (1 - f) * record.alpha * here.height;
    record.stored -= (1 - f) * record.alpha * here.height * here.height;
    dissipated +=
        2 * record.alpha *
        lost({record.alpha_factor, record.height}, {f, here.height}, [&](double) { return f; });
    record.height = here.height;
    record.alpha_factor = f;
  }
  if (whole) records_.note(number).dissipated = dissipated;
  const double tension = record.cells.share > 0 ? add_cells(number, part) : 0;
  if (!is_driven) return;
  for (double& component : virial) component /= 2 * record.volume;
  for (double& component : of_heights) component /= 2 * record.volume;
  record.stress = record.correction ? corrected(virial, of_heights, *record.correction) : virial;
  for (std::size_t axis = 0; axis < 3; ++axis) record.stress[axis] += tension;
  const double in_spacings = record.material->length / model_.body.grid.spacing;
  record.spread = in_spacings * in_spacings * spread;
}

void DamageField::update(double time_step) {
  is_whole_ = is_whole_ && blocks_.ranks().is_alone();
  compute_cells(Part::all);
  next_.resize(records_.numbers());
  // Growth follows while the caches have the records. It changes nothing that others compute.
  records_.for_pieces(records_.mine(), [&](std::span<const std::uint32_t> records) {
    compute(records);
    grow(records, time_step);
  });
  count_dissipation();
  share_growth();
  set_damages(next_, clock_.time());
}

/// Sets the damage of all records at a time, s, and notes what follows from it.
void DamageField::set_damages(const std::vector<double>& damages, double time) {
  enum Event : std::uint8_t { first = 1, soft = 2, end = 4 };
  const std::span<const std::uint32_t> order = records_.order();
  std::vector<std::uint8_t> events(order.size());
  records_.for_indices(order.size(), [&](std::size_t n) {
    const std::uint32_t record = order[n];
    const double before = records_.damage(record), now = damages[record];
    if (now == before) return;
    const double remained = records_.remaining(record);
    records_.grow_to(record, now, time);
    const double remains = records_.remaining(record);
    events[n] = static_cast<std::uint8_t>((before == 0 ? first : 0) |
                                          (remained == 1 && remains < 1 ? soft : 0) |
                                          (remained > 0 && remains == 0 ? end : 0));
  });
  ended_.clear();
  std::vector<std::uint32_t> damaged;
  for (std::size_t n = 0; n < order.size(); ++n) {
    if ((events[n] & first) != 0) damaged.push_back(order[n]);
    if ((events[n] & soft) != 0) soft_.push_back(order[n]);
    if ((events[n] & end) != 0) ended_.push_back(order[n]);
  }
  surround(damaged);
  note_gone();
}

/// Finds the damage of some records after the step.
void DamageField::grow(std::span<const std::uint32_t> records, double time_step) {
  std::vector<std::uint32_t> driven;
  driven.reserve(records.size());
  for (const std::uint32_t number : records) {
    const double damage = next_[number] = records_.damage(number);
    if (damage < 1 && !rests(number) && records_[number].material != nullptr)
      driven.push_back(number);
  }
  if (driven.empty()) return;
  std::vector<double> ratios;
  find_ratios(driven, ratios);
  for (std::size_t n = 0; n < driven.size(); ++n) {
    DamageRecord& record = records_[driven[n]];
    const Cohesive& material = *record.material;
    const double crossing = material.length * time_step / (damage_speed * model_.body.grid.spacing);
    DamageStep step;
    step.damage = records_.damage(driven[n]);
    step.rate = record.rate;
    step.shape = record.shape;
    step.drive = ratios[n] * ratios[n];
    step.spread = record.spread;
    step.inertia = crossing * crossing;
    step.viscosity = material.viscosity;
    step.time_step = time_step;
    record.rate = damage_rate(step);
    record.lag = damage_lag(step);
    const double damage = step.damage + time_step * record.rate;
    next_[driven[n]] = damage >= 1 - 1e-4 ? 1 : damage;
    if (damage == 0 && ratios[n] < safe_ratio && !touches_damage(record))
      records_.note(driven[n]).rests_until = clock_.steps() + steps_of_rest;
  }
}

/// Finds how close the stress of each record is to its particle's surface: 1 on it. Each material's
/// surface is asked about its stresses at once.
void DamageField::find_ratios(std::span<const std::uint32_t> records,
                              std::vector<double>& ratios) const {
  ratios.assign(records.size(), 0);
  std::vector<PrincipalStress> stresses;
  std::vector<std::size_t> of_material;
  std::vector<double> found;
  stresses.reserve(records.size());
  of_material.reserve(records.size());
  for (const Cohesive& material : model_.cohesive) {
    stresses.clear();
    of_material.clear();
    for (std::size_t n = 0; n < records.size(); ++n) {
      const DamageRecord& record = records_[records[n]];
      if (record.material != &material) continue;
      stresses.push_back(principal_values(record.stress));
      of_material.push_back(n);
    }
    if (stresses.empty()) continue;
    found.assign(stresses.size(), 0);
    material.ratios(stresses, found.data());
    for (std::size_t n = 0; n < found.size(); ++n)
      ratios[of_material[n]] =
          found[n] * material.strength / records_[records[of_material[n]]].strength;
  }
}

/// Counts the springs of which nothing remains when they are stretched, each once.
void DamageField::note_gone() {
  std::vector<std::uint32_t> sorted = ended_;  // ended_ has the order of the particles
  std::sort(sorted.begin(), sorted.end());
  for (const std::uint32_t number : ended_) {
    const DamageRecord& record = records_[number];
    for (const DamageSpring& spring : record.springs()) {
      const std::uint32_t other = records_.of(spring.to);
      const bool ends_too = std::binary_search(sorted.begin(), sorted.end(), other);
      // The other end has counted it, in an earlier step or in this one.
      if (records_.remaining_of(spring.to) == 0 && !(ends_too && record.particle < spring.to))
        continue;
      const DamageRecord& first = spring.forward ? record : records_[other];
      if (!blocks_.is_mine(blocks_[first.block])) continue;
      const Particle to = spring.forward ? spring.to : record.particle;
      const auto springs = first.springs();
      const auto own = std::find_if(springs.begin(), springs.end(), [&](const DamageSpring& same) {
        return same.forward && same.to == to;
      });
      if (own->present)
        blocks_[first.block].broken.push_back({{first.particle, to, spring.neighbour, true},
                                               own->elongation[0],
                                               first.row,
                                               spring.neighbour,
                                               first.site,
                                               true});
    }
  }
}

/// Makes records of the neighbours of particles that have their first damage, and ends their rest.
/// Their springs were whole in this state.
void DamageField::surround(const std::vector<std::uint32_t>& damaged) {
  std::vector<Particle> neighbours;
  neighbours.reserve(damaged.size() * DamageRecord::most_springs);
  for (const std::uint32_t number : damaged) {
    for (const DamageSpring& spring : records_[number].springs()) neighbours.push_back(spring.to);
    for_opposite(records_[number], [&](Particle corner) { neighbours.push_back(corner); });
  }
  std::vector<std::uint32_t> behind = records_.add(neighbours);
  for (const Particle neighbour : neighbours) {
    const std::uint32_t number = records_.of(neighbour);
    if (!rests(number)) continue;
    records_.note(number).rests_until = 0;
    behind.push_back(number);
  }
  records_.for_each(behind, [this](std::uint32_t number) {
    DamageNote& note = records_.note(number);
    note.marked = clock_.steps();
    if (blocks_.is_mine(blocks_[note.block])) note_elongations(number);
  });
}

/// Keeps the elongations of the present state for the energy that the next one dissipates.
void DamageField::note_elongations(std::uint32_t number) {
  DamageRecord& record = records_[number];
  const std::size_t kinds = model_.springs.choice.membrane == KernelChoice::Membrane::none ? 1 : 2;
  const Motion here = motion_of(blocks_[record.block], record.index);
  record.height = here.height;
  for (DamageSpring& spring : record.springs())
    for (std::size_t cross = 0; cross < kinds; ++cross)
      spring.elongation[cross] = elongation(records_.direction(spring), cross, here,
                                            motion_of(blocks_[spring.block], spring.index));
}

bool DamageField::touches_damage(const DamageRecord& record) const {
  const auto springs = record.springs();
  bool touches = std::any_of(springs.begin(), springs.end(), [this](const DamageSpring& spring) {
    return records_.damage_of(spring.to) > 0;
  });
  for_opposite(record,
               [&](Particle corner) { touches = touches || records_.damage_of(corner) > 0; });
  return touches;
}

void DamageField::finish() {
  is_whole_ = is_whole_ && blocks_.ranks().is_alone();
  for (const std::uint32_t number : soft_) {
    DamageRecord& record = records_[number];
    hand_over_cells(record);
    for (DamageSpring& spring : record.springs()) {
      if (spring.handed_over || !spring.present) continue;
      if (!records_.exists(record, spring)) {
        spring.present = false;
        continue;
      }
      records_.clear_bit(record, spring);
      spring.handed_over = true;
      for (DamageSpring& same : records_[records_.of(spring.to)].springs())
        if (same.to == record.particle) same.handed_over = true;
    }
  }
  soft_.clear();
  follow_noted();
  if (clock_.steps() % steps_followed == 0) remove_idle();
}

void DamageField::copy_damage(std::vector<double>& values) const {
  for (Particle p = 0; p < values.size(); ++p)
    if (model_.cohesive[model_.kinds.material(p)].stage != nullptr)
      values[p] = records_.damage_of(p);
}

}  // namespace hyperlattice
