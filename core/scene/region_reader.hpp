// Region expressions of a scene: a name, a primitive solid, or a set of regions.
#pragma once

#include <geometry/region.hpp>
#include <scene/json.hpp>

#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <unordered_map>

namespace hyperlattice {

/// The keys of sets in a region expression, with what they mean.
struct SetOperation {
  const char* name;
  Region::Kind kind;
};
inline constexpr SetOperation set_operations[] = {{"union", Region::Kind::set_union},
                                                  {"intersection", Region::Kind::intersection},
                                                  {"difference", Region::Kind::difference}};

class RegionReader {
 public:
  /// `named` is the scene's "regions": read on demand, since they may refer to each other. Null
  /// pointers in results stand for faults, added once. Files that regions name are relative to
  /// `folder`; empty: to the present one.
  RegionReader(const Json& named, Regions& regions, Faults& faults, std::deque<std::string>& texts,
               std::filesystem::path folder = {});

  const std::filesystem::path& folder() const { return folder_; }
  /// The files that options named so far, by the options' JSON pointers. Options are read beside
  /// regions: they name files of the same folder.
  std::map<std::string, std::filesystem::path>& files() { return files_; }

  /// Reads every named region; `resolved` becomes the same with SI numbers.
  void read_named(Json& resolved);

  /// An expression's region, and the expression with SI numbers.
  std::shared_ptr<const Region> read(const Json& expression, const std::string& pointer,
                                     Json& resolved);
  /// A region's place in the scene, registered under its name or its expression.
  std::optional<RegionId> read_id(const Json& expression, const std::string& pointer,
                                  Json& resolved);
  /// A bounded solid, for a lattice.
  const Shape* read_shape(const Json& expression, const std::string& pointer, Json& resolved);

 private:
  std::shared_ptr<const Region> read_name(const std::string& name, const std::string& pointer);
  std::shared_ptr<const Region> read_primitive(const std::string& key, const Json& parameters,
                                               const std::string& pointer, Json& resolved);
  struct Extent {
    std::size_t depth = 1, size = 1;  ///< levels of sets within sets; regions it is made of, all
                                      ///< names written out; itself counted
  };
  bool can_nest(const std::string& pointer, std::size_t depth);
  Extent extent_of(const std::shared_ptr<const Region>& region) const;
  RegionId add(const std::shared_ptr<const Region>& region, const std::string& name);
  std::shared_ptr<const Region> read_set(const SetOperation& operation, const Json& parts,
                                         const std::string& pointer, Json& resolved);

  const Json& named_;
  std::unordered_map<std::string, const Json*> expressions_;  // of named regions
  Regions& regions_;
  Faults& faults_;
  std::deque<std::string>& texts_;
  std::filesystem::path folder_;
  std::map<std::string, std::filesystem::path> files_;
  std::map<std::string, std::shared_ptr<const Region>> done_;
  std::map<std::string, std::string> resolved_;  // JSON text of the named regions that are done
  std::vector<std::string> under_way_;
  std::map<std::shared_ptr<const Region>, Extent> extents_;  // of sets
  std::unordered_map<std::string, RegionId> ids_;            // of regions by name or expression
  std::size_t level_ = 0;  // of sets within sets and names, where the reader is
  bool too_deep_ = false;
};

}  // namespace hyperlattice
