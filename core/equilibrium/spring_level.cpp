#include <equilibrium/spring_level.hpp>

#include <equilibrium/height_change.hpp>
#include <equilibrium/made_from.hpp>

#include <hyperlattice/volumetric_cell.hpp>

#include <bit>

namespace hyperlattice::equilibrium {

namespace {

GridLayout layout_of(const StaticGrid& grid) {
  GridLayout layout;
  layout.sites = {grid.sites[0], grid.sites[1], grid.sites[2]};
  layout.row = grid.row;
  layout.plane = grid.plane;
  layout.origin = grid.origin;
  layout.places = grid.places;
  layout.of_place = 1;
  layout.of_component = grid.places;
  layout.components = grid.components;
  return layout;
}

}  // namespace

SpringLevel::SpringLevel(const StaticProblem& problem)
    : GridLevel(layout_of(problem.grid), problem.grid.threads),
      problem_(problem),
      grid_(problem.grid) {
  const auto places = static_cast<std::size_t>(grid_.places),
             springs = grid_.neighbours.size() * places;
  axial_.resize(springs);
  pull_.resize(springs);
  if (grid_.components == 4) {
    cross_axial_.resize(springs);
    cross_pull_.resize(springs);
  }
  if (grid_.has_own()) own_.resize(grid_.numbers());
  if (grid_.cells) {
    cell_stiffness_.resize(places);
    cell_pressure_.resize(places);
  }
  moved_.resize(grid_.numbers());
  diagonal_.resize(static_cast<std::size_t>(grid_.components == 4 ? 10 : 6) * places);
  for (const NeighbourGeometry& n : grid_.neighbours)
    directions_.push_back(
        {grid_.step_to(n.site),
         {n.rest.x / grid_.spacing, n.rest.y / grid_.spacing, n.rest.z / grid_.spacing}});
  for (std::int64_t p = 0; p < grid_.places; ++p)
    for (int c = 0; c < grid_.components; ++c)
      if ((grid_.free[p] >> c & 1u) == 0) held_.push_back(c * grid_.places + p);
}

SpringTangents SpringLevel::tangents() {
  SpringTangents tangents{axial_.data(), pull_.data()};
  if (grid_.components == 4) {
    tangents.cross_axial = cross_axial_.data();
    tangents.cross_pull = cross_pull_.data();
  }
  if (grid_.has_own()) tangents.own = own_.data();
  tangents.cell_stiffness = cell_stiffness_.data();
  tangents.cell_pressure = cell_pressure_.data();
  return tangents;
}

double SpringLevel::linearise(const Field& displacement, Field& force) {
  const SpringTangents now = tangents();
  const double energy = problem_.respond(displacement.data(), force.data(), &now);
  deformed_ = largest(displacement) > 0;
  rows_.pack(grid_, now, deformed_);
  for (std::size_t n = 0; n < displacement.size(); ++n)
    moved_[n] = static_cast<float>(displacement[n] / grid_.spacing);
  invert_diagonal();
  constexpr float little = 0.02F;
  constexpr double bound = 2.02, slack = 1 + little;  // 2 is a bound for springs that are not
                                                      // compressed, see StiffnessBound
  largest_pull_ = grid_.components == 4 && deformed_ ? largest_magnitude(pull_) : 0;
  new_ = moved_when_prepared_.empty() || largest_change() > little ||
         holds_numbers_otherwise(own_when_prepared_, largest_magnitude(own_)) ||
         holds_heights_otherwise(largest_pull_ + pull_when_prepared_, softest_height_);
  if (new_)
    largest_eigenvalue_ = deformed_ || grid_.cells ? std::max(bound, power_iteration()) : bound;
  else
    largest_eigenvalue_ = std::max(largest_eigenvalue_, slack * bound);
  return energy;
}

void SpringLevel::prepared() {
  moved_when_prepared_ = moved_;
  pull_when_prepared_ = largest_pull_;
  own_when_prepared_ = largest_magnitude(own_);
  new_ = false;
  for_made_from(MadeFromWriter(made_from_));
}

/// Calls visit with each array and number from which the coarse levels are made, and with what the
/// finest level takes over from one tangent to the next.
template <class Visit>
void SpringLevel::for_made_from(Visit visit) {
  for (Floats* const of : {&axial_, &pull_, &cross_axial_, &cross_pull_, &own_, &cell_stiffness_,
                           &cell_pressure_, &moved_})
    visit(*of);
  double deformed = deformed_ ? 1 : 0;
  for (double* const number : {&largest_pull_, &largest_eigenvalue_, &deformed}) visit(*number);
  deformed_ = deformed > 0;
}

void SpringLevel::recall(std::span<const double> made_from) {
  for_made_from(MadeFromReader(made_from));
  rows_.pack(grid_, tangents(), deformed_);
  invert_diagonal();
}

/// Returns the largest change since the last preparation of a component of the vector between the
/// ends of a spring, in lattice constants.
float SpringLevel::largest_change() const {
  float largest = 0;
  for (int c = 0; c < grid_.components; ++c) {
    const float* now = moved_.data() + c * grid_.places;
    const float* then = moved_when_prepared_.data() + c * grid_.places;
#pragma omp parallel for num_threads(threads_) schedule(static) reduction(max : largest)
    for (std::int64_t place = grid_.origin; place < grid_.places; ++place)
      for (std::size_t n = 0; n < grid_.neighbours.size(); ++n) {
        if (!has_spring(n, place)) continue;
        const std::int64_t there = place + grid_.step_to(grid_.neighbours[n].site);
        largest =
            std::max(largest, std::abs((now[there] - then[there]) - (now[place] - then[place])));
      }
  }
  return largest;
}

/// Calls visit(row, first place, count) for the rows that are not empty, in parallel for planes
/// whose springs share no place.
template <class Visit>
void SpringLevel::for_rows(const Visit& visit) const {
  int reach = 1;
  for (const NeighbourGeometry& n : grid_.neighbours) reach = std::max(reach, n.site.dz);
  for (int colour = 0; colour <= reach; ++colour) {
#pragma omp parallel for num_threads(threads_) schedule(static)
    for (int k = colour; k < grid_.sites[2]; k += reach + 1)
      for (int j = 0; j < grid_.sites[1]; ++j) {
        const auto number = static_cast<std::size_t>(k) * static_cast<std::size_t>(grid_.sites[1]) +
                            static_cast<std::size_t>(j);
        const StaticRow& row = grid_.rows[number];
        if (row.begin < row.end) visit(number, grid_.place(row.begin, j, k), row.end - row.begin);
      }
  }
}

void SpringLevel::multiply(const double* x, double* y) const {
  in_pieces(grid_.numbers(), threads_, [&](std::size_t first, std::size_t last) {
    std::fill(y + first, y + last, 0.0);
    if (own_.empty()) return;
    for (std::size_t n = first; n < last; ++n) y[n] = static_cast<double>(own_[n]) * x[n];
  });
  for_rows([&](std::size_t number, std::int64_t first, std::int64_t count) {
    SpringProduct product{.count = count,
                          .neighbours = static_cast<int>(directions_.size()),
                          .to = directions_.data(),
                          .membrane_distance = grid_.membrane_distance / grid_.spacing,
                          .tangents = rows_.row(number)};
    for (int c = 0; c < grid_.components; ++c) {
      product.moved[c] = deformed_ ? moved_.data() + c * grid_.places + first : nullptr;
      product.in[c] = x + c * grid_.places + first;
      product.out[c] = y + c * grid_.places + first;
    }
    row_kernels_->springs(product, grid_.components);
    if (!grid_.cells) return;
    CellProduct cells{.count = count, .row = grid_.row, .plane = grid_.plane};
    cells.stiffness = cell_stiffness_.data() + first;
    cells.pressure = deformed_ ? cell_pressure_.data() + first : nullptr;
    for (int c = 0; c < 3; ++c) {
      cells.moved[c] = moved_.data() + c * grid_.places + first;
      cells.in[c] = product.in[c];
      cells.out[c] = product.out[c];
    }
    row_kernels_->cells(cells);
  });
  mask(y);
}

void SpringLevel::mask(double* x) const {
  for (const std::int64_t n : held_) x[n] = 0;
}

bool SpringLevel::has_spring(std::size_t neighbour, std::int64_t place) const {
  const auto at =
      neighbour * static_cast<std::size_t>(grid_.places) + static_cast<std::size_t>(place);
  const auto there = [&](const Floats& numbers) { return !numbers.empty() && numbers[at] != 0; };
  return there(axial_) || there(pull_) || there(cross_axial_) || there(cross_pull_);
}

double SpringLevel::stiffest() const {
  return std::max(largest_magnitude(axial_), largest_magnitude(cross_axial_));
}

bool SpringLevel::tangent(std::size_t neighbour, std::int64_t place, SpringBlocks& blocks) const {
  if (!has_spring(neighbour, place)) return false;
  const auto at =
      neighbour * static_cast<std::size_t>(grid_.places) + static_cast<std::size_t>(place);
  const bool heights = grid_.components == 4;
  const NeighbourGeometry& geometry = grid_.neighbours[neighbour];
  const std::int64_t step = grid_.step_to(geometry.site);
  const auto moved = [&](int c, std::int64_t p) {
    return moved_[static_cast<std::size_t>(c * grid_.places + p)];
  };
  const auto spacing = static_cast<float>(grid_.spacing);
  float r[4] = {static_cast<float>(geometry.rest.x) / spacing,
                static_cast<float>(geometry.rest.y) / spacing,
                static_cast<float>(geometry.rest.z) / spacing, 0},
        total = static_cast<float>(grid_.membrane_distance) / spacing;
  for (int c = 0; c < 3; ++c) r[c] += moved(c, place + step) - moved(c, place);
  if (heights) {
    r[3] = moved(3, place + step) - moved(3, place);
    total += moved(3, place + step) + moved(3, place);
  }
  blocks = {{axial_[at], pull_[at], heights ? cross_axial_[at] : 0, heights ? cross_pull_[at] : 0},
            r,
            total,
            heights};
  return true;
}

bool SpringLevel::cell(std::int64_t place, CellTangent& tangent) const {
  if (!grid_.cells || cell_stiffness_[static_cast<std::size_t>(place)] == 0) return false;
  tangent.stiffness = double{cell_stiffness_[static_cast<std::size_t>(place)]};
  tangent.pressure = double{cell_pressure_[static_cast<std::size_t>(place)]};
  const std::int64_t steps[3] = {1, grid_.row, grid_.plane};
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t d = 0; d < 3; ++d) {
      double sum = 0;
      for (std::size_t corner = 0; deformed_ && corner < 8; ++corner) {
        std::int64_t at = static_cast<std::int64_t>(c) * grid_.places + place;
        for (std::size_t axis = 0; axis < 3; ++axis)
          at += static_cast<std::int64_t>(corner >> axis & 1U) * steps[axis];
        sum += corner_sign(corner, d) * double{moved_[static_cast<std::size_t>(at)]};
      }
      tangent.gradient[c][d] = sum / 4;
    }
  set_cofactors(tangent.gradient, tangent.cofactors);
  for (std::size_t c = 0; c < 3; ++c) tangent.gradient[c][c] += 1;
  return true;
}

