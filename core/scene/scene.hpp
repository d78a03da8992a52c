// The validated scene: typed options in SI units. The scene alone decides what a run does.
#pragma once

#include <base/errors.hpp>
#include <geometry/cut_surface.hpp>
#include <geometry/region.hpp>
#include <host/host.hpp>
#include <scene/origins.hpp>

#include <hyperlattice/material.hpp>

#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hyperlattice {

struct Document;

/// The validated options of one component, in an object of the plugin's type. Owns that object.
using OptionsPointer = std::unique_ptr<void, void (*)(void*)>;

/// Output times of a writer or probe, from keys that the core adds to these families
/// (scene/common_options.hpp).
struct Cadence {
  /// time between outputs, s; 0: only the first and the last; absent: 20 frames or 200 samples over
  /// the run
  std::optional<double> every;
  bool first = true, last = true;
};

/// A surface across which a lattice has no springs from the start.
struct Cut {
  std::string pointer;  ///< JSON pointer of the surface: "/pipeline/0/cuts/0/plane"
  CutSurface surface;
};

/// One stage of the pipeline.
struct Stage {
  const Component* component = nullptr;
  OptionsPointer options{nullptr, [](void*) {}};
  std::string pointer;  ///< JSON pointer of the stage: "/pipeline/3"
  /// label, unique in the family, valid in a file name; default: the type's last part, with a
  /// number if several stages share it
  std::string name;
  RegionId region;              ///< materials: region of the material; default "all"
  std::vector<Stage> failures;  ///< materials: the failure criteria
  std::vector<Cut> cuts;        ///< lattices: the surfaces that cut springs
  Cadence cadence;              ///< writers, probes
  /// solvers: time between history records, s; 0: 200 records over the stage
  double record_every = 0;
  /// solvers: relative error of the energy balance at which the run stops; 0: no limit
  double energy_tolerance = 0;
  /// solvers: part of their distance by which ends of a spring may come nearer in a step; 0: any
  double approach_limit = 0;
  /// solvers: kinetic or stored energy over all that was put in at which the run stops; 0: any
  double growth_limit = 0;
  /// solvers: error of the momentum over the gross one at which the run stops; 0: any
  double momentum_tolerance = 0;
  /// solvers: critical time step, s, that added mass gives the body; 0: no mass is added
  double mass_scaling = 0;

  Family family() const { return component->info.family; }
  /// Returns the family's table of functions: stage.functions<LoadFunctions>().
  template <class Functions>
  const Functions& functions() const {
    return *static_cast<const Functions*>(component->info.functions);
  }
};

/// A file that a scene reads.
struct InputFile {
  std::string pointer;  ///< JSON pointer of the option that names the file
  std::filesystem::path path;
};

/// The springs between particles of two materials.
enum class InterfaceSprings : std::uint32_t {
  series,  ///< two half springs, one of each material
  softer,  ///< the spring of the material with the smaller stiffness
  stiffer  ///< the spring of the other one
};

/// A whole scene after validation.
struct Scene {
  std::filesystem::path file;
  std::string title;
  /// true: unstable lattices (a deformation grows by itself) run with a warning; false: they are
  /// refused
  bool allow_unstable = false;
  /// floating-point type of the state and of the time steps
  Precision precision = Precision::doubles;
  InterfaceSprings interface_springs = InterfaceSprings::series;
  Regions regions;
  std::vector<Stage> stages;          ///< in pipeline order
  std::vector<InputFile> files;       ///< files named by options, one entry per option
  std::vector<std::string> warnings;  ///< about former names of options, and unused variables
  /// values, SI, of the variables that are numbers or quantities
  std::map<std::string, double> variables;
  Origins origins;  ///< the files that the parts of the scene come from
  /// text of scene.resolved.json: all defaults filled in, SI units; running it gives the same bits
  std::string resolved;
  /// storage of text options; the addresses of entries do not change
  std::deque<std::string> texts;

  /// Returns the stages of a family, in pipeline order.
  std::vector<const Stage*> of(Family family) const;

  /// Returns `resolved` for a file in `folder`. Paths to files that share a folder (other than the
  /// root) with the scene and with `folder` become relative to `folder`, so that the shared folder
  /// can be moved or copied as a whole. All other paths stay absolute.
  std::string resolved_in(const std::filesystem::path& folder) const;
};

/// Reads, patches (`--set`, see apply_settings()) and validates a scene, and loads the plugins that
/// it names. Throws InputError with all faults found, and OutsideError if an existing file cannot
/// be read or if a library that the host refuses is the only fault.
std::unique_ptr<Scene> read_scene(const std::filesystem::path& file,
                                  const std::vector<std::string>& settings, Host& host);

/// Reads a scene from its text. `file` gives the folder in which plugins are looked for; the file
/// is not opened.
std::unique_ptr<Scene> read_scene_text(std::string_view text, const std::filesystem::path& file,
                                       Host& host);

/// Reads a document that was parsed and merged before.
std::unique_ptr<Scene> read_scene_document(const Document& document,
                                           const std::filesystem::path& file, Host& host);

/// Reads a scene that has no file. Files and plugins that it names are relative to the current
/// folder.
std::unique_ptr<Scene> read_scene_text(std::string_view text, Host& host);

/// Returns the JSON Schema (2020-12) of a scene with the given components.
std::string scene_schema(const std::vector<const Component*>& components);

/// Returns a component's documentation, as Markdown for people and pages, or as JSON for machines.
std::string component_page(const Component& component);
std::string component_json(const Component& component);

}  // namespace hyperlattice
