// Scenes damaged at random. The reader accepts them or says what is wrong; no other outcome is
// allowed.
#include "support/fake_components.hpp"
#include "support/mutations.hpp"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

namespace mutated_scenes_test {
using namespace hyperlattice;
using Json = nlohmann::ordered_json;

const std::string good = R"({ "format": "hyperlattice/1", "title": "t",
  "regions": { "tip": { "box": { "low": [0, 0, "9 mm"], "high": ["10 mm", "10 mm", "10 mm"] } },
               "body": { "difference": [ { "sphere": { "radius": "10 mm" } }, "tip" ] } },
  "pipeline": [
    { "type": "lattices.grid", "spacing": "1 mm", "shape": "body" },
    { "type": "materials.spring", "young": "10 GPa", "poisson": 0.2, "density": 2500, "failure": { "type": "failures.limit", "limit": "3.5e-3 mm" } },
    { "type": "loads.push", "times": [0, "2 us"], "on": { "intersection": ["x_max", "tip"] }, "repeats": 3 },
    { "type": "solvers.march", "end_time": "40 us", "time_step": "auto" },
    { "type": "writers.table", "every": "2 us", "fields": ["velocity", "damage"] } ] })";

/// Returns true if the text was accepted; the resolved form must then read back. Throws if the
/// reader throws anything but an InputError.
bool accepted(const std::string& text) {
  fakes::Catalogue catalogue;
  try {
    const auto scene = read_scene_text(text, "scene.json", {}, catalogue);
    EXPECT_EQ(read_scene_text(scene->resolved, "scene.json", {}, catalogue)->resolved,
              scene->resolved);
    return true;
  } catch (const InputError& error) {
    EXPECT_FALSE(error.faults().empty());
    return false;
  }
}

/// Collects the pointers to all values of a document.
void collect(const Json& value, const Json::json_pointer& at,
             std::vector<Json::json_pointer>& places) {
  places.push_back(at);
  if (value.is_object())
    for (const auto& item : value.items()) collect(item.value(), at / item.key(), places);
  else if (value.is_array())
    for (std::size_t n = 0; n < value.size(); ++n) collect(value[n], at / n, places);
}

constexpr int quick = 5'000, thorough = 20'000;

void damage_bytes(int usual) {
  test::Damage damage(11);
  int count = 0;
  const int tries = test::mutations(usual);
  for (int n = 0; n < tries; ++n)
    count += accepted(damage(good, "{}[]\",:/\\0123456789.eE+- tnfu\n\x01\xC3\xFF"));
  EXPECT_GT(count, 0);
  EXPECT_LT(count, tries);
}

void misplace_values(int usual) {
  test::Damage damage(13);
  const Json scene = Json::parse(good);
  std::vector<Json::json_pointer> places;
  collect(scene, Json::json_pointer(), places);
  int count = 0;
  const int tries = test::mutations(usual);
  for (int n = 0; n < tries; ++n) {
    Json mixed = scene;
    const Json value = scene[places[damage.below(places.size())]];
    mixed[places[damage.below(places.size())]] = value;
    count += accepted(mixed.dump());
  }
  EXPECT_GT(count, 0);
  EXPECT_LT(count, tries);
}

TEST(MutatedScenes, DamagedBytes) { damage_bytes(quick); }
TEST(MutatedScenes, MisplacedValues) { misplace_values(quick); }

TEST(LongMutatedScenes, DamagedBytes) { damage_bytes(thorough); }
TEST(LongMutatedScenes, MisplacedValues) { misplace_values(thorough); }

}  // namespace mutated_scenes_test
