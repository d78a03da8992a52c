#include <base/visible.hpp>
#include <host/plugin_call.hpp>
#include <scene/expectation.hpp>
#include <scene/option_reader.hpp>
#include <scene/value_reader.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace hyperlattice {
namespace {

constexpr std::size_t most_shown = 4096;  // bytes of a plugin's text

/// Calls a function of the set. Throws OutsideError if the function fails.
template <class Code>
void call(const OptionSet& set, const char* function, Code&& code) {
  PluginCall call(set.name, set.library, function);
  if (const std::string* sentence = call.failure(code(call.why())))
    throw plugin_failure(set.name, "", set.library, function, *sentence);
}

/// Moves the files named at or below one JSON pointer to another.
void move_files(std::map<std::string, std::filesystem::path>& files, const std::string& from,
                const std::string& to) {
  for (auto at = files.lower_bound(from); at != files.end() && at->first.starts_with(from);) {
    const auto moved = at++;
    if (moved->first.size() > from.size() && moved->first[from.size()] != '/') continue;
    auto node = files.extract(moved);
    node.key().replace(0, from.size(), to);
    files.insert(std::move(node));
  }
}

/// Returns the former value that the scene gives; null if there is none like it.
const OldValue* former_value(const OldName& old, const Json& given) {
  const auto found = std::find_if(old.values.begin(), old.values.end(), [&](const OldValue& value) {
    return Json::parse(value.before) == given;
  });
  return found == old.values.end() ? nullptr : &*found;
}

/// Returns the former values in words: "true or false".
std::string former_values(const OldName& old) {
  std::vector<std::string_view> values;
  values.reserve(old.values.size());
  for (const OldValue& value : old.values) values.push_back(value.before);
  return fmt::format("{}", fmt::join(values, " or "));
}

}  // namespace

OptionReader::OptionReader(const Json& object, std::string pointer, Reading reading,
                           std::vector<std::string> keys)
    : object_(object), pointer_(std::move(pointer)), reading_(reading), known_(std::move(keys)) {}

OptionsPointer OptionReader::fill(const OptionSet& set, Json& resolved) {
  OptionsPointer options(nullptr, set.destroy);
  call(set, "Options", [&](const Complaint& why) {
    options.reset(set.create(why));
    return options != nullptr;
  });
  bool good = true;
  old_names_.insert(old_names_.end(), set.old_names.begin(), set.old_names.end());
  for (const Option& option : set.options) {
    known_.emplace_back(option.name);
    good = fill_one(set, option, options.get(), resolved) && good;
  }
  if (!good || !check(set, options.get())) options.reset();
  return options;
}

bool OptionReader::fill_one(const OptionSet& set, const Option& option, void* options,
                            Json& resolved) {
  const std::string name(option.name), key = key_of(option.name);
  const std::string pointer = member(pointer_, name);
  ReadValue value;
  Json si;
  if (object_.contains(key)) {
    if (!read_given(option, key, value, si)) return false;
    resolved[name] = std::move(si);
  } else if (!option.fallback.empty()) {
    if (!read_value(option, Json::parse(option.fallback), pointer, reading_, value, si))
      return false;
    resolved[name] = std::move(si);
  } else if (option.optional) {
    value.plain.absent = true;
  } else {
    reading_.faults.add(pointer, "", expectation(option) + " (it is required, but missing)");
    return false;
  }
  call(set, "Options", [&](const Complaint& why) { return option.set(options, value.plain, why); });
  return true;
}

/// Reads the value that the object gives under `key`, a present or former name of the option.
bool OptionReader::read_given(const Option& option, const std::string& key, ReadValue& value,
                              Json& resolved) {
  const std::string pointer = member(pointer_, key);
  Json now;  // the present value, if the former name has values of its own
  bool good = true;
  for (const OldName& old : old_names_) {
    if (old.option != option.name || !object_.contains(std::string(old.name))) continue;
    const std::string name(old.name), at = member(pointer_, name);
    if (key != name) {
      reading_.faults.add(
          at, shown(object_[name]),
          fmt::format("\"{}\" alone; \"{}\" is its name before version {}", key, name, old.since));
      good = false;
    } else if (old.values.empty()) {
      reading_.faults.warn(
          at, fmt::format("\"{}\" is named \"{}\" since version {}; the old name will go", name,
                          option.name, old.since));
    } else if (const OldValue* former = former_value(old, object_[name])) {
      now = Json::parse(former->now);
      reading_.faults.warn(at,
                           fmt::format("\"{}\": {} is \"{}\": {} since version {}; the old name "
                                       "will go",
                                       name, former->before, option.name, former->now, old.since));
    } else {
      reading_.faults.add(at, shown(object_[name]),
                          fmt::format("{}; since version {} use \"{}\"", former_values(old),
                                      old.since, option.name));
      return false;
    }
  }
  good =
      read_value(option, now.is_null() ? object_[key] : now, pointer, reading_, value, resolved) &&
      good;
  // in the resolved scene, where files are looked up, the option has its present name
  if (key != option.name)
    move_files(reading_.regions.files(), pointer, member(pointer_, option.name));
  return good;
}

/// Returns the key under which the object gives the option: its name, or else a former one.
std::string OptionReader::key_of(std::string_view option) const {
  std::string name(option);
  if (object_.contains(name)) return name;
  for (const OldName& old : old_names_)
    if (old.option == option && object_.contains(std::string(old.name)))
      return std::string(old.name);
  return name;
}

bool OptionReader::check(const OptionSet& set, const void* options) {
  if (set.check == nullptr) return true;
  const std::size_t before = reading_.faults.size();
  const FaultSink sink{
      this, [](void* self, std::string_view option, std::string_view expected) noexcept {
        PluginCall::answer([&] {
          const OptionReader& reader = *static_cast<OptionReader*>(self);
          const std::string key = reader.key_of(option);
          const auto given = key.empty() ? reader.object_.end() : reader.object_.find(key);
          reader.reading_.faults.add(key.empty()
                                         ? reader.pointer_
                                         : member(reader.pointer_, visible_line(key, most_shown)),
                                     given == reader.object_.end() ? "" : shown(*given),
                                     visible_line(expected, most_shown));
        });
      }};
  call(set, "check", [&](const Complaint& why) { return set.check(options, sink, why); });
  return reading_.faults.size() == before;
}

bool OptionReader::is_known(const std::string& key) const {
  return std::find(known_.begin(), known_.end(), key) != known_.end() ||
         std::any_of(old_names_.begin(), old_names_.end(),
                     [&](const OldName& old) { return old.name == key; });
}

/// Returns the key of which the present name or a former one is nearest in spelling; empty if none
/// is near.
std::string OptionReader::nearest_option(const std::string& key) const {
  std::vector<std::string> names = known_;
  for (const OldName& old : old_names_) names.emplace_back(old.name);
  std::string near = nearest(key, names);
  for (const OldName& old : old_names_)
    if (old.name == near) return std::string(old.option);
  return near;
}

void OptionReader::reject_unknown() {
  for (const auto& item : object_.items()) {
    if (is_known(item.key())) continue;
    const std::string near = nearest_option(item.key());
    reading_.faults.add(member(pointer_, item.key()), shown(item.value()),
                        near.empty() ? fmt::format("no key but {}", fmt::join(known_, ", "))
                                     : fmt::format("a known key; did you mean \"{}\"?", near));
  }
}

}  // namespace hyperlattice
