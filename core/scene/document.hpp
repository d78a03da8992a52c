// A scene's JSON with the files that it includes.
#pragma once

#include <base/errors.hpp>
#include <scene/json.hpp>
#include <scene/origins.hpp>

#include <nlohmann/json.hpp>

#include <filesystem>
#include <set>
#include <string>

namespace hyperlattice {

/// A scene before it is validated.
struct Document {
  Json json;
  Origins origins;
  std::set<std::string> variables;  ///< names that the files define
  bool is_whole = true;             ///< false: an included file is missing or faulty
};

/// Parses a scene and the files that its key "include" names, and merges them. Objects are merged
/// key by key, and the including file wins; stages of "pipeline" and entries of "plugins" of
/// included files stand before its own. A file counts once, where it is first included. `text`:
/// content of `file`. Returns what could be read; adds a fault for all else.
Document read_document(std::string_view text, const std::filesystem::path& file, Faults& faults);

}  // namespace hyperlattice
