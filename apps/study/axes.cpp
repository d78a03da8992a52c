#include <scene/expectation.hpp>
#include <study/axes.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <set>

namespace hyperlattice::study {

namespace {

/// The other keys of a row in study.json; an axis of such a name would hide them.
constexpr const char* row_keys[] = {"run",     "status",  "reason", "particles", "steps",
                                    "size",    "error",   "errors", "seconds",   "setup_seconds",
                                    "repeats", "pareto",  "order",  "pairs",     "target_error",
                                    "label",   "identity"};

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

bool good_name(const std::string& name, const std::string& pointer, Faults& faults) {
  if (name.empty() || name.find_first_of(",\n/\"") != std::string::npos) {
    faults.add(pointer, shown(name), "a name of the axis, without comma, slash or quotation mark");
    return false;
  }
  if (std::find(std::begin(row_keys), std::end(row_keys), name) == std::end(row_keys)) return true;
  faults.add(pointer, shown(name),
             fmt::format("another name of the axis; the rows of a study have {}",
                         fmt::join(row_keys, ", ")));
  return false;
}

bool good_list(const Json& list, const std::string& pointer, std::size_t length, Faults& faults) {
  if (!list.is_array() || list.empty() || list.size() > 1000) {
    faults.add(pointer, shown(list), "a list of 1 to 1000 values");
    return false;
  }
  if (length == 0 || list.size() == length) return true;
  faults.add(pointer, fmt::format("{} values", list.size()),
             fmt::format("{}, as many as the first list of this axis", length));
  return false;
}

/// Labels the values by those of the first pointer whose values are texts or numbers and all
/// different. Returns false if there is no such pointer.
bool label_by_value(Axis& axis) {
  for (std::size_t p = 0; p < axis.values.front().size(); ++p) {
    std::vector<std::string> labels;
    std::set<std::string> different;
    bool plain = true;
    for (const auto& value : axis.values) {
      plain = plain && value[p].is_primitive();
      labels.push_back(text_of(value[p]));
      plain = plain && labels.back().find_first_of(",\n") == std::string::npos;
      different.insert(labels.back());
    }
    if (!plain || different.size() != labels.size()) continue;
    axis.labels = labels;
    return true;
  }
  return false;
}

bool read_labels(const Json& labels, const std::string& pointer, Axis& axis, Faults& faults) {
  if (!good_list(labels, pointer, axis.values.size(), faults)) return false;
  std::set<std::string> different;
  for (const Json& label : labels) {
    if (!label.is_string() ||
        label.get_ref<const std::string&>().find_first_of(",\n") != std::string::npos)
      faults.add(pointer, shown(label), "texts without commas");
    else
      different.insert(axis.labels.emplace_back(label.get<std::string>()));
  }
  if (different.size() == axis.values.size()) return true;
  if (axis.labels.size() == axis.values.size())
    faults.add(pointer, shown(labels), "labels that are all different");
  return false;
}

bool read_threads(const Json& list, const std::string& pointer, Axis& axis, Faults& faults) {
  if (!good_list(list, pointer, 0, faults)) return false;
  for (std::size_t n = 0; n < list.size(); ++n) {
    const Json& count = list[n];
    if (!count.is_number_integer() || count.get<double>() < 1 || count.get<double>() > 4096) {
      faults.add(member(pointer, n), shown(count), "a number of threads from 1 to 4096");
      return false;
    }
    axis.values.push_back({count});
  }
  return true;
}

bool read_pointers(const Json& given, const std::string& pointer, Axis& axis, Faults& faults) {
  if (!given.is_object()) {
    faults.add(pointer, shown(given),
               "an object of JSON pointers into the scene, each with a list of values");
    return false;
  }
  const std::size_t before = faults.size();
  for (const auto& item : given.items()) {
    if (item.key() == "labels") continue;
    const std::string place = member(pointer, item.key());
    if (!item.key().starts_with('/'))
      faults.add(place, "",
                 "a JSON pointer into the scene such as /pipeline/0/spacing, or \"labels\"");
    else if (good_list(item.value(), place, axis.values.size(), faults)) {
      axis.values.resize(item.value().size());
      axis.pointers.push_back(item.key());
      for (std::size_t n = 0; n < axis.values.size(); ++n)
        axis.values[n].push_back(item.value()[n]);
    }
  }
  if (faults.size() > before) return false;
  if (!axis.pointers.empty()) return true;
  faults.add(pointer, shown(given),
             "at least one JSON pointer into the scene, such as /pipeline/0/spacing, with a list "
             "of values");
  return false;
}

bool read_axis(const Json& given, const std::string& pointer, Axis& axis, Faults& faults) {
  if (axis.name == "threads" && given.is_array() ? !read_threads(given, pointer, axis, faults)
                                                 : !read_pointers(given, pointer, axis, faults))
    return false;
  if (given.is_object() && given.contains("labels"))
    return read_labels(given["labels"], pointer + "/labels", axis, faults);
  if (label_by_value(axis)) return true;
  faults.add(pointer, "",
             "values that are texts or numbers without commas, each once; or a list \"labels\" "
             "that names them");
  return false;
}

/// Returns the index of a value of an axis, given by its label or as in the list.
std::size_t value_of(const Axis& axis, const Json& wanted, const std::string& pointer,
                     Faults& faults) {
  const auto found = std::find(axis.labels.begin(), axis.labels.end(), text_of(wanted));
  if (found == axis.labels.end())
    faults.add(pointer, shown(wanted),
               fmt::format("a value of \"{}\": {}", axis.name, fmt::join(axis.labels, ", ")) +
                   did_you_mean(text_of(wanted), axis.labels));
  return static_cast<std::size_t>(found - axis.labels.begin());
}

}  // namespace

bool Condition::holds(const Choice& choice) const {
  return std::all_of(required_.begin(), required_.end(), [&](const auto& required) {
    return std::find(required.second.begin(), required.second.end(), choice[required.first]) !=
           required.second.end();
  });
}

std::vector<Axis> read_axes(const Json& vary, Faults& faults) {
  std::vector<Axis> axes;
  axes.reserve(vary.size());
  if (!vary.is_object() || vary.empty()) {
    faults.add(
        "/vary", shown(vary),
        "an object of axes such as {\"spacing\": {\"/pipeline/0/spacing\": [\"4 mm\", \"2 mm\"]}}");
    return axes;
  }
  double points = 1;
  for (const auto& item : vary.items()) {
    const std::string pointer = member("/vary", item.key());
    Axis axis;
    axis.name = item.key();
    const bool named = good_name(axis.name, pointer, faults);
    if (!read_axis(item.value(), pointer, axis, faults) || !named) continue;
    points *= static_cast<double>(axis.values.size());
    axes.push_back(std::move(axis));
  }
  constexpr double most = 10'000;
  if (points > most)
    faults.add("/vary", fmt::format("{:.6g} runs", points), fmt::format("{} at most", most));
  return axes;
}

std::size_t find_axis(const std::string& name, const std::string& pointer,
                      const std::vector<Axis>& axes, Faults& faults) {
  const auto found =
      std::find_if(axes.begin(), axes.end(), [&](const Axis& axis) { return axis.name == name; });
  if (found == axes.end()) {
    std::vector<std::string> names;
    names.reserve(axes.size());
    for (const Axis& axis : axes) names.push_back(axis.name);
    faults.add(
        pointer, shown(name),
        fmt::format("an axis of \"vary\": {}", fmt::join(names, ", ")) + did_you_mean(name, names));
  }
  return static_cast<std::size_t>(found - axes.begin());
}

Condition read_condition(const Json& given, const std::string& pointer,
                         const std::vector<Axis>& axes, Faults& faults) {
  Condition condition;
  if (!given.is_object() || given.empty()) {
    faults.add(pointer, shown(given),
               "an object of axes with values, such as {\"boundary\": \"cells\"}");
    return condition;
  }
  for (const auto& item : given.items()) {
    const std::string place = member(pointer, item.key());
    const std::size_t axis = find_axis(item.key(), place, axes, faults);
    if (axis == axes.size()) continue;
    std::vector<std::size_t> values;
    if (item.value().is_array())
      for (std::size_t n = 0; n < item.value().size(); ++n)
        values.push_back(value_of(axes[axis], item.value()[n], member(place, n), faults));
    else
      values.push_back(value_of(axes[axis], item.value(), place, faults));
    condition.require(axis, values);
  }
  return condition;
}

std::string choice_text(const std::vector<Axis>& axes, const Choice& choice,
                        const std::vector<std::size_t>& except) {
  std::string text;
  for (std::size_t a = 0; a < axes.size(); ++a)
    if (std::find(except.begin(), except.end(), a) == except.end())
      text +=
          fmt::format("{}{} {}", text.empty() ? "" : ", ", axes[a].name, axes[a].labels[choice[a]]);
  return text;
}

}  // namespace hyperlattice::study