void SpringLevel::add_cells_to_diagonal(std::int64_t first, std::int64_t count) {
  CellTangent tangent;
  for (std::int64_t place = first; place < first + count; ++place) {
    if (!cell(place, tangent)) continue;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      CellMode mode;
      for (auto& of_component : mode.by)
        for (std::size_t d = 0; d < 3; ++d) of_component[d] = corner_sign(corner, d);
      double block[16] = {};
      tangent.add_block(mode, mode, block);
      const auto n = static_cast<std::int64_t>(corner);
      const std::int64_t at = place + (n & 1) + (n >> 1 & 1) * grid_.row + (n >> 2) * grid_.plane;
      std::int64_t number = 0;
      for (std::int64_t a = 0; a < grid_.components; ++a)
        for (std::int64_t b = a; b < grid_.components; ++b, ++number)
          diagonal_[static_cast<std::size_t>(number * grid_.places + at)] +=
              static_cast<float>(block[4 * a + b]);
    }
  }
}

/// Returns a signature of each site from the stiffness of its springs and its cell and from its
/// free components. In a deformed body each site has its own signature.
Signatures SpringLevel::signatures() const {
  Signatures all(static_cast<std::size_t>(grid_.sites[0]) *
                 static_cast<std::size_t>(grid_.sites[1]) *
                 static_cast<std::size_t>(grid_.sites[2]));
  const auto bits = [](float value) { return std::uint64_t{std::bit_cast<std::uint32_t>(value)}; };
  const std::int64_t rows = std::int64_t{grid_.sites[1]} * grid_.sites[2];
#pragma omp parallel for num_threads(threads_) schedule(static)
  for (std::int64_t r = 0; r < rows; ++r) {
    std::uint64_t* row = all.data() + r * grid_.sites[0];
    const auto first =
                   static_cast<std::size_t>(grid_.place(0, r % grid_.sites[1], r / grid_.sites[1])),
               count = static_cast<std::size_t>(grid_.sites[0]);
    for (std::size_t i = 0; i < count; ++i)
      row[i] = deformed_ ? first + i
                         : std::uint64_t{grid_.free[first + i]} << 32 | bits(own(0, first + i));
    for (int c = 1; c < grid_.components && !own_.empty() && !deformed_; ++c)
      for (std::size_t i = 0; i < count; ++i) row[i] = signed_by(row[i], bits(own(c, first + i)));
    for (std::size_t i = 0; i < count && grid_.cells && !deformed_; ++i)
      row[i] = signed_by(row[i], bits(cell_stiffness_[first + i]));
    for (std::size_t n = 0; n < grid_.neighbours.size() && !deformed_; ++n) {
      const std::size_t at = n * static_cast<std::size_t>(grid_.places) + first;
      for (std::size_t i = 0; i < count; ++i)
        row[i] = signed_by(row[i], bits(axial_[at + i]) << 32 |
                                       (cross_axial_.empty() ? 0 : bits(cross_axial_[at + i])));
    }
  }
  return all;
}

