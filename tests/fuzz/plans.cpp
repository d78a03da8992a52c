// Plans of scenes with small bodies. A plan takes about 50 ms, so that tests/fuzz/run makes fewer.
#include "scene_files.hpp"

#include <plan/plan.hpp>
#include <scene/region_reader.hpp>
#include <scene/scene_plugins.hpp>

#include <nlohmann/json.hpp>

using namespace hyperlattice;

namespace {

/// Returns whether a resolved scene has few particles and draws small pictures. A lattice without a
/// shape has the particles of its files.
bool is_small(const Scene& scene) {
  constexpr double most = 300, pixels = 64 * 64;
  const Json resolved = Json::parse(scene.resolved);
  Faults faults;
  Regions regions;
  std::deque<std::string> texts;
  RegionReader reader(resolved["regions"], regions, faults, texts, scene.file.parent_path());
  for (const Json& stage : resolved["pipeline"]) {
    if (stage.contains("width") && stage["width"].is_number() &&
        stage["width"].get<double>() * stage.value("height", 1.0) > pixels)
      return false;
    if (!word_in(stage, "type").starts_with("lattices.") || !stage.contains("shape") ||
        !stage.contains("spacing"))
      continue;
    Json ignored;
    const Shape* shape =
        stage["shape"].is_null() ? nullptr : reader.read_shape(stage["shape"], "", ignored);
    if (shape == nullptr) continue;
    if (!stage["spacing"].is_number()) return false;
    const Vec3 cells = (1 / stage["spacing"].get<double>()) * (shape->high - shape->low);
    if (!((cells.x + 1) * (cells.y + 1) * (cells.z + 1) < most)) return false;
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::string file = fuzz::scene_files().file("scene.json");
  static Host host;
  refuse_scene_plugins();
  fuzz::read_or_refuse<InputError>([&] {
    auto scene = read_scene_text(fuzz::text_of(data, size), file, host);
    if (is_small(*scene)) make_plan(std::move(scene), 1);
  });
  return 0;
}
