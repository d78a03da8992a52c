// Reads objects of a study file by a Schema<Options>, as the options of a scene, but without
// regions and shapes.
#pragma once

#include <scene/option_reader.hpp>

#include <nlohmann/json.hpp>

namespace hyperlattice::study {

class ObjectReader {
 public:
  explicit ObjectReader(Faults& faults)
      : faults_(faults), region_reader_(none_, regions_, faults, texts_) {}

  Faults& faults() { return faults_; }

  /// Returns the options of a class that has `struct Options` and `static Schema<Options>
  /// schema()`; nothing after faults. Keys that are neither options nor among `others` are faults.
  template <class Declared>
  std::optional<typename Declared::Options> read(const Json& object, const std::string& pointer,
                                                 std::vector<std::string> others = {}) {
    if (!object.is_object()) {
      faults_.add(pointer.empty() ? "study" : pointer, shown(object), "an object");
      return std::nullopt;
    }
    Json resolved;
    OptionReader reader(object, pointer, {faults_, region_reader_, texts_}, std::move(others));
    const OptionsPointer options = reader.fill(option_set<Declared>(), resolved);
    reader.reject_unknown();
    if (!options) return std::nullopt;
    return *static_cast<const typename Declared::Options*>(options.get());
  }

 private:
  Faults& faults_;
  const Json none_ = Json::object();
  Regions regions_;
  std::deque<std::string> texts_;
  RegionReader region_reader_;
};

}  // namespace hyperlattice::study
