#include <equilibrium/free_motions.hpp>
#include <equilibrium/words.hpp>

#include <numerics/disjoint_sets.hpp>

#include <Eigen/Eigenvalues>

namespace hyperlattice::equilibrium {

namespace {

using Six = Eigen::Matrix<double, 6, 1>;
using SixBySix = Eigen::Matrix<double, 6, 6>;

/// Returns the displacement along the axis c of a particle at r (from the centre, over the piece's
/// size) for a unit of each of the six numbers of a motion.
Six row(int c, Vec3 r) {
  Six row = Six::Zero();
  row[c] = 1;
  const Vec3 turned[3] = {cross({1, 0, 0}, r), cross({0, 1, 0}, r), cross({0, 0, 1}, r)};
  for (int axis = 0; axis < 3; ++axis) row[3 + axis] = turned[axis][c];
  return row;
}

}  // namespace

FreeMotions::FreeMotions(const System& system, const Field& displacement)
    : problem_(system.problem()), displacement_(displacement) {
  const StaticGrid& grid = problem_.grid;
  numerics::DisjointSets pieces(grid.places);  // sets of places that springs join
  std::vector<bool> there(static_cast<std::size_t>(grid.places));
  for (std::int64_t p = 0; p < grid.places; ++p)
    there[static_cast<std::size_t>(p)] = grid.free[p] != 0;
  system.for_springs([&](std::int64_t a, std::int64_t b) {
    pieces.join(a, b);
    there[static_cast<std::size_t>(a)] = there[static_cast<std::size_t>(b)] = true;
  });
  std::vector<std::int64_t> piece_of(static_cast<std::size_t>(grid.places), -1);
  for (std::int64_t p = 0; p < grid.places; ++p) {
    if (!there[static_cast<std::size_t>(p)]) continue;
    ++particles_;
    std::int64_t& piece = piece_of[static_cast<std::size_t>(
        pieces.root(p))];  // the root of a piece is its first place
    if (piece < 0) {
      piece = static_cast<std::int64_t>(pieces_.size());
      pieces_.emplace_back();
    }
    pieces_[static_cast<std::size_t>(piece)].places.push_back(p);
  }
  for (Piece& piece : pieces_) find_motions(piece);
  std::erase_if(pieces_, [](const Piece& piece) { return piece.motions.empty(); });
}

Vec3 FreeMotions::position(std::int64_t place) const {
  const auto u = [&](std::int64_t c) {
    return displacement_[static_cast<std::size_t>(c * problem_.grid.places + place)];
  };
  return problem_.position(place) + Vec3{u(0), u(1), u(2)};
}

/// Finds the motions of a piece that leave all held components in place: the null space of
/// sum of h h^T over the rows h of held components, made orthonormal over the particles.
void FreeMotions::find_motions(Piece& piece) const {
  const auto number = static_cast<double>(piece.places.size());
  for (const std::int64_t place : piece.places) piece.centre += (1 / number) * position(place);
  double square = 0;
  for (const std::int64_t place : piece.places)
    square += dot(position(place) - piece.centre, position(place) - piece.centre);
  piece.size = square > 0 ? std::sqrt(square / number) : 1;
  SixBySix held = SixBySix::Zero(), together = SixBySix::Zero();
  for (const std::int64_t place : piece.places)
    for (int c = 0; c < 3; ++c) {
      const Six here = row(c, (1 / piece.size) * (position(place) - piece.centre));
      together += here * here.transpose() / number;
      if ((problem_.grid.free[place] >> c & 1u) == 0) held += here * here.transpose();
    }
  constexpr double nothing = 1e-9;
  const Eigen::SelfAdjointEigenSolver<SixBySix> modes(held);
  if (modes.info() != Eigen::Success) return;  // positions not finite: Newton's method reports it
  for (int n = 0;
       n < 6 && modes.eigenvalues()[n] <= nothing * std::max(1.0, modes.eigenvalues()[5]); ++n) {
    Six motion = modes.eigenvectors().col(n);
    for (const Motion& before : piece.motions) {
      const Six other = Eigen::Map<const Six>(before.data());
      motion -= number * other.dot(together * motion) * other;
    }
    const double length = motion.dot(together * motion);
    if (length <= nothing) continue;  // the rotation of a straight row about its own axis
    Motion& kept = piece.motions.emplace_back();
    Eigen::Map<Six>(kept.data()) = motion / std::sqrt(number * length);
  }
}

Vec3 FreeMotions::moved(const Piece& piece, const Motion& m, std::int64_t place) const {
  return Vec3{m[0], m[1], m[2]} +
         (1 / piece.size) * cross({m[3], m[4], m[5]}, position(place) - piece.centre);
}

double FreeMotions::along(const Piece& piece, const Motion& motion, const Field& field) const {
  double sum = 0;
  const std::int64_t places = problem_.grid.places;
  for (const std::int64_t place : piece.places) {
    const Vec3 way = moved(piece, motion, place);
    for (int c = 0; c < 3; ++c) sum += field[static_cast<std::size_t>(c * places + place)] * way[c];
  }
  return sum;
}

void FreeMotions::remove_from(Field& field) const {
  const std::int64_t places = problem_.grid.places;
  for (const Piece& piece : pieces_)
    for (const Motion& motion : piece.motions) {
      const double part = along(piece, motion, field);
      for (const std::int64_t place : piece.places) {
        const Vec3 way = moved(piece, motion, place);
        for (int c = 0; c < 3; ++c)
          field[static_cast<std::size_t>(c * places + place)] -= part * way[c];
      }
    }
}

FreeMotions::Driven FreeMotions::driven_by(const Field& force) const {
  constexpr double noticeable = 1e-6;
  double most = noticeable * std::sqrt(product(force.data(), force.data(), force.size(), 1));
  const Piece* found = nullptr;
  Motion with{};
  for (const Piece& piece : pieces_) {
    Motion driven{};
    double square = 0;
    for (const Motion& motion : piece.motions) {
      const double part = along(piece, motion, force);
      square += part * part;
      for (std::size_t n = 0; n < 6; ++n) driven[n] += part * motion[n];
    }
    if (std::sqrt(square) <= most) continue;
    most = std::sqrt(square);
    found = &piece;
    with = driven;
  }
  if (found == nullptr) return {};
  Driven most_driven{sentence(*found, with), Field(force.size(), 0)};
  for (const std::int64_t place : found->places)
    for (int c = 0; c < 3; ++c)
      most_driven.motion[static_cast<std::size_t>(c * problem_.grid.places + place)] =
          moved(*found, with, place)[c];
  return most_driven;
}

std::string FreeMotions::sentence(const Piece& piece, const Motion& m) const {
  const Vec3 slide{m[0], m[1], m[2]}, turn = (1 / piece.size) * Vec3{m[3], m[4], m[5]};
  const std::uint64_t number = piece.places.size();
  std::string text = number == particles_
                         ? "the whole body"
                         : "a loose piece of " + std::to_string(number) + " of the " +
                               std::to_string(particles_) + " particles, around " +
                               short_vector(piece.centre) + " m,";
  text += " can move as a rigid one: it ";
  constexpr double little = 1e-3;
  if (norm(turn) * piece.size < little * norm(slide))
    return text + "slides along " + direction_text(slide);
  return text + "turns about the axis " + direction_text(turn) + " through " +
         short_vector(piece.centre + (1 / dot(turn, turn)) * cross(turn, slide)) + " m";
}

}  // namespace hyperlattice::equilibrium
