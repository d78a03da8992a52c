// A scene: typed, in SI units, every option validated. What a run does is decided by this and
// nothing else.
#pragma once

#include <base/errors.hpp>
#include <geometry/region.hpp>
#include <host/host.hpp>

#include <hyperlattice/material.hpp>

#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyperlattice {

/// The options of one component, filled and validated; owned memory of the plugin's type.
using OptionsPointer = std::unique_ptr<void, void (*)(void*)>;

/// When a writer or probe is due; keys that the core adds to those families
/// (scene/common_options.hpp).
struct Cadence {
  std::optional<double> every;  ///< seconds between outputs; 0: only first and last; absent: 20
                                ///< frames or 200 samples over the run
  bool first = true, last = true;
};

/// One stage of the pipeline.
struct Stage {
  const Component* component = nullptr;
  OptionsPointer options{nullptr, [](void*) {}};
  std::string pointer;  ///< where it stands: "/pipeline/3"
  std::string name;  ///< label, unique in its family; default: type's last part, with a number if
                     ///< several; fit for a file's name
  RegionId region;   ///< materials: where the material is; default all
  std::unique_ptr<Stage> failure;  ///< materials: the failure criterion, if any
  Cadence cadence;                 ///< writers, probes
  double record_every =
      0;  ///< solvers: seconds between history records; 0: 200 records over the stage
  double energy_tolerance =
      0;  ///< solvers: relative balance error at which the run stops; 0: never

  Family family() const { return component->info.family; }
  /// The family's table of functions: stage.functions<LoadFunctions>().
  template <class Functions>
  const Functions& functions() const {
    return *static_cast<const Functions*>(component->info.functions);
  }
};

/// A file that a scene reads.
struct InputFile {
  std::string pointer;  ///< of the option that names it
  std::filesystem::path path;
};

struct Scene {
  std::filesystem::path file;
  std::string title;
  bool allow_unstable = false;  ///< lattices of which some deformation grows by itself run with a
                                ///< warning, instead of being refused
  Precision precision = Precision::doubles;  ///< of the state and of the steps
  Regions regions;
  std::vector<Stage> stages;     ///< in the pipeline's order
  std::vector<InputFile> files;  ///< that its options name, each option once
  std::string
      resolved;  ///< scene.resolved.json: every default filled, SI; running it gives the same bits
  std::deque<std::string> texts;  ///< backing of text options; entries stay where they are

  std::vector<const Stage*> of(Family family) const;

  /// `resolved` as it is written into a folder: what stands with the scene below one folder that
  /// holds the results, too, is named relative to them, so that this folder can be moved or copied
  /// as a whole. Anything else is named by its whole path.
  std::string resolved_in(const std::filesystem::path& folder) const;
};

/// Reads, patches (`--set /pointer=value`) and validates a scene, loading the plugins it names.
/// Throws InputError with every fault found; OutsideError if the file is there but cannot be read,
/// or if the only thing wrong is that the host refuses a library.
std::unique_ptr<Scene> read_scene(const std::filesystem::path& file,
                                  const std::vector<std::string>& settings, Host& host);

/// The same of a scene's text. `file` says where it stands, which is where the plugins it names are
/// looked for; it is not opened.
std::unique_ptr<Scene> read_scene_text(std::string_view text, const std::filesystem::path& file,
                                       Host& host);

/// The same of a scene that stands in no file; what it names is looked for in the present folder.
std::unique_ptr<Scene> read_scene_text(std::string_view text, Host& host);

/// The JSON Schema (2020-12) of a scene with the given components.
std::string scene_schema(const std::vector<const Component*>& components);

/// A component's documentation, as Markdown for people and pages, or as JSON for machines.
std::string component_page(const Component& component);
std::string component_json(const Component& component);

}  // namespace hyperlattice
