// Reads the options of one object of a scene: units, kinds, ranges, defaults, cross-checks. All
// errors are added to the faults.
#pragma once

#include <base/option_set.hpp>
#include <scene/json.hpp>
#include <scene/region_reader.hpp>
#include <scene/scene.hpp>

namespace hyperlattice {

/// The shared data of all readers of one scene.
struct Reading {
  Faults& faults;
  RegionReader& regions;
  std::deque<std::string>& texts;
  /// Labels of the scene's loads, in their order.
  std::span<const std::string> loads = {};
  /// Those of `loads` that stand for the first of several loads without a label, which have
  /// numbers.
  std::span<const std::string> ambiguous_loads = {};
  /// Fields that the scene's materials declare.
  std::span<const std::string_view> fields = {};
};

struct ReadValue;

/// Reads options from one JSON object.
class OptionReader {
 public:
  /// `pointer` is the JSON pointer of `object`. `keys` are keys that are allowed but are no options
  /// ("type").
  OptionReader(const Json& object, std::string pointer, Reading reading,
               std::vector<std::string> keys = {});

  /// Returns new options of the set, filled and checked; null after faults. Appends every value,
  /// given or default, in SI units to `resolved`. An option that the object gives by a former name
  /// is accepted with a warning; `resolved` has its present name.
  OptionsPointer fill(const OptionSet& set, Json& resolved);
  /// Adds a fault for each key that none of the filled sets declares.
  void reject_unknown();

 private:
  bool fill_one(const OptionSet& set, const Option& option, void* options, Json& resolved);
  bool read_given(const Option& option, const std::string& key, ReadValue& value, Json& resolved);
  std::string key_of(std::string_view option) const;
  bool is_known(const std::string& key) const;
  std::string nearest_option(const std::string& key) const;
  bool check(const OptionSet& set, const void* options);

  const Json& object_;
  std::string pointer_;
  Reading reading_;
  std::vector<std::string> known_;
  std::vector<OldName> old_names_;
};

}  // namespace hyperlattice
