// The identity of a run: all that its results depend on, with hashes. Two runs of the same identity
// leave the same bits, whatever their files are called and wherever they are.
#pragma once

#include <scene/scene.hpp>

#include <nlohmann/json_fwd.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hyperlattice {

/// One thing that results depend on.
struct Dependence {
  enum class Kind { scene, file, plugin, program, mode };

  Kind kind = Kind::scene;
  /// Scene, file: its place in the scene, as a JSON pointer; plugin: its name; mode: "instruction
  /// set".
  std::string name;
  std::filesystem::path path;  ///< file, plugin: where it was found; not compared
  std::string content;         ///< hash of the content; mode: its value
};

using Identity = std::vector<Dependence>;

/// Returns the identity of a run of this scene by the present program. Threads are no part of it,
/// because results do not depend on them. Reads every input file once. Throws OutsideError if one
/// cannot be read.
Identity identity_of(const Scene& scene);

/// Returns the differences as a clause, "" if there are none: "body.raw (/regions/soft/voxels/file)
/// has changed, and the instruction set is avx2 in place of baseline".
std::string changes(const Identity& before, const Identity& now);

nlohmann::json identity_json(const Identity& identity);
/// Returns the identity from its JSON; an empty one if the JSON is not an identity's.
Identity read_identity(const nlohmann::json& json);

/// Returns one hash of the whole identity.
std::string identity_hash(const Identity& identity);

}  // namespace hyperlattice
