#include "failure.hpp"
#include <equilibrium/words.hpp>

namespace hyperlattice::equilibrium {

namespace {

/// Describes a motion: its largest displacement, place and direction, and how many particles move.
class MotionText {
 public:
  MotionText(const StaticProblem& problem, const Field& motion)
      : problem_(problem), motion_(motion) {
    const StaticGrid& grid = problem.grid;
    for (std::int64_t p = 0; p < grid.places; ++p) {
      take_larger(space_, norm(in_space(p)), p);
      if (grid.components == 4) take_larger(height_, height(p), p);
    }
  }
  bool is_nothing() const { return space_.size == 0 && height_.size == 0; }
  bool wrinkles() const { return space_.size <= height_.size; }
  std::string text() const {
    if (wrinkles())
      return "that motion is one of the fourth dimension, of the membrane, largest at " +
             place_text(height_) + ", and " +
             part_text([&](std::int64_t p) { return height(p) >= 0.5 * height_.size; });
    return "that motion is largest at " + place_text(space_) + ", along " +
           direction_text(in_space(space_.place)) + ", and " +
           part_text([&](std::int64_t p) { return norm(in_space(p)) >= 0.5 * space_.size; });
  }

 private:
  struct Largest {
    double size = 0;
    std::int64_t place = 0;
  };
  static void take_larger(Largest& largest, double size, std::int64_t place) {
    if (size > largest.size) largest = {size, place};
  }
  double component(std::int64_t c, std::int64_t p) const {
    return motion_[static_cast<std::size_t>(c * problem_.grid.places + p)];
  }
  Vec3 in_space(std::int64_t p) const {
    return {component(0, p), component(1, p), component(2, p)};
  }
  double height(std::int64_t p) const { return std::abs(component(3, p)); }
  std::string place_text(const Largest& largest) const {
    return short_vector(problem_.position(largest.place), 6) + " m";
  }
  template <class TakesPart>
  std::string part_text(const TakesPart& takes_part) const {
    std::uint64_t all = 0, many = 0;
    for (std::int64_t p = 0; p < problem_.grid.places; ++p) {
      if (problem_.grid.free[p] != 0) ++all;
      if (takes_part(p)) ++many;
    }
    return short_number(std::round(100 * static_cast<double>(many) / static_cast<double>(all))) +
           "% of the particles that are free move at least half as far";
  }

  const StaticProblem& problem_;
  const Field& motion_;
  Largest space_, height_;
};

}  // namespace

std::string failure_text(const StaticProblem& problem, const LastRest& last, const Outcome& found) {
  const double share = last.share;
  std::string text = "the body finds no state of rest ";
  const std::string where =
      short_number(100 * share) + "% of the load, at " + short_number(last.time) + " s";
  if (last.broke > 0)
    text += "at " + where + ", where " + short_number(static_cast<double>(last.broke)) +
            (last.broke == 1 ? " spring" : " springs") + " broke: " + found.why;
  else
    text += (share == 0 ? "under its loads" : "beyond " + where) + ": " + found.why;
  if (found.direction.empty() || found.rigid) return text;
  const MotionText motion(problem, found.direction);
  if (motion.is_nothing()) return text;
  return text + "; " + motion.text() +
         (motion.wrinkles() ? ". There the body wrinkles in the fourth dimension: a membrane this "
                              "soft holds its heights no longer under such a "
                              "compression (docs/theory/mirror.md)."
          : found.buckles   ? ". There the body buckles."
          : last.broke > 0  ? ". The body tears there."
          : share == 0 ? ". Supports may be missing, parts not joined, or loads far beyond what "
                         "the body can resist."
                       : ". The body may buckle there.");
}

}  // namespace hyperlattice::equilibrium
