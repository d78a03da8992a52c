#include <base/input_file.hpp>
#include <scene/scene_plugins.hpp>
#include <scene/scene_reader.hpp>

namespace hyperlattice {

namespace {

class HostCatalogue final : public Catalogue {
 public:
  explicit HostCatalogue(Host& host) : host_(host) {}
  const Component* find(const std::string& type) override { return host_.find(type); }
  std::string why_not(const std::string& type) const override { return host_.why_not(type); }
  bool refused(const std::string& type) const override { return host_.refused(type); }
  std::vector<std::string> known_types() const override { return host_.known_types(); }
  bool allows_scene_plugins() const override { return !refuses_scene_plugins(); }
  std::vector<SearchOutcome> add_scene_paths(const std::vector<std::string>& entries,
                                             const std::filesystem::path& scene_folder) override {
    return host_.add_scene_paths(entries, scene_folder);
  }

 private:
  Host& host_;
};

}  // namespace

std::vector<const Stage*> Scene::of(Family family) const {
  std::vector<const Stage*> found;
  for (const Stage& stage : stages)
    if (stage.family() == family) found.push_back(&stage);
  return found;
}

std::unique_ptr<Scene> read_scene(const std::filesystem::path& file,
                                  const std::vector<std::string>& settings, Host& host) {
  HostCatalogue catalogue(host);
  return read_scene_text(read_input_file(file, "SCENE", "the path of a scene"), file, settings,
                         catalogue);
}

std::unique_ptr<Scene> read_scene_text(std::string_view text, const std::filesystem::path& file,
                                       Host& host) {
  HostCatalogue catalogue(host);
  return read_scene_text(text, file, {}, catalogue);
}

std::unique_ptr<Scene> read_scene_document(const Document& document,
                                           const std::filesystem::path& file, Host& host) {
  HostCatalogue catalogue(host);
  return read_scene_document(document, file, catalogue);
}

std::unique_ptr<Scene> read_scene_text(std::string_view text, Host& host) {
  return read_scene_text(text, std::filesystem::current_path() / "scene", host);
}

}  // namespace hyperlattice
