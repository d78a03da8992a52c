// Reads a scene from its text. A catalogue gives the components: the host's, or one of a test.
#pragma once

#include <scene/scene.hpp>

namespace hyperlattice {

/// The source of components.
class Catalogue {
 public:
  virtual ~Catalogue() = default;
  /// Returns the component of a type, or null. After null, why_not() gives the reason, and
  /// refused() says whether the library is the cause.
  virtual const Component* find(const std::string& type) = 0;
  virtual std::string why_not(const std::string& type) const = 0;
  virtual bool refused(const std::string& type) const = 0;
  virtual std::vector<std::string> known_types() const = 0;
  /// Returns whether a scene may have the key "plugins".
  virtual bool allows_scene_plugins() const { return true; }
  /// Adds the scene's "plugins". Returns one outcome per entry.
  virtual std::vector<SearchOutcome> add_scene_paths(const std::vector<std::string>& entries,
                                                     const std::filesystem::path& scene_folder) = 0;
};

/// Reads a scene with components from `catalogue`. Throws as read_scene does. `file` gives the
/// scene's folder; the file is not opened.
std::unique_ptr<Scene> read_scene_text(std::string_view text, const std::filesystem::path& file,
                                       const std::vector<std::string>& settings,
                                       Catalogue& catalogue);

/// Reads a document that was parsed and merged before.
std::unique_ptr<Scene> read_scene_document(const Document& document,
                                           const std::filesystem::path& file, Catalogue& catalogue);

}  // namespace hyperlattice
