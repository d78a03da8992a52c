#include "closed_cut.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace hyperlattice::friction {

namespace {

Vec3 times(const Symmetric& m, Vec3 v) {
  return {m[0] * v.x + m[5] * v.y + m[4] * v.z, m[5] * v.x + m[1] * v.y + m[3] * v.z,
          m[4] * v.x + m[3] * v.y + m[2] * v.z};
}

void add_dyad(Symmetric& m, double factor, Vec3 e) {
  const double terms[] = {e.x * e.x, e.y * e.y, e.z * e.z, e.y * e.z, e.x * e.z, e.x * e.y};
  for (std::size_t n = 0; n < m.size(); ++n) m[n] += factor * terms[n];
}

/// Returns the inverse of a matrix that may be singular, as it is at rims: it is nearly zero along
/// directions without stiffness.
Symmetric inverse(Symmetric m) {
  constexpr double least = 1e-9;  // over the trace
  const double trace = m[0] + m[1] + m[2];
  for (std::size_t n = 0; n < 3; ++n) m[n] += least * trace;
  const Vec3 x{m[0], m[5], m[4]}, y{m[5], m[1], m[3]}, z{m[4], m[3], m[2]};
  const Vec3 yz = cross(y, z), zx = cross(z, x), xy = cross(x, y);
  const double over = 1 / dot(x, yz);
  Symmetric result{yz.x, zx.y, xy.z, xy.y, xy.x, zx.x};
  for (double& number : result) number *= over;
  return result;
}

Vec3 along_plane(Vec3 v, Vec3 normal) { return v - dot(v, normal) * normal; }

/// A cube of space of the edge `reach`.
using Cube = std::array<std::int64_t, 3>;
Cube cube_of(Vec3 at, double reach) {
  Cube cube{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    cube[axis] = static_cast<std::int64_t>(std::floor(at[axis] / reach));
  return cube;
}

}  // namespace

ClosedCut::ClosedCut(std::vector<SeveredSpring> springs, std::span<const Vec3> first_ends,
                     double spacing, double friction)
    : friction_(friction), fading_(0.1 * spacing), springs_(std::move(springs)) {
  constexpr double reach = 2;  // radius of a patch, spacings
  particles_.reserve(2 * springs_.size());
  for (const SeveredSpring& spring : springs_) {
    particles_.push_back(spring.a);
    particles_.push_back(spring.b);
  }
  std::sort(particles_.begin(), particles_.end());
  particles_.erase(std::unique(particles_.begin(), particles_.end()), particles_.end());
  const auto number = [&](Particle particle) {
    return static_cast<std::uint32_t>(
        std::lower_bound(particles_.begin(), particles_.end(), particle) - particles_.begin());
  };
  ends_.reserve(springs_.size());
  first_of_.assign(particles_.size() + 1, 0);
  for (const SeveredSpring& spring : springs_) {
    ends_.push_back({number(spring.a), number(spring.b)});
    ++first_of_[ends_.back().a + 1];
    ++first_of_[ends_.back().b + 1];
  }
  for (std::size_t n = 1; n < first_of_.size(); ++n) first_of_[n] += first_of_[n - 1];
  springs_of_.resize(first_of_.back());
  std::vector<std::size_t> next(first_of_.begin(), first_of_.end() - 1);
  for (std::uint32_t n = 0; n < springs_.size(); ++n) {
    springs_of_[next[ends_[n].a]++] = 2 * n;
    springs_of_[next[ends_[n].b]++] = 2 * n + 1;
  }
  make_patches(first_ends, reach * spacing);
  apart_.resize(springs_.size());
  pull_.resize(springs_.size());
  piece_pull_.resize(pieces_.size());
  jumps_.resize(numbers * patches_.size());
}

/// There is a patch at the foot of each first end on the surface. Springs belong to the patches
/// around their crossing, with the same weights on both sides of the surface.
void ClosedCut::make_patches(std::span<const Vec3> first_ends, double reach) {
  constexpr double least_cosine = 0.7;  // between the normals of a patch and of its springs
  std::vector<std::uint32_t> own(particles_.size(), ~std::uint32_t{0});  // patch of a first end
  std::vector<Vec3> centres;
  std::map<Cube, std::vector<std::uint32_t>> near;
  for (std::size_t n = 0; n < springs_.size(); ++n) {
    if (own[ends_[n].a] != ~std::uint32_t{0}) continue;
    const Vec3 normal = springs_[n].normal;
    own[ends_[n].a] = static_cast<std::uint32_t>(patches_.size());
    centres.push_back(first_ends[n] + dot(springs_[n].crossing - first_ends[n], normal) * normal);
    near[cube_of(centres.back(), reach)].push_back(own[ends_[n].a]);
    patches_.push_back({normal, {}, {}, 0, 0});
  }
  struct Part {
    std::uint32_t patch = 0;
    Piece piece;
  };
  std::vector<Part> parts;
  for (std::uint32_t n = 0; n < springs_.size(); ++n) {
    const SeveredSpring& spring = springs_[n];
    const std::size_t first = parts.size();
    double sum = 0;
    const Cube here = cube_of(spring.crossing, reach);
    for (std::int64_t k = -1; k <= 1; ++k)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t i = -1; i <= 1; ++i) {
          const auto found = near.find({here[0] + i, here[1] + j, here[2] + k});
          if (found == near.end()) continue;
          for (const std::uint32_t patch : found->second) {
            const double weight = 1 - norm(spring.crossing - centres[patch]) / reach;
            constexpr double least_weight = 1e-6;
            if (weight < least_weight || dot(patches_[patch].normal, spring.normal) < least_cosine)
              continue;
            parts.push_back({patch, {n, weight}});
            sum += weight;
          }
        }
    if (parts.size() == first) {
      parts.push_back({own[ends_[n].a], {n, 1}});
      sum = 1;
    }
    for (std::size_t p = first; p < parts.size(); ++p)
      parts[p].piece.stiffness *= spring.stiffness / sum;
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const Part& l, const Part& r) { return l.patch < r.patch; });
  pieces_.reserve(parts.size());
  for (const Part& part : parts) {
    Patch& patch = patches_[part.patch];
    if (patch.last == 0) patch.first = pieces_.size();
    pieces_.push_back(part.piece);
    patch.last = pieces_.size();
    add_dyad(patch.stiffness, part.piece.stiffness, direction_of(springs_[part.piece.spring].rest));
  }
  for (Patch& patch : patches_)
    if (patch.last > patch.first) patch.compliance = inverse(patch.stiffness);
}

