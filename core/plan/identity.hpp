// What the results of a run depend on, each with what it is made of. Two runs of the same identity
// leave the same bits, however their files are called and wherever they stand.
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
  std::string name;  ///< scene, file: where it stands in the scene, as a JSON pointer; plugin: its
                     ///< name; mode: "instruction set"
  std::filesystem::path path;  ///< file, plugin: where it was found, which does not count
  std::string content;         ///< the hash of what it holds; mode: its value
};

using Identity = std::vector<Dependence>;

/// The identity of a run of this scene by this program as it is now. Threads are no part of it:
/// results do not depend on them. Every input file is read once. OutsideError if one cannot be
/// read.
Identity identity_of(const Scene& scene);

/// What differs: "body.raw (/regions/soft/voxels/file) has changed, and the instruction set is avx2
/// in place of baseline"; empty: nothing.
std::string changes(const Identity& before, const Identity& now);

nlohmann::json identity_json(const Identity& identity);
/// The identity from its JSON; an empty one if that is not an identity's.
Identity read_identity(const nlohmann::json& json);

/// One hash of all of it.
std::string identity_hash(const Identity& identity);

}  // namespace hyperlattice
