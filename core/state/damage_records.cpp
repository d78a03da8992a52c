#include <state/damage_records.hpp>

#include <Eigen/Dense>
#include <algorithm>

namespace hyperlattice {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Returns the products of two components in the order of Symmetric.
Vector6 squares(Vec3 r) {
  return (Vector6() << r.x * r.x, r.y * r.y, r.z * r.z, r.y * r.z, r.x * r.z, r.x * r.y).finished();
}

}  // namespace

DamageRecords::DamageRecords(BlockSet& blocks)
    : blocks_(blocks), model_(blocks.model()), cells_(blocks) {
  if (model_.cohesive.empty()) return;
  index_.assign(model_.body.particles, none);
  rows_.resize(blocks.size());
  for (const Block& block : blocks) rows_[block.number].resize(block.rows.size());
  for (const NeighbourGeometry& to : model_.springs.neighbours)
    for (const int sign : {-1, 1})
      directions_.push_back({sign * to.rest, {to.rest_length, to.cross_rest_length}});
}

void DamageRecords::set_damage(std::uint32_t record, double damage) {
  damages_[record] = damage;
  const DamageRecord& of = records_[record];
  remaining_[record] = of.material == nullptr ? 1 : hyperlattice::remaining(damage, of.shape);
}

void DamageRecords::grow_to(std::uint32_t record, double damage, double time) {
  if (damages_[record] < DamageRecord::cracked && damage >= DamageRecord::cracked)
    records_[record].crack_time = time;
  set_damage(record, damage);
}

std::vector<std::uint32_t> DamageRecords::add(std::vector<Particle> particles) {
  std::erase_if(particles, [&](Particle particle) { return index_[particle] != none; });
  std::sort(particles.begin(), particles.end());
  particles.erase(std::unique(particles.begin(), particles.end()), particles.end());
  std::vector<std::uint32_t> added;
  added.reserve(particles.size());
  for (const Particle particle : particles) {
    if (unused_.empty()) {
      unused_.push_back(static_cast<std::uint32_t>(records_.size()));
      records_.emplace_back();
      notes_.emplace_back();
      damages_.push_back(0);
      remaining_.push_back(1);
    }
    const std::uint32_t record = unused_.back();
    unused_.pop_back();
    index_[particle] = record;
    damages_[record] = 0;
    remaining_[record] = 1;
    added.push_back(record);
  }
  if (added.empty()) return added;
  for_indices(added.size(), [&](std::size_t n) {
    DamageRecord& record = records_[added[n]] = {};
    fill(record, particles[n]);
    notes_[added[n]] = {record.particle, record.block, record.row};
  });
  for (const std::uint32_t record : added)
    records_[record].cells = cells_.follow(records_[record].particle);
  const auto middle = static_cast<std::ptrdiff_t>(order_.size());
  order_.insert(order_.end(), added.begin(), added.end());
  std::inplace_merge(
      order_.begin(), order_.begin() + middle, order_.end(),
      [this](std::uint32_t a, std::uint32_t b) { return notes_[a].particle < notes_[b].particle; });
  find_rows();
  return added;
}

void DamageRecords::forget(std::uint32_t record) {
  index_[notes_[record].particle] = none;
  cells_.release(records_[record].cells);
  unused_.push_back(record);
}

/// Finds the records of each row. Rows with records go to the host, see Row::law.
void DamageRecords::find_rows() {
  for (const RowOfRecords& of : filled_rows_) {
    Block& block = blocks_[of.block];
    rows_[of.block][of.row] = {};
    block.rows[of.row].law = block.layout->rows[of.row].law;
  }
  filled_rows_.clear();
  for (std::uint32_t n = 0; n < order_.size(); ++n) {
    const DamageNote& note = notes_[order_[n]];
    if (filled_rows_.empty() || filled_rows_.back().block != note.block ||
        filled_rows_.back().row != note.row)
      filled_rows_.push_back({note.block, note.row, n, n});
    filled_rows_.back().end = n + 1;
  }
  for (const RowOfRecords& of : filled_rows_) {
    rows_[of.block][of.row] = {of.begin, of.end};
    std::int32_t& law = blocks_[of.block].rows[of.row].law;
    if (law == 0) law = first_law_and_more;
  }
}

std::span<const std::uint32_t> DamageRecords::of_rank(int rank) const {
  const auto is_before = [this](std::uint32_t record, int of) {
    return blocks_.owner(notes_[record].block) < of;
  };
  const auto begin = std::lower_bound(order_.begin(), order_.end(), rank, is_before),
             end = std::lower_bound(begin, order_.end(), rank + 1, is_before);
  return order().subspan(static_cast<std::size_t>(begin - order_.begin()),
                         static_cast<std::size_t>(end - begin));
}

bool DamageRecords::has_field(Particle particle) const {
  return model_.cohesive[model_.kinds.material(particle)].stage != nullptr &&
         (model_.intact.empty() || model_.intact[particle] == 0);
}

