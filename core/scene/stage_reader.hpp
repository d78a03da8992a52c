// Reads a scene's pipeline: each stage by its component's declaration, and the rules of their
// order.
#pragma once

#include <scene/option_reader.hpp>
#include <scene/scene_reader.hpp>

namespace hyperlattice {

class StageReader {
 public:
  /// Refused libraries go to `refusals`: where they are named, and the reason.
  StageReader(Reading reading, Catalogue& catalogue, std::vector<Fault>& refusals);

  /// Reads the pipeline of `scene`. Returns it with SI numbers and all defaults.
  Json read(const Json& scene, std::vector<Stage>& stages);

 private:
  std::optional<Stage> read_stage(const Json& given, const std::string& pointer, Json& resolved);
  std::unique_ptr<Stage> read_failure(const Json& given, const std::string& pointer,
                                      Json& resolved);
  const Component* find(const Json& given, const std::string& pointer, Family family);
  std::optional<Family> read_family(const Json& given, const std::string& pointer);
  void check_order(const std::vector<std::optional<Family>>& families);
  void give_names(std::vector<Stage>& stages, Json& resolved);

  Reading reading_;
  Catalogue& catalogue_;
  std::vector<Fault>& refusals_;
};

}  // namespace hyperlattice