void SpringLevel::invert_diagonal() {
  const auto places = static_cast<std::size_t>(grid_.places);
  const auto diagonal = [&](std::size_t first) {
    Triangles blocks;
    for (std::size_t n = 0; n < diagonal_.size() / places; ++n)
      blocks.numbers[n] = diagonal_.data() + n * places + first;
    return blocks;
  };
  std::fill(diagonal_.begin(), diagonal_.end(), 0.0F);
  if (!own_.empty()) {
    std::size_t number = 0;  // of the diagonal numbers of the triangle
    for (std::size_t c = 0, components = static_cast<std::size_t>(grid_.components); c < components;
         number += components - c, ++c)
      std::copy_n(own_.begin() + static_cast<std::ptrdiff_t>(c * places), places,
                  diagonal_.begin() + static_cast<std::ptrdiff_t>(number * places));
  }
  for_rows([&](std::size_t, std::int64_t first, std::int64_t count) {
    RowOfSprings springs{.count = count};
    springs.membrane_distance = static_cast<float>(grid_.membrane_distance / grid_.spacing);
    for (int c = 0; c < grid_.components; ++c)
      springs.moved[c] = moved_.data() + c * grid_.places + first;
    for (std::size_t n = 0; n < directions_.size(); ++n) {
      const std::int64_t at = static_cast<std::int64_t>(n) * grid_.places + first;
      springs.step = directions_[n].step;
      for (int c = 0; c < 3; ++c) springs.rest[c] = static_cast<float>(directions_[n].rest[c]);
      springs.axial = axial_.data() + at;
      springs.pull = deformed_ ? pull_.data() + at : nullptr;
      if (grid_.components == 4) {
        springs.cross_axial = cross_axial_.data() + at;
        springs.cross_pull = deformed_ ? cross_pull_.data() + at : nullptr;
      }
      row_kernels_->diagonal(springs, grid_.components, diagonal(static_cast<std::size_t>(first)));
    }
    if (grid_.cells) add_cells_to_diagonal(first, count);
  });
  softest_height_ = infinity;
  for (std::size_t p = 0; grid_.components == 4 && p < places; ++p)
    if ((grid_.free[p] >> 3 & 1u) != 0)
      softest_height_ =
          std::min(softest_height_, static_cast<double>(diagonal_[diagonal_.size() - places + p]));
  in_pieces(places, threads_, [&](std::size_t first, std::size_t last) {
    row_kernels_->invert(static_cast<std::int64_t>(last - first), grid_.components,
                         grid_.free + first, diagonal(first));
  });
}

void SpringLevel::divide(std::size_t first, std::size_t last, const double* r, double* z) const {
  Division division{.count = static_cast<std::int64_t>(last - first)};
  const auto places = static_cast<std::size_t>(grid_.places);
  for (std::size_t n = 0; n < diagonal_.size() / places; ++n)
    division.inverse[n] = diagonal_.data() + n * places + first;
  for (int c = 0; c < grid_.components; ++c) {
    division.in[c] = r + c * grid_.places + first;
    division.out[c] = z + c * grid_.places + first;
  }
  row_kernels_->divide(division, grid_.components);
}

}  // namespace hyperlattice::equilibrium
