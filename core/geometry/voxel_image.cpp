#include <geometry/voxel_image.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hyperlattice {

namespace {

constexpr std::size_t different = 1 << 16;  // number of possible values

std::size_t bytes_of(VoxelType type) { return type == VoxelType::uint8 ? 1 : 2; }

std::size_t value_at(std::string_view bytes, std::size_t voxel, VoxelType type) {
  const auto byte = [&](std::size_t n) {
    return std::size_t{static_cast<unsigned char>(bytes[n])};
  };
  return type == VoxelType::uint8 ? byte(voxel) : byte(2 * voxel) + 256 * byte(2 * voxel + 1);
}

/// Returns the first few values in the image: "0 (12 voxels), 3 (4 voxels)".
std::string values_text(const std::vector<std::uint64_t>& voxels_of) {
  constexpr int most = 8;
  std::string text;
  int shown = 0;
  for (std::size_t value = 0; value < different; ++value) {
    if (voxels_of[value] == 0) continue;
    if (shown++ == most) return text + ", ...";
    text += fmt::format("{}{} ({} voxels)", text.empty() ? "" : ", ", value, voxels_of[value]);
  }
  return text;
}

/// Returns a guess why an image has the wrong size.
std::string hint(std::size_t bytes, std::size_t voxels, VoxelType type) {
  const bool is_short = type == VoxelType::uint8;
  const std::size_t needed = voxels * bytes_of(type);
  if (bytes == voxels * bytes_of(is_short ? VoxelType::uint16 : VoxelType::uint8))
    return fmt::format("; its size is that of {}", is_short ? "uint16" : "uint8");
  return bytes > needed && bytes - needed <= 65536
             ? fmt::format("; if it begins with a header of {} bytes, cut that off", bytes - needed)
             : "";
}

}  // namespace

VoxelSet::VoxelSet(std::string_view bytes, const Index& counts, VoxelType type,
                   const std::vector<double>& values, Vec3 low, double edge)
    : counts_(counts), low_(low), edge_(edge) {
  const auto voxels = static_cast<std::size_t>(counts[0] * counts[1] * counts[2]),
             needed = voxels * bytes_of(type);
  if (bytes.size() != needed)
    throw std::runtime_error(fmt::format("{} x {} x {} voxels of {} need {} bytes, and it has {}{}",
                                         counts[0], counts[1], counts[2],
                                         type == VoxelType::uint8 ? "1 byte" : "2 bytes", needed,
                                         bytes.size(), hint(bytes.size(), voxels, type)));
  std::vector<bool> wanted(different, values.empty());
  wanted[0] = false;
  for (const double value : values) wanted[static_cast<std::size_t>(value)] = true;
  std::vector<std::uint64_t> voxels_of(different, 0);
  inside_.resize(voxels);
  for (std::size_t n = 0; n < voxels; ++n) {
    const std::size_t value = value_at(bytes, n, type);
    ++voxels_of[value];
    inside_[n] = wanted[value];
  }
  for (const double value : values)
    if (voxels_of[static_cast<std::size_t>(value)] == 0)
      throw std::runtime_error(
          fmt::format("no voxel has the value {}; there are {}", value, values_text(voxels_of)));
  if (voxels_of[0] == voxels && values.empty())
    throw std::runtime_error("all its voxels are 0, which is outside");
  find_box();
}

void VoxelSet::find_box() {
  first_ = counts_;
  last_ = {-1, -1, -1};
  for (std::int64_t k = 0; k < counts_[2]; ++k)
    for (std::int64_t j = 0; j < counts_[1]; ++j)
      for (std::int64_t i = 0; i < counts_[0]; ++i) {
        const Index index{i, j, k};
        if (!inside_[number(index)]) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          first_[axis] = std::min(first_[axis], index[axis]);
          last_[axis] = std::max(last_[axis], index[axis]);
        }
      }
}

bool VoxelSet::contains(Vec3 point) const {
  constexpr double rounding = 1e-9;  // voxels
  const Vec3 at = (1 / edge_) * (point - low_);
  Index index;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double end = static_cast<double>(counts_[axis]);
    if (!(at[axis] >= -rounding && at[axis] <= end + rounding)) return false;
    index[axis] = std::min(static_cast<std::int64_t>(at[axis] + rounding), counts_[axis] - 1);
  }
  return inside_[number(index)];
}

VoxelSet::Span VoxelSet::voxels_along(std::size_t axis, const Cube& cube) const {
  constexpr double rounding = 1e-9;  // voxels; thinner overlaps do not count
  const double begin = (cube.low[axis] - low_[axis]) / edge_,
               end = (cube.high()[axis] - low_[axis]) / edge_,
               most = static_cast<double>(counts_[axis]);
  return {static_cast<std::int64_t>(std::floor(std::clamp(begin + rounding, 0.0, most))),
          static_cast<std::int64_t>(std::ceil(std::clamp(end - rounding, 0.0, most)))};
}

double VoxelSet::overlap(std::size_t axis, std::int64_t voxel, const Cube& cube) const {
  const double low = low_[axis] + edge_ * static_cast<double>(voxel);
  return std::max(0.0, std::min(low + edge_, cube.high()[axis]) - std::max(low, cube.low[axis]));
}

double VoxelSet::volume_in(const Cube& cube) const {
  const Span x = voxels_along(0, cube), y = voxels_along(1, cube), z = voxels_along(2, cube);
  double volume = 0;
  for (std::int64_t k = z.first; k < z.last; ++k)
    for (std::int64_t j = y.first; j < y.last; ++j) {
      double along = 0;
      for (std::int64_t i = x.first; i < x.last; ++i)
        if (inside_[number({i, j, k})]) along += overlap(0, i, cube);
      volume += along * overlap(1, j, cube) * overlap(2, k, cube);
    }
  return volume;
}

Side VoxelSet::side_of(const Cube& cube) const {
  constexpr double rounding = 1e-9;
  const double share = volume_in(cube) / cube.volume();
  return share <= rounding ? Side::outside : share >= 1 - rounding ? Side::inside : Side::cut;
}

std::vector<Plane> VoxelSet::planes_in(const Cube& cube, std::size_t most) const {
  constexpr std::array<Vec3, 3> normals{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  std::vector<Plane> planes;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Span span = voxels_along(axis, cube);
    for (std::int64_t border = span.first; border <= span.last; ++border) {
      Vec3 point = cube.centre();
      point[axis] = low_[axis] + edge_ * static_cast<double>(border);
      planes.push_back({point, normals[axis]});
      if (planes.size() > most) return planes;
    }
  }
  return planes;
}

}  // namespace hyperlattice
