#include <base/visible.hpp>
#include <scene/json.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

namespace hyperlattice {

namespace {

constexpr std::size_t largest = 64;  // size of a document, MB
// levels of nesting; far more than a scene needs, far less than the stack allows
constexpr std::size_t deepest = 64;
constexpr std::size_t longest = 100;    // bytes of a value in a message
constexpr std::size_t widest = 10'000;  // keys of an object, whose search is linear

/// Returns the place of the byte at `offset`: "line 3, column 7". Columns count characters, not
/// bytes.
std::string place(std::string_view text, std::size_t offset) {
  std::size_t line = 1, column = 1;
  for (std::size_t n = 0; n < std::min(offset, text.size()); ++n) {
    if (text[n] == '\n') {
      ++line;
      column = 1;
    } else if ((static_cast<unsigned char>(text[n]) & 0xC0) != 0x80) {
      ++column;
    }
  }
  return fmt::format("line {}, column {}", line, column);
}

/// Returns the offset at which the token with the last byte `last` begins: the opening quote of a
/// text, otherwise `last`.
std::size_t token_start(std::string_view text, std::size_t last) {
  if (last >= text.size() || text[last] != '"') return last;
  for (std::size_t n = last; n-- > 0 && text[n] != '\n';)
    if (text[n] == '"' && (n == 0 || text[n - 1] != '\\')) return n;
  return last;
}

/// Builds the document and collects faults; has the interface of nlohmann's SAX parser.
class Builder {
 public:
  Builder(std::string_view text, Json& root, Faults& faults)
      : text_(text), root_(root), faults_(faults) {}

  bool null() { return put(nullptr); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(std::int64_t value) { return put(value); }
  bool number_unsigned(std::uint64_t value) { return put(value); }
  bool number_float(double value, const std::string&) { return put(value); }
  bool string(std::string& value) { return put(std::move(value)); }
  bool binary(Json::binary_t&) { return false; }
  bool start_object(std::size_t) { return open(Json::object()); }
  bool start_array(std::size_t) { return open(Json::array()); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }

  bool key(std::string& name) {
    const Level& top = levels_.back();
    if (top.container->size() == widest) {
      faults_.add(top.pointer, "", fmt::format("at most {} keys in an object", widest));
      return false;
    }
    if (top.container->contains(name))
      faults_.add(member(top.pointer, name), "", fmt::format("the key \"{}\" only once", name));
    key_ = std::move(name);
    return true;
  }

  bool parse_error(std::size_t read, const std::string&, const nlohmann::detail::exception& error) {
    std::string reason = error.what();  // "[...] parse error at line 1, column 2: syntax error
                                        // while ...", or "[...] number overflow ..."
    if (const auto column = reason.find(", column "); column != std::string::npos)
      reason.erase(0, reason.find(": ", column) + 2);
    else if (const auto bracket = reason.find("] "); bracket != std::string::npos)
      reason.erase(0, bracket + 2);
    const std::size_t last = read == 0 ? 0 : read - 1;
    faults_.add(place(text_, token_start(text_, last)), "", "valid JSON (" + reason + ")");
    return false;
  }

 private:
  struct Level {
    Json* container;
    std::string pointer;
  };

  /// Returns the place for the next value.
  Json& slot() {
    if (levels_.empty()) return root_;
    Json& top = *levels_.back().container;
    return top.is_array() ? top.emplace_back() : top[key_];
  }
  std::string slot_pointer() const {
    if (levels_.empty()) return "";
    const Level& top = levels_.back();
    return top.container->is_array() ? member(top.pointer, top.container->size())
                                     : member(top.pointer, key_);
  }

  bool put(Json value) {
    slot() = std::move(value);
    return true;
  }
  bool open(Json container) {
    std::string pointer = slot_pointer();
    if (levels_.size() == deepest) {
      faults_.add(pointer, "", fmt::format("at most {} levels of nesting", deepest));
      return false;
    }
    Json& place = slot();
    place = std::move(container);
    levels_.push_back({&place, std::move(pointer)});
    return true;
  }
  bool close() {
    levels_.pop_back();
    return true;
  }

  std::string_view text_;
  Json& root_;
  Faults& faults_;
  std::vector<Level> levels_;
  std::string key_;
};

}  // namespace

bool parse_json(std::string_view text, Json& json, Faults& faults) {
  if (text.size() > largest << 20) {
    faults.add("", "", fmt::format("JSON of at most {} MB", largest));
    return false;
  }
  Builder builder(text, json, faults);
  return Json::sax_parse(text.begin(), text.end(), &builder, nlohmann::detail::input_format_t::json,
                         true, true);
}

std::string member(const std::string& pointer, std::string_view key) {
  std::string text = pointer + '/';
  for (const char c : key) {
    if (c == '~')
      text += "~0";
    else if (c == '/')
      text += "~1";
    else
      text += c;
  }
  return text;
}

std::string member(const std::string& pointer, std::size_t index) {
  return fmt::format("{}/{}", pointer, index);
}

std::string word_in(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

std::string json_text(const Json& document) {
  return document.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}
std::string json_text(const nlohmann::json& document) {
  return document.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

bool is_utf8(const std::string& text) {
  const Json value = text;
  return Json::parse(value.dump(-1, ' ', false, Json::error_handler_t::replace)) == value;
}

std::string shown(const Json& value) {
  return visible(value.dump(-1, ' ', false, Json::error_handler_t::replace), longest);
}

}  // namespace hyperlattice
