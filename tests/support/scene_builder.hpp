// Scenes for tests, built stage by stage. The keys of a stage are given as a list, or as a piece of
// JSON text where a table of cases holds it.
#pragma once

#include <scene/json.hpp>

#include <hyperlattice/plain.hpp>

#include <nlohmann/json.hpp>

#include <initializer_list>
#include <string>
#include <utility>

namespace hyperlattice {

template <class Json>
void to_json(Json& json, const Vec3& v) {
  json = {v.x, v.y, v.z};
}

}  // namespace hyperlattice

namespace hyperlattice::test {

/// Parses the inside of an array or object. Commas and blanks at the ends of the text do not count.
/// Throws InputError for wrong syntax or a duplicate key.
inline Json parse_inside(const std::string& text, char open, char close) {
  const char* const separators = ", \n";
  const std::size_t begin = text.find_first_not_of(separators);
  const std::string inside =
      begin == std::string::npos
          ? ""
          : text.substr(begin, text.find_last_not_of(separators) + 1 - begin);
  Json json;
  Faults faults;
  parse_json(open + inside + close, json, faults);
  faults.throw_if_any();
  return json;
}

/// Keys of a stage with their values.
class Keys {
 public:
  Keys() = default;
  Keys(std::initializer_list<std::pair<std::string, Json>> keys) {
    for (const auto& [name, value] : keys) json_[name] = value;
  }
  /// The text is as between the braces of an object.
  Keys(const std::string& text) : json_(parse_inside(text, '{', '}')) {}
  Keys(const char* text) : Keys(std::string(text)) {}

  const Json& json() const { return json_; }
  /// A key of b replaces the same key of a.
  friend Keys operator+(Keys a, const Keys& b) {
    a.json_.update(b.json_);
    return a;
  }

 private:
  Json json_ = Json::object();
};

/// Stages of a pipeline, in their order.
class Stages {
 public:
  Stages() = default;
  /// One stage; the keys include its type.
  Stages(const Keys& stage) { json_.push_back(stage.json()); }
  Stages(std::initializer_list<std::pair<std::string, Json>> keys) : Stages(Keys(keys)) {}
  /// The text is as between the brackets of an array.
  Stages(const std::string& text) : json_(parse_inside(text, '[', ']')) {}
  Stages(const char* text) : Stages(std::string(text)) {}

  const Json& json() const { return json_; }
  friend Stages operator+(Stages a, const Stages& b) {
    for (const Json& stage : b.json_) a.json_.push_back(stage);
    return a;
  }

 private:
  Json json_ = Json::array();
};

inline Stages stage(const std::string& type, const Keys& keys = {}) {
  return Keys{{"type", type}} + keys;
}

/// A box as a scene describes it.
inline Json box(Vec3 low, Vec3 high) { return {{"box", {{"low", low}, {"high", high}}}}; }

/// n mm in m; has the bits of the text "<n>e-3".
inline double mm(int n) { return n / 1000.0; }

/// A box of nx * ny * nz mm with its corner at the origin.
inline Json box_mm(int nx, int ny, int nz) { return box({}, {mm(nx), mm(ny), mm(nz)}); }

/// A scene. Each function but the last two adds to it.
class SceneBuilder {
 public:
  SceneBuilder() : json_{{"format", "hyperlattice/1"}, {"pipeline", Json::array()}} {}
  /// Goes on from the text of a scene.
  explicit SceneBuilder(const std::string& text) : json_(Json::parse(text)) {}

  SceneBuilder& key(const std::string& name, const Json& value) {
    json_[name] = value;
    return *this;
  }
  SceneBuilder& region(const std::string& name, const Json& shape) {
    json_["regions"][name] = shape;
    return *this;
  }
  SceneBuilder& stages(const Stages& more) {
    for (const Json& one : more.json()) json_["pipeline"].push_back(one);
    return *this;
  }
  SceneBuilder& stage(const std::string& type, const Keys& keys = {}) {
    return stages(test::stage(type, keys));
  }
  SceneBuilder& lattice(const std::string& type, double spacing, const Json& shape,
                        const Keys& more = {}) {
    return stage(type, Keys{{"spacing", spacing}, {"shape", shape}} + more);
  }
  SceneBuilder& material(const std::string& type, const Keys& keys) { return stage(type, keys); }
  SceneBuilder& load(const std::string& type, const Keys& keys) { return stage(type, keys); }
  SceneBuilder& solver(const std::string& type, const Keys& keys = {}) { return stage(type, keys); }

  const Json& json() const { return json_; }
  std::string text() const { return json_.dump(); }

 private:
  Json json_;
};

}  // namespace hyperlattice::test
