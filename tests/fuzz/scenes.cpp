// Scenes: the whole reading with the built-in plugins, again for the resolved form; and the plan if
// the body is small.
#include "target.hpp"

#include <plan/plan.hpp>
#include <scene/region_reader.hpp>
#include <scene/scene.hpp>
#include <scene/scene_plugins.hpp>

#include <hyperlattice/plain.hpp>

#include <nlohmann/json.hpp>

using namespace hyperlattice;

namespace {

/// Returns whether the lattice of a resolved scene has few particles. A lattice without a shape has
/// those of its files.
bool is_small(const Scene& scene) {
  constexpr double most = 300;
  const Json resolved = Json::parse(scene.resolved);
  Faults faults;
  Regions regions;
  std::deque<std::string> texts;
  RegionReader reader(resolved["regions"], regions, faults, texts, scene.file.parent_path());
  for (const Json& stage : resolved["pipeline"]) {
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

const fuzz::Folder& folder_of_files() {
  static const fuzz::Folder folder;
  folder.write("tetrahedron.stl",
               "solid a\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 "
               "0\nendloop\nendfacet\n"
               "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 "
               "1\nendloop\nendfacet\n"
               "facet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 0 0 1\nvertex 0 1 "
               "0\nendloop\nendfacet\n"
               "facet normal 0 0 0\nouter loop\nvertex 1 0 0\nvertex 0 1 0\nvertex 0 0 "
               "1\nendloop\nendfacet\nendsolid a\n");
  folder.write("image.raw", std::string(8, '\1'));
  folder.write("points.csv", "x,y,z\n0,0,0\n1,0,0\n0,1,0\n0,0,1\n1,1,1\n");
  folder.write("springs.csv", "a,b\n0,1\n0,2\n0,3\n1,4\n2,4\n3,4\n");
  folder.write("discs.csv", "x,y,z,nx,ny,nz,radius\n0,0,0,0,0,1,1\n");
  return folder;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::Folder& folder = folder_of_files();
  static Host host;
  refuse_scene_plugins();
  const std::string file = folder.file("scene.json");
  fuzz::read_or_refuse<InputError>([&] {
    auto scene = read_scene_text(fuzz::text_of(data, size), file, host);
    fuzz::require(read_scene_text(scene->resolved, file, host)->resolved == scene->resolved);
    if (is_small(*scene)) make_plan(std::move(scene), 1);
  });
  return 0;
}
