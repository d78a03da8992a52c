#include <scene/scene_reader.hpp>

#include <spdlog/fmt/fmt.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

namespace hyperlattice {

namespace {

class HostCatalogue final : public Catalogue {
 public:
  explicit HostCatalogue(Host& host) : host_(host) {}
  const Component* find(const std::string& type) override { return host_.find(type); }
  std::string why_not(const std::string& type) const override { return host_.why_not(type); }
  bool refused(const std::string& type) const override { return host_.refused(type); }
  std::vector<std::string> known_types() const override { return host_.known_types(); }
  std::vector<SearchOutcome> add_scene_paths(const std::vector<std::string>& entries, const std::filesystem::path& scene_folder) override {
    return host_.add_scene_paths(entries, scene_folder);
  }

 private:
  Host& host_;
};

std::string read_text(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(file, error) || std::filesystem::is_directory(file, error))
    throw InputError({{"SCENE", fmt::format("\"{}\"", file.string()), "the path of a scene; there is no such file"}});
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(stream), {}};
  if (!stream.is_open() || stream.bad())
    throw OutsideError(fmt::format("{} cannot be read: {}", file.string(), std::generic_category().message(errno)));
  return text;
}

}  // namespace

std::vector<const Stage*> Scene::of(Family family) const {
  std::vector<const Stage*> found;
  for (const Stage& stage : stages)
    if (stage.family() == family) found.push_back(&stage);
  return found;
}

std::unique_ptr<Scene> read_scene(const std::filesystem::path& file, const std::vector<std::string>& settings, Host& host) {
  HostCatalogue catalogue(host);
  return read_scene_text(read_text(file), file, settings, catalogue);
}

std::unique_ptr<Scene> read_scene_text(std::string_view text, Host& host) {
  HostCatalogue catalogue(host);
  return read_scene_text(text, std::filesystem::current_path() / "scene", {}, catalogue);
}

}  // namespace hyperlattice
