// The axes of a study: what is varied, which of it is the refinement, and conditions on what was
// chosen.
#pragma once

#include <scene/json.hpp>

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace hyperlattice::study {

/// One thing that is varied. A value may set several places of the scene together.
struct Axis {
  std::string name;
  std::vector<std::string> pointers;  ///< into the scene; none for the axis "threads"
  std::vector<std::vector<Json>>
      values;  ///< of each value, what is set at each of the pointers; for "threads" the one number
  std::vector<std::string> labels;  ///< of each value, distinct

  bool is_threads() const { return pointers.empty(); }
};

/// For each axis, which of its values.
using Choice = std::vector<std::size_t>;

/// Values of some axes.
class Condition {
 public:
  void require(std::size_t axis, std::vector<std::size_t> values) {
    required_.emplace_back(axis, std::move(values));
  }
  bool holds(const Choice& choice) const;  ///< always, if nothing is required

 private:
  std::vector<std::pair<std::size_t, std::vector<std::size_t>>> required_;
};

/// Reads the study's "vary". Axes with faults are left out.
std::vector<Axis> read_axes(const Json& vary, Faults& faults);

/// Reads { "<axis>": a label or value, or a list of them, ... }.
Condition read_condition(const Json& given, const std::string& pointer,
                         const std::vector<Axis>& axes, Faults& faults);

/// The axis of that name; if there is none, a fault at `pointer`, and the number of axes.
std::size_t find_axis(const std::string& name, const std::string& pointer,
                      const std::vector<Axis>& axes, Faults& faults);

/// "spacing 4 mm, boundary cells", without some axes.
std::string choice_text(const std::vector<Axis>& axes, const Choice& choice,
                        const std::vector<std::size_t>& except = {});

}  // namespace hyperlattice::study
