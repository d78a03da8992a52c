// Region expressions of a scene: a name, a primitive solid, or a set of regions.
#pragma once

#include <geometry/region.hpp>
#include <scene/json.hpp>
#include <scene/origins.hpp>
#include <scene/variables.hpp>

#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <unordered_map>

namespace hyperlattice {

/// A key of a region expression that combines regions, with its meaning.
struct SetOperation {
  const char* name;
  Region::Kind kind;
};
inline constexpr SetOperation set_operations[] = {{"union", Region::Kind::set_union},
                                                  {"intersection", Region::Kind::intersection},
                                                  {"difference", Region::Kind::difference}};

/// Reads region expressions; each error becomes a fault.
class RegionReader {
 public:
  /// `named` is the scene's "regions", read on demand because regions may refer to each other. A
  /// function that returns null has added a fault, once. `origins` give the folder to which a file
  /// name is relative; without any it is the current folder.
  RegionReader(const Json& named, Regions& regions, Faults& faults, std::deque<std::string>& texts,
               const Origins& origins = {}, const Variables& variables = {});

  /// Returns the folder to which file names in the value at a JSON pointer are relative.
  std::filesystem::path folder_of(const std::string& pointer) const {
    return origins_.folder_of(pointer);
  }
  const Variables& variables() const { return variables_; }
  /// Files that options have named so far; the key is the option's JSON pointer. Option readers
  /// share this map, since their file names are relative to the same folder.
  std::map<std::string, std::filesystem::path>& files() { return files_; }

  /// Returns whether a region of this name is built in or in the scene.
  bool knows(const std::string& name) const;
  /// Returns the names of all regions, built in or in the scene.
  std::vector<std::string> names() const;

  /// Reads all named regions. `resolved` gets the same expressions with SI numbers.
  void read_named(Json& resolved);

  /// Returns the region of an expression. `resolved` gets the expression with SI numbers.
  std::shared_ptr<const Region> read(const Json& expression, const std::string& pointer,
                                     Json& resolved);
  /// Returns the id of a region, which is registered under its name or its expression.
  std::optional<RegionId> read_id(const Json& expression, const std::string& pointer,
                                  Json& resolved);
  /// Returns the Shape of an expression that must be a bounded solid, for a lattice.
  const Shape* read_shape(const Json& expression, const std::string& pointer, Json& resolved);

 private:
  std::shared_ptr<const Region> read_name(const std::string& name, const std::string& pointer);
  std::shared_ptr<const Region> read_primitive(const std::string& key, const Json& parameters,
                                               const std::string& pointer, Json& resolved);
  struct Extent {
    /// depth: levels of nested sets; size: number of regions after all names are replaced by their
    /// expressions; both count the region itself
    std::size_t depth = 1, size = 1;
  };
  bool can_nest(const std::string& pointer, std::size_t depth);
  Extent extent_of(const std::shared_ptr<const Region>& region) const;
  RegionId add(const std::shared_ptr<const Region>& region, const std::string& name);
  std::shared_ptr<const Region> read_set(const SetOperation& operation, const Json& parts,
                                         const std::string& pointer, Json& resolved);

  const Json& named_;
  std::unordered_map<std::string, const Json*> expressions_;  // of named regions, as given
  Regions& regions_;
  Faults& faults_;
  std::deque<std::string>& texts_;
  Origins origins_;
  Variables variables_;
  std::map<std::string, std::filesystem::path> files_;
  std::map<std::string, std::shared_ptr<const Region>> done_;
  // JSON text with SI numbers, of the named regions read so far
  std::map<std::string, std::string> resolved_;
  std::vector<std::string> under_way_;
  std::map<std::shared_ptr<const Region>, Extent> extents_;  // of sets
  std::unordered_map<std::string, RegionId> ids_;            // of regions by name or expression
  std::size_t level_ = 0;  // nesting level (sets and names) at the current position
  bool too_deep_ = false;
};

}  // namespace hyperlattice
