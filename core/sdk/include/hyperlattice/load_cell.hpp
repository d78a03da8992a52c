// Common parts of probes that record forces: six columns, and a stress over an area.
#pragma once

#include <hyperlattice/output.hpp>

#include <optional>

namespace hyperlattice {

/// A force that a probe follows, with its moment about a point, and the mean stress
///   force . normal / area
/// if the area, m2, is known. It is the engineering stress: the area is that at rest.
class LoadCell {
 public:
  LoadCell() = default;
  LoadCell(ForcesId forces, Vec3 about) : forces_(forces), about_(about) {}
  /// Adds a stress. `normal` has any length; the stress is positive in its direction.
  void set_area(Vec3 normal, double area) {
    normal_ = direction_of(normal);
    area_ = area;
  }

  void name_columns(const ColumnSink& columns) const {
    for (const char* name : {"force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z"})
      columns.column(name);
    if (area_) columns.column("stress");
  }
  void sample(const Snapshot& snapshot, double* row) const {
    const auto [force, moment] = snapshot.resultant(forces_, about_);
    for (const Vec3 v : {force, moment})
      for (int axis = 0; axis < 3; ++axis) *row++ = v[axis];
    if (area_) *row = dot(force, normal_) / *area_;
  }

 private:
  ForcesId forces_;
  Vec3 about_, normal_;
  std::optional<double> area_;
};

}  // namespace hyperlattice
