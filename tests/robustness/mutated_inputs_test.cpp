// Files and texts damaged at random: surfaces, tables, images, units. Each is read, or refused with
// a message; no other outcome is allowed.
#include <base/csv.hpp>
#include <base/errors.hpp>
#include <geometry/triangle_mesh.hpp>
#include <geometry/voxel_image.hpp>
#include <quantities/units.hpp>

#include <hyperlattice/tables.hpp>

#include <gtest/gtest.h>
#include <support/mutations.hpp>
#include <support/output.hpp>

#include <cstring>

namespace mutated_inputs_test {
using namespace hyperlattice;
using namespace std::string_view_literals;  // texts with NUL bytes

constexpr int quick = 1'000, thorough = 20'000;

/// The facets of a tetrahedron, anticlockwise seen from outside.
constexpr double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr int facets[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};

std::string text_surface() {
  std::string text = "solid a\n";
  for (const auto& facet : facets) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const int c : facet) {
      text += "vertex";
      for (const double x : corners[c]) text += ' ' + std::to_string(x);
      text += '\n';
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid a\n" + text + "endsolid b\n";
}

std::string binary_surface() {
  std::string bytes(80, ' ');
  const auto append = [&](auto number) {
    char raw[sizeof number];
    std::memcpy(raw, &number, sizeof number);
    bytes.append(raw, sizeof number);
  };
  append(std::uint32_t{4});
  for (const auto& facet : facets) {
    for (int n = 0; n < 3; ++n) append(0.0F);
    for (const int c : facet)
      for (const double x : corners[c]) append(static_cast<float>(x));
    append(std::uint16_t{0});
  }
  return bytes;
}

/// Runs `read` on damaged copies. Some must be accepted, some refused. An exception other than
/// std::runtime_error (or derived) and std::invalid_argument fails the test.
template <class Read>
void read_damaged(const std::string& good, std::string_view alphabet, int usual, unsigned seed,
                  const Read& read) {
  test::Damage damage(seed);
  const int tries = test::mutations(usual);
  int taken = 0;
  for (int n = 0; n < tries; ++n) {
    const std::string text = damage(good, alphabet);
    try {
      taken += read(text) ? 1 : 0;
    } catch (const std::runtime_error& refusal) {
      EXPECT_STRNE(refusal.what(), "");
    } catch (const std::invalid_argument& refusal) {
      EXPECT_STRNE(refusal.what(), "");
    }
  }
  // HYPERLATTICE_MUTATIONS may ask for fewer copies; all of these may be accepted, or all refused.
  constexpr int enough = 200;
  if (tries < enough) return;
  EXPECT_GT(taken, 0) << good;
  EXPECT_LT(taken, tries) << good;
}

bool is_solid(std::string_view bytes) {
  TriangleMesh mesh = read_stl(bytes, 1e-3);
  if (!solid_fault(mesh).empty() && !sections_are_solids(mesh)) return false;
  const SurfaceAreas areas = surface_areas(mesh);
  EXPECT_GE(areas.outer, 0);
  const InsideTest inside(std::move(mesh));
  const bool is_oriented = orientation_fault(inside).empty();
  for (const double x : {-1e-3, 0.0, 1e-4, 1.0}) inside({x, 1e-4, 1e-4});
  return is_oriented;
}

void surfaces(int usual) {
  constexpr std::string_view words = "0123456789.+-eE \t\r\nsolidfacetSOLID\xEF\xBB\xBF\0"sv;
  ASSERT_TRUE(is_solid(text_surface()));
  ASSERT_TRUE(is_solid(binary_surface()));
  read_damaged(text_surface(), words, usual, 21, is_solid);
  read_damaged(binary_surface(), "\0\1\x7F\x80\xFF solid"sv, usual, 22, is_solid);
}

void tables(int usual) {
  const std::string good =
      "\xEF\xBB\xBF\"x\";y;z;volume\n0;0;0;1\n\n+1e0;0;0;1\n# no row\n0;1;0;1\n\"0\";0;\"1\";1\n";
  constexpr std::string_view bytes = "0123456789.,;+-eE\" \t\r\n#xyz\xEF\xBB\xBF\0"sv;
  const test::Folder folder("mutated_tables");
  static constexpr std::string_view names[] = {"x", "y", "z"}, more[] = {"volume"};
  read_damaged(good, bytes, usual, 23, [&](const std::string& text) {
    const CsvTable table = parse_csv(text);
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size());
    std::ofstream(folder.file("table.csv"), std::ios::binary) << text;
    const NumberTable numbers(folder.file("table.csv"), names, more);
    EXPECT_EQ(numbers["x"].size(), numbers["z"].size());
    return true;
  });
}

void units(int usual) {
  constexpr std::string_view bytes =
      "0123456789.,+-eE /*^()'\"@_%mskgNPaGMuhrpin\xC2\xA0\xB5\xB2\0"sv;
  unsigned seed = 24;
  const std::pair<const char*, const char*> texts[] = {{"10 GPa", "Pa"},
                                                       {"2500 kg/(m s2)", "Pa"},
                                                       {"1.5e-3 N mm-2", "Pa"},
                                                       {"3 kg\xC2\xB7m\xC2\xB2 s^-1", "kg m2/s"},
                                                       {"60 rpm", "rad/s"}};
  for (const auto& [good, unit] : texts)
    read_damaged(good, bytes, usual, seed++, [unit = unit](const std::string& text) {
      const Quantity quantity = read_quantity(text, unit);
      EXPECT_TRUE(!quantity.problem.empty() || std::isfinite(quantity.value)) << text;
      return quantity.problem.empty();
    });
}

void images(int usual) {
  test::Damage damage(25);
  const std::string good(4 * 3 * 2, '\1');
  for (int n = test::mutations(usual); n > 0; --n) {
    const std::array<std::int64_t, 3> counts{1 + static_cast<std::int64_t>(damage.below(6)), 3,
                                             1 + static_cast<std::int64_t>(damage.below(100'000))};
    const bool is_right = damage.below(3) == 0;
    try {
      const VoxelSet set(damage(good, "\0\1\2\xFF"sv),
                         is_right ? std::array<std::int64_t, 3>{4, 3, 2} : counts,
                         damage.below(2) == 0 ? VoxelType::uint8 : VoxelType::uint16,
                         {static_cast<double>(damage.below(3))}, {0, 0, 0}, 1);
      set.contains({0.5, 0.5, 0.5});
    } catch (const std::runtime_error& refusal) {
      EXPECT_STRNE(refusal.what(), "");
    }
  }
}

TEST(MutatedInputs, Surfaces) { surfaces(quick); }
TEST(MutatedInputs, Tables) { tables(quick); }
TEST(MutatedInputs, Units) { units(quick); }
TEST(MutatedInputs, Images) { images(quick); }

TEST(LongMutatedInputs, Surfaces) { surfaces(thorough); }
TEST(LongMutatedInputs, Tables) { tables(thorough); }
TEST(LongMutatedInputs, Units) { units(thorough); }
TEST(LongMutatedInputs, Images) { images(thorough); }

}  // namespace mutated_inputs_test
