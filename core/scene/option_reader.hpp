// Reads the options of one object of a scene: units, kinds, ranges, defaults, cross-checks.
// Everything wrong with it is added to the faults.
#pragma once

#include <base/option_set.hpp>
#include <scene/json.hpp>
#include <scene/region_reader.hpp>
#include <scene/scene.hpp>

namespace hyperlattice {

/// What reading needs besides the JSON.
struct Reading {
  Faults& faults;
  RegionReader& regions;
  std::deque<std::string>& texts;
};

class OptionReader {
 public:
  /// `object` stands at `pointer`. `keys` are known without being options ("type").
  OptionReader(const Json& object, std::string pointer, Reading reading,
               std::vector<std::string> keys = {});

  /// New options of the set, filled and checked; null after faults. Appends every value, given or
  /// default, in SI to `resolved`.
  OptionsPointer fill(const OptionSet& set, Json& resolved);
  /// Faults for keys that no set filled so far declares.
  void reject_unknown();

 private:
  bool fill_one(const OptionSet& set, const Option& option, void* options, Json& resolved);
  bool check(const OptionSet& set, const void* options);

  const Json& object_;
  std::string pointer_;
  Reading reading_;
  std::vector<std::string> known_;
};

}  // namespace hyperlattice