/// Returns the force of a piece on its end a, N, without cancellation.
Vec3 ClosedCut::pull(const Piece& piece, Vec3 jump) const {
  const SeveredSpring& spring = springs_[piece.spring];
  const Vec3 moved = apart_[piece.spring] - jump, now = spring.rest + moved;
  const double rest = norm(spring.rest), length = norm(now);
  if (length == 0) return {};
  const double elongation = dot(moved, 2 * spring.rest + moved) / (length + rest);
  return (piece.stiffness * elongation / length) * now;
}

Vec3 ClosedCut::traction(const Patch& patch, Vec3 jump) {
  Vec3 sum;
  for (std::size_t n = patch.first; n < patch.last; ++n)
    sum += piece_pull_[n] = pull(pieces_[n], jump);
  return sum;
}

/// A patch under tension opens until nothing pulls across it. What its springs then carry along the
/// surface is in balance, and fades while the faces part: forces have no jump.
Vec3 ClosedCut::part(const Patch& patch, Vec3 jump) {
  jump += times(patch.compliance, traction(patch, jump));
  const double opening = std::max(0.0, dot(jump, patch.normal));
  jump = along_plane(jump, patch.normal) + opening * patch.normal;
  const double left = std::max(0.0, 1 - opening / fading_);
  traction(patch, jump);
  for (std::size_t n = patch.first; n < patch.last; ++n) piece_pull_[n] *= left;
  return jump;
}

Vec3 ClosedCut::settle(const Patch& patch, Vec3 jump) {
  const Vec3 normal = patch.normal, stuck = along_plane(jump, normal);
  Vec3 pull = traction(patch, stuck), way, answer;
  double slip = 0, yields = 0;
  // Springs turn while they slip, which one step leaves out.
  constexpr int most_steps = 4;
  for (int step = 0; step < most_steps; ++step) {
    const double pressure = -dot(pull, normal);
    if (!(pressure > 0)) return part(patch, jump);
    const Vec3 shear = along_plane(pull, normal);
    const double limit = friction_ * pressure, excess = norm(shear) - limit;
    constexpr double exact = 1e-6;
    if (step > 0 ? std::abs(excess) <= exact * limit : !(excess > 0)) break;
    if (step == 0) {
      // A slip changes the pressure too if the lattice is not even across the surface.
      way = shear / norm(shear);
      answer = times(patch.stiffness, way);
      yields = dot(answer, way) + friction_ * dot(answer, normal);
      if (!(yields > 0)) break;  // it presses the faces together more than it relieves them
    }
    slip = std::max(0.0, slip + excess / yields);
    pull = traction(patch, stuck + slip * way);
  }
  return stuck + slip * way;
}

void ClosedCut::find(std::span<const Vec3> displacement, std::span<const double> jumps) {
  for (std::size_t n = 0; n < springs_.size(); ++n) {
    apart_[n] = displacement[ends_[n].b] - displacement[ends_[n].a];
    pull_[n] = {};
  }
  for (std::size_t p = 0; p < patches_.size(); ++p) {
    const Patch& patch = patches_[p];
    const double* before = &jumps[numbers * p];
    const Vec3 after = settle(patch, {before[0], before[1], before[2]});
    for (std::size_t axis = 0; axis < 3; ++axis) jumps_[numbers * p + axis] = after[axis];
    for (std::size_t n = patch.first; n < patch.last; ++n)
      pull_[pieces_[n].spring] += piece_pull_[n];
  }
}

Vec3 ClosedCut::force(std::size_t n) const {
  Vec3 sum;
  for (std::size_t s = first_of_[n]; s < first_of_[n + 1]; ++s) {
    const Vec3 pull = pull_[springs_of_[s] / 2];
    sum += springs_of_[s] % 2 == 0 ? pull : -pull;
  }
  return sum;
}

}  // namespace hyperlattice::friction
