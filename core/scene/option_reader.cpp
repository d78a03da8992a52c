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
  for (const Option& option : set.options) {
    known_.emplace_back(option.name);
    good = fill_one(set, option, options.get(), resolved) && good;
  }
  if (!good || !check(set, options.get())) options.reset();
  return options;
}

bool OptionReader::fill_one(const OptionSet& set, const Option& option, void* options,
                            Json& resolved) {
  const std::string name(option.name), pointer = member(pointer_, option.name);
  ReadValue value;
  const auto given = object_.find(name);
  if (given == object_.end() && option.fallback.empty()) {
    if (!option.optional) {
      reading_.faults.add(pointer, "", expectation(option) + " (it is required, but missing)");
      return false;
    }
    value.plain.absent = true;
  } else {
    Json si;
    if (!read_value(option, given != object_.end() ? *given : Json::parse(option.fallback), pointer,
                    reading_, value, si))
      return false;
    resolved[name] = std::move(si);
  }
  call(set, "Options", [&](const Complaint& why) { return option.set(options, value.plain, why); });
  return true;
}

bool OptionReader::check(const OptionSet& set, const void* options) {
  if (set.check == nullptr) return true;
  const std::size_t before = reading_.faults.size();
  const FaultSink sink{
      this, [](void* self, std::string_view option, std::string_view expected) noexcept {
        PluginCall::answer([&] {
          const OptionReader& reader = *static_cast<OptionReader*>(self);
          const auto given =
              option.empty() ? reader.object_.end() : reader.object_.find(std::string(option));
          reader.reading_.faults.add(
              option.empty() ? reader.pointer_
                             : member(reader.pointer_, visible_line(option, most_shown)),
              given == reader.object_.end() ? "" : shown(*given),
              visible_line(expected, most_shown));
        });
      }};
  call(set, "check", [&](const Complaint& why) { return set.check(options, sink, why); });
  return reading_.faults.size() == before;
}

void OptionReader::reject_unknown() {
  for (const auto& item : object_.items()) {
    if (std::find(known_.begin(), known_.end(), item.key()) != known_.end()) continue;
    const std::string near = did_you_mean(item.key(), known_);
    reading_.faults.add(member(pointer_, item.key()), shown(item.value()),
                        near.empty() ? fmt::format("no key but {}", fmt::join(known_, ", "))
                                     : "a known key" + near);
  }
}

}  // namespace hyperlattice
