#include <contract/lone_spring.hpp>
#include <contract/scenes.hpp>
#include <model/law.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace hyperlattice::contract {

LoneSpring::LoneSpring(const Model& model)
    : model_(&model), memory_(model.springs.kernels().memory, 0.0) {
  const NeighbourGeometry& neighbour = model.springs.neighbours.front();
  const SpringConstants& constants = model.springs.spring(0, 0, neighbour.site.spring_class);
  spring_.stiffness = constants.stiffness;
  spring_.rest_length = neighbour.rest_length;
  spring_.law = constants.law[0];
  start_spring(model.springs.laws.front(), spring_.law, {0, 1}, memory_.data());
  period_ = std::sqrt(model.materials.front().mass / constants.stiffness);
}

SpringAnswer LoneSpring::move(double elongation, double time_step) {
  OneSpring spring = spring_;
  spring.elongation = elongation;
  return take_spring(model_->springs.laws.front(), spring, time_step, memory_.data());
}

double LoneSpring::energy(double elongation) const {
  OneSpring spring = spring_;
  spring.elongation = elongation;
  spring.memory = memory_.data();
  return ask_spring(model_->springs.laws.front(), spring).energy;
}

double LoneSpring::reach() const {
  const double slowly = 1e3 * period_;
  const auto secant = [&](double elongation) {
    return LoneSpring(*this).move(elongation, slowly).force / elongation;
  };
  const double first = 1e-7 * rest_length(), stiffness = secant(first);
  for (double elongation = first; elongation < rest_length() / 50; elongation *= 1.02) {
    const double now = secant(elongation) / stiffness;
    if (!(now > 0.5 && now < 2)) return elongation;
  }
  return 1e-3 * rest_length();
}

std::vector<double> path_through(const std::vector<double>& turns, double step) {
  std::vector<double> path{0};
  for (const double turn : turns) {
    const double from = path.back();
    const int pieces = std::max(1, static_cast<int>(std::lround(std::abs(turn - from) / step)));
    for (int n = 1; n <= pieces; ++n) path.push_back(from + (turn - from) * n / pieces);
  }
  return path;
}

std::vector<PathPoint> follow(LoneSpring spring, const std::vector<double>& elongations,
                              double time_step) {
  std::vector<PathPoint> points;
  for (const double elongation : elongations) {
    const SpringAnswer answer = spring.move(elongation, points.empty() ? 0 : time_step);
    PathPoint point{elongation, answer.force, answer.energy, 0};
    if (!points.empty())
      point.work =
          0.5 * (points.back().force + point.force) * (elongation - points.back().elongation);
    points.push_back(point);
  }
  return points;
}

std::vector<double> usual_turns(double reach) {
  return {reach, 0.2 * reach, 2.5 * reach, -0.5 * reach, 0};
}

std::vector<PathPoint> usual_path(const LoneSpring& spring) {
  const double reach = spring.reach();
  return follow(spring, path_through(usual_turns(reach), reach / 100), spring.period() / 10);
}

std::vector<PathPoint> random_path(const LoneSpring& spring, std::uint64_t seed) {
  const double reach = spring.reach();
  return follow(spring, path_through(noise(40, 2.5 * reach, seed), reach / 100),
                spring.period() / 10);
}

}  // namespace hyperlattice::contract
