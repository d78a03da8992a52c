// The axes of a study (the options that it varies), and conditions on the chosen values.
#pragma once

#include <scene/json.hpp>

#include <nlohmann/json.hpp>

#include <string>
#include <utility>
#include <vector>

namespace hyperlattice::study {

/// One axis of the grid of runs. A value may set several places of the scene together.
struct Axis {
  std::string name;
  std::vector<std::string> pointers;  ///< JSON pointers into the scene; none for the axis "threads"
  /// For each value, the settings for all pointers; for "threads", the one number.
  std::vector<std::vector<Json>> values;
  std::vector<std::string> labels;  ///< one for each value, all different

  bool is_threads() const { return pointers.empty(); }
};

/// The index of the chosen value for each axis.
using Choice = std::vector<std::size_t>;

/// A condition on a choice: some axes must have one of their listed values.
class Condition {
 public:
  void require(std::size_t axis, std::vector<std::size_t> values) {
    required_.emplace_back(axis, std::move(values));
  }
  bool holds(const Choice& choice) const;  ///< true if nothing is required

 private:
  std::vector<std::pair<std::size_t, std::vector<std::size_t>>> required_;
};

/// Reads the study's "vary". Leaves out axes with faults.
std::vector<Axis> read_axes(const Json& vary, Faults& faults);

/// Reads { "<axis>": a label or value, or a list of them, ... }.
Condition read_condition(const Json& given, const std::string& pointer,
                         const std::vector<Axis>& axes, Faults& faults);

/// Returns the index of the axis with this name; if there is none, adds a fault at `pointer` and
/// returns the number of axes.
std::size_t find_axis(const std::string& name, const std::string& pointer,
                      const std::vector<Axis>& axes, Faults& faults);

/// Returns "spacing 4 mm, boundary cells", without the axes in `except`.
std::string choice_text(const std::vector<Axis>& axes, const Choice& choice,
                        const std::vector<std::size_t>& except = {});

}  // namespace hyperlattice::study
