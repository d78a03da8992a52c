// Reads a scene's pipeline: each stage by its component's declaration, and the rules for the order
// of stages.
#pragma once

#include <scene/option_reader.hpp>
#include <scene/scene_reader.hpp>

namespace hyperlattice {

/// Reads stages; each error becomes a fault.
class StageReader {
 public:
  /// `refusals` gets an entry for each refused library: the place that names it, and the reason.
  StageReader(Reading reading, Catalogue& catalogue, std::vector<Fault>& refusals);

  /// Reads the pipeline of `scene` into `stages`. Returns the pipeline with SI numbers and all
  /// defaults.
  Json read(const Json& scene, std::vector<Stage>& stages);

 private:
  std::optional<Stage> read_stage(const Json& given, const std::string& pointer, Json& resolved);
  std::optional<std::vector<Stage>> read_failures(const Json& given, const std::string& pointer,
                                                  Json& resolved);
  std::optional<Stage> read_failure(const Json& given, const std::string& pointer, Json& resolved);
  const Component* find(const Json& given, const std::string& pointer, Family family);
  std::optional<Family> read_family(const Json& given, const std::string& pointer);
  void find_fields(const Json& pipeline);
  void check_order(const std::vector<std::optional<Family>>& families);
  void give_names(std::vector<Stage>& stages, Json& resolved);

  std::vector<std::string> loads_;            ///< their labels
  std::vector<std::string> ambiguous_loads_;  ///< labels that stand for the first of several
  std::vector<std::string_view> fields_;      ///< that materials declare, each once
  Reading reading_;
  Catalogue& catalogue_;
  std::vector<Fault>& refusals_;
};

}  // namespace hyperlattice