void DamageRecords::fill(DamageRecord& record, Particle particle) const {
  const Body& body = model_.body;
  const Place place = blocks_.layout().place(particle);
  const double share = body.share(particle), spacing = body.grid.spacing;
  record.particle = particle;
  record.block = static_cast<std::uint32_t>(place.block);
  record.row = place.row;
  record.site = place.site;
  record.index = place.index;
  record.volume = share * spacing * spacing * spacing;
  record.alpha = share * model_.kinds.alphas[model_.kinds.of(particle)];
  if (model_.degrees_of_freedom == 4)
    record.height = blocks_[record.block].displacement[3][record.index];
  if (has_field(particle)) {
    const Cohesive& cohesive = model_.cohesive[model_.kinds.material(particle)];
    record.material = &cohesive;
    record.strength = cohesive.strength_of(particle);
    record.shape = cohesive.shape(record.strength);
  }
  for (std::uint32_t n = 0; n < body.neighbours.size(); ++n)
    for (const bool forward : {true, false}) add_spring(record, body.neighbours[n], n, forward);
  for (DamageSpring& spring : record.springs()) spring.spread /= share;
  if (record.material != nullptr) find_correction(record);
}

void DamageRecords::add_spring(DamageRecord& record, const Neighbour& to, std::uint32_t neighbour,
                               bool forward) const {
  const Body& body = model_.body;
  const Site site = body.site(record.particle);
  const int sign = forward ? 1 : -1;
  const Site other{site.i + sign * to.dx, site.j + sign * to.dy, site.k + sign * to.dz};
  DamageSpring spring;
  spring.to = body.at(other);
  if (spring.to == Body::no_particle) return;
  const Particle first = forward ? record.particle : spring.to,
                 second = forward ? spring.to : record.particle;
  const SpringProperties of = model_.spring_properties(first, second, neighbour);
  if (!(of.share > 0)) return;
  const Place place = blocks_.layout().place(spring.to);
  spring.block = static_cast<std::uint32_t>(place.block);
  spring.index = place.index;
  spring.neighbour = static_cast<std::uint8_t>(neighbour);
  spring.forward = forward;
  if (has_field(spring.to)) {
    const bool straight = to.dx * to.dx + to.dy * to.dy + to.dz * to.dz == 1;
    spring.spread = of.share / (straight ? 3 : 6);
  }
  for (const std::size_t cross : {0U, 1U})
    spring.stiffness[cross] = of.share * of.stiffness_of(cross);
  spring.present = exists(record, spring);
  record.all[record.count++] = spring;
}

/// The virial of a particle is its stress if the shares of its springs are those of a plane
/// surface. At edges and corners the operator from strain to virial is another one than from strain
/// to stress, and their quotient turns one into the other. The heights of a membrane add a part of
/// their own, which is isotropic inside the body.
void DamageRecords::find_correction(DamageRecord& record) const {
  const std::uint8_t material = record.material->material;
  const double spacing = model_.body.grid.spacing;
  struct Operator {
    Matrix6 strains = Matrix6::Zero();
    Vector6 heights = Vector6::Zero();
  } whole, own;
  const auto add = [&](Operator& sum, std::uint32_t n, double share) {
    const NeighbourGeometry& to = model_.springs.neighbours[n];
    const SpringConstants& of = model_.springs.spring(material, material, to.site.spring_class);
    const double base = of.stiffness / (to.rest_length * to.rest_length),
                 cross = has_membrane()
                             ? of.cross_stiffness / (to.cross_rest_length * to.cross_rest_length)
                             : 0;
    const Vector6 square = squares(to.rest);
    Vector6 strain = square;
    strain.tail<3>() *= 2;  // the strains yz, xz and xy stand twice in the tensor
    sum.strains += share * (base + cross) * square * strain.transpose();
    sum.heights += share * cross * square;
  };
  for (std::uint32_t n = 0; n < model_.springs.neighbours.size(); ++n) add(whole, n, 2);
  whole.strains /= 2 * spacing * spacing * spacing;
  for (const DamageSpring& spring : record.springs()) {
    const Particle first = spring.forward ? record.particle : spring.to;
    add(own, spring.neighbour,
        model_.body.share(model_.body.site(first), model_.body.neighbours[spring.neighbour]));
  }
  own.strains /= 2 * record.volume;
  constexpr double rounding = 1e-9;
  if ((own.strains - whole.strains).cwiseAbs().maxCoeff() <
      rounding * whole.strains.cwiseAbs().maxCoeff())
    return;
  Eigen::FullPivLU<Matrix6> inverse(own.strains);
  inverse.setThreshold(1e-6);
  if (!inverse.isInvertible()) return;  // a layer or a rod: some strains stretch no spring
  auto found = std::make_unique<VirialCorrection>();
  Eigen::Map<Eigen::Matrix<double, 6, 6, Eigen::RowMajor>>(found->strains.data()) =
      whole.strains * inverse.inverse();
  const double trace = own.heights.head<3>().sum();
  // The trace of the virial grows with the springs' shares over that of the volume.
  const double parts = trace > 0 ? record.volume / (spacing * spacing * spacing) / trace : 0;
  for (Eigen::Index n = 0; n < 6; ++n)
    found->heights[static_cast<std::size_t>(n)] = parts * whole.heights[n];
  record.correction = std::move(found);
}

void DamageRecords::clear_bit(const DamageRecord& record, const DamageSpring& spring) {
  const Block& block = blocks_[spring.forward ? record.block : spring.block];
  std::uint16_t& bits = block.alive[spring.forward ? record.index : spring.index];
  bits = static_cast<std::uint16_t>(bits & ~(1U << spring.neighbour));
}

}  // namespace hyperlattice
