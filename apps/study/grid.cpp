#include <scene/settings.hpp>
#include <study/grid.hpp>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

namespace hyperlattice::study {

namespace {

bool next(Choice& choice, const std::vector<Axis>& axes) {
  for (std::size_t a = axes.size(); a-- > 0;) {
    if (++choice[a] < axes[a].values.size()) return true;
    choice[a] = 0;
  }
  return false;
}

std::string folder_text(const std::string& text) {
  std::string plain;
  for (const char c : text)
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '-' || c == '+')
      plain += c;
  return plain;
}

/// Returns a folder name of letters, digits and ". - + _"; a number at its end makes it unique if
/// needed.
std::string name_of(const std::vector<Axis>& axes, const Choice& choice,
                    std::map<std::string, int>& taken) {
  constexpr std::size_t longest = 150;
  std::string name;
  for (std::size_t a = 0; a < axes.size(); ++a)
    name += fmt::format("{}{}-{}", name.empty() ? "" : "_", folder_text(axes[a].name),
                        folder_text(axes[a].labels[choice[a]]));
  name.resize(std::min(name.size(), longest));
  const int count = ++taken[name];
  return count == 1 ? name : fmt::format("{}_{}", name, count);
}

class Setter {
 public:
  explicit Setter(Faults& faults) : faults_(faults) {}

  void set(Point& point, const Axis& axis, std::size_t value) {
    if (axis.is_threads()) {
      point.threads = axis.values[value].front().get<int>();
      return;
    }
    for (std::size_t p = 0; p < axis.pointers.size(); ++p) {
      const std::string expected = set_value(point.scene, axis.pointers[p], axis.values[value][p]);
      if (!expected.empty() && told_.insert(axis.name + axis.pointers[p]).second)
        faults_.add(member(member("/vary", axis.name), axis.pointers[p]), "", expected);
    }
  }

 private:
  Faults& faults_;
  std::set<std::string> told_;  // reports each fault once
};

}  // namespace

std::vector<Point> grid(const Study& study) {
  Faults faults;
  Setter setter(faults);
  std::vector<Point> points;
  std::map<std::string, int> taken;
  Choice choice(study.axes.size(), 0);
  do {
    if (std::any_of(study.excluded.begin(), study.excluded.end(),
                    [&](const Condition& condition) { return condition.holds(choice); }))
      continue;
    Point& point = points.emplace_back(
        Point{choice, name_of(study.axes, choice, taken), study.scene.json, std::nullopt});
    for (std::size_t a = 0; a < study.axes.size(); ++a) setter.set(point, study.axes[a], choice[a]);
    if (!study.is_sweep() &&
        std::none_of(study.truths.begin(), study.truths.end(),
                     [&](const Truth& truth) { return truth.when.holds(choice); }))
      faults.add("/truth", choice_text(study.axes, choice),
                 "a truth for every run; none of them has a \"when\" that holds for this one");
  } while (next(choice, study.axes));
  if (points.empty()) faults.add("/exclude", "", "at least one run that is not excluded");
  faults.throw_if_any();
  return points;
}

}  // namespace hyperlattice::study
