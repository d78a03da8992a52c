#include <base/input_file.hpp>
#include <scene/document.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>

namespace hyperlattice {

namespace {

namespace fs = std::filesystem;

constexpr const char* include_key = "include";
constexpr std::size_t most_files = 1000;
constexpr std::size_t most_bytes = std::size_t{64} << 20U;  // of all included files

/// Returns whether lists at this pointer are joined and not replaced.
bool is_joined(const std::string& pointer) {
  return pointer == "/pipeline" || pointer == "/plugins";
}

class DocumentReader {
 public:
  DocumentReader(const fs::path& file, Faults& faults)
      : root_(fs::absolute(file).lexically_normal()), faults_(faults) {
    document_.origins = Origins(root_);
  }

  Document read(std::string_view text) {
    add_file(text, root_);
    document_.is_whole = !several_ || faults_.empty();
    if (document_.json.is_object() && document_.json.contains("variables") &&
        document_.json["variables"].is_object())
      for (const auto& item : document_.json["variables"].items())
        document_.variables.insert(item.key());
    return std::move(document_);
  }

 private:
  void add_file(std::string_view text, const fs::path& file) {
    seen_.insert(file);
    under_way_.push_back(file);
    Json json;
    Faults own;
    const bool parsed = parse_json(text, json, own);
    const bool includes = json.is_object() && json.contains(include_key);
    several_ = several_ || includes;
    for (const Fault& fault : own.all())
      faults_.add(place(file, fault.pointer), fault.value, fault.expected);
    if (parsed) {
      if (includes) {
        const Json names = json[include_key];
        json.erase(include_key);
        add_included(names, file);
      }
      if (file != root_ && !json.is_object())
        faults_.add(place(file, ""), shown(json), "an object with parts of a scene");
      else
        merge(document_.json, std::move(json), "", "", file);
    }
    under_way_.pop_back();
  }

  void add_included(const Json& given, const fs::path& file) {
    const std::string pointer = member("", include_key);
    if (given.is_string()) return add_one(given, pointer, file);
    if (!given.is_array()) {
      faults_.add(place(file, pointer), shown(given), "the name of a file, or a list of names");
      return;
    }
    for (std::size_t n = 0; n < given.size(); ++n) add_one(given[n], member(pointer, n), file);
  }

  void add_one(const Json& name, const std::string& pointer, const fs::path& file) {
    const std::string at = place(file, pointer);
    if (!name.is_string()) {
      faults_.add(at, shown(name), "the name of a file");
      return;
    }
    const fs::path included = (file.parent_path() / name.get<std::string>()).lexically_normal();
    const auto circle = std::find(under_way_.begin(), under_way_.end(), included);
    if (circle != under_way_.end()) {
      std::string way;
      for (auto one = circle; one != under_way_.end(); ++one) way += short_name(*one) + " -> ";
      faults_.add(
          at, shown(name),
          fmt::format("a file that does not include itself ({}{})", way, short_name(included)));
      return;
    }
    if (seen_.contains(included)) return;
    if (seen_.size() == most_files) {
      faults_.add(at, shown(name), fmt::format("at most {} files of a scene", most_files));
      return;
    }
    std::string text;
    try {
      text =
          read_input_file(included, at, "the name of a file, relative to the file that names it");
    } catch (const InputError& error) {
      for (const Fault& fault : error.faults())
        faults_.add(fault.pointer, fault.value, fault.expected);
      return;
    }
    bytes_ += text.size();
    if (bytes_ > most_bytes) {
      faults_.add(at, shown(name),
                  fmt::format("at most {} MB of included files", most_bytes >> 20U));
      return;
    }
    add_file(text, included);
  }

  /// Merges `json`, which stands at `own` of a file, into the document's value at `pointer`.
  void merge(Json& into, Json json, const std::string& pointer, const std::string& own,
             const fs::path& file) {
    if (into.is_object() && json.is_object()) {
      for (auto& [key, value] : json.items()) {
        const std::string at = member(pointer, key), own_at = member(own, key);
        if (into.contains(key))
          merge(into[key], std::move(value), at, own_at, file);
        else
          put(into[key], std::move(value), at, own_at, file);
      }
    } else if (into.is_array() && json.is_array() && is_joined(pointer)) {
      for (std::size_t n = 0; n < json.size(); ++n) {
        add_origin(member(pointer, into.size()), file, member(own, n));
        into.push_back(std::move(json[n]));
      }
    } else {
      put(into, std::move(json), pointer, own, file);
    }
  }

  void put(Json& into, Json json, const std::string& pointer, const std::string& own,
           const fs::path& file) {
    if (pointer.empty() && json.is_object()) {
      into = Json::object();
      return merge(into, std::move(json), pointer, own, file);
    }
    add_origin(pointer, file, own);
    into = std::move(json);
  }

  void add_origin(const std::string& pointer, const fs::path& file, const std::string& own) {
    if (several_) document_.origins.add(pointer, file, own);
  }

  std::string short_name(const fs::path& file) const {
    return file.lexically_relative(root_.parent_path()).string();
  }
  /// Returns the place of a fault before the origins are complete.
  std::string place(const fs::path& file, const std::string& pointer) const {
    if (file == root_ && !several_) return pointer;
    return fmt::format("{}:{}", short_name(file), pointer);
  }

  fs::path root_;
  Faults& faults_;
  Document document_;
  std::size_t bytes_ = 0;  // of included files
  bool several_ = false;   // a file includes others
  std::set<fs::path> seen_;
  std::vector<fs::path> under_way_;
};

}  // namespace

Document read_document(std::string_view text, const fs::path& file, Faults& faults) {
  return DocumentReader(file, faults).read(text);
}

}  // namespace hyperlattice
