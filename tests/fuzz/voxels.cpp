// Voxel images. The end of the input chooses the numbers that a scene gives, within the ranges that
// a scene may give; the rest is the image.
#include "target.hpp"

#include <fuzzer/FuzzedDataProvider.h>
#include <geometry/voxel_image.hpp>

using namespace hyperlattice;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  FuzzedDataProvider input(data, size);
  const auto length = [&] { return input.ConsumeFloatingPointInRange(1e-300, 1e300); };
  const auto place = [&] { return input.ConsumeFloatingPointInRange(-1e300, 1e300); };
  const bool is_byte = input.ConsumeBool(), fits = input.ConsumeBool();
  std::array<std::int64_t, 3> counts{};
  for (std::int64_t& count : counts)
    count = input.ConsumeIntegralInRange<std::int64_t>(1, fits ? 16 : 100'000);
  std::vector<double> values(input.ConsumeIntegralInRange<std::size_t>(0, 3));
  for (double& value : values) value = input.ConsumeIntegralInRange(0, is_byte ? 255 : 65535);
  const bool is_usual = input.ConsumeBool();
  const double edge = is_usual ? 1e-3 : length();
  const Vec3 low = is_usual ? Vec3{} : Vec3{place(), place(), place()};
  const Vec3 corner = is_usual ? Vec3{1e-3, 0, 5e-4} : Vec3{place(), place(), place()};
  const Cube cube{corner, input.ConsumeBool() ? 0.7 * edge : length()};
  std::string bytes = input.ConsumeRemainingBytesAsString();
  if (fits)
    bytes.resize(static_cast<std::size_t>(counts[0] * counts[1] * counts[2]) * (is_byte ? 1 : 2));
  fuzz::read_or_refuse<std::runtime_error>([&] {
    const VoxelSet set(bytes, counts, is_byte ? VoxelType::uint8 : VoxelType::uint16, values, low,
                       edge);
    set.contains(corner);
    set.contains(set.low());
    set.side_of(cube);
    set.volume_in(cube);
    set.planes_in(cube, 100);
  });
  return 0;
}
