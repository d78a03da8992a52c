#include <plan/precision.hpp>

#include <spdlog/fmt/fmt.h>

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>

namespace hyperlattice {
namespace {

/// Returns the largest distance, m, that start velocities can move a particle until `end`. A
/// particle of a rotating body moves by no more than the diameter of its circle.
double started(const Model& model, double end) {
  const auto vector = [](Vec3 v) { return Eigen::Vector3d(v.x, v.y, v.z); };
  const auto for_each = [&](const auto& visit) {
    for (const StartVelocity& one : model.loads.start_velocities)
      for (Particle particle = one.first; particle < one.first + one.count; ++particle)
        visit(particle, one.velocity);
  };
  double count = 0;
  for (const StartVelocity& one : model.loads.start_velocities)
    count += static_cast<double>(one.count);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), drift = centre, momentum = centre;
  for_each([&](Particle particle, Vec3 velocity) {
    centre += vector(model.body.position(particle)) / count;
    drift += vector(velocity) / count;
  });
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  double radius = 0;
  for_each([&](Particle particle, Vec3 velocity) {
    const Eigen::Vector3d arm = vector(model.body.position(particle)) - centre;
    momentum += arm.cross(vector(velocity));
    inertia += arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose();
    radius = std::max(radius, arm.norm());
  });
  const Eigen::Vector3d spin = inertia.completeOrthogonalDecomposition().solve(momentum);
  double travel = 0;
  for_each([&](Particle particle, Vec3 velocity) {
    const Eigen::Vector3d turning = spin.cross(vector(model.body.position(particle)) - centre);
    const double other = (vector(velocity) - drift - turning).norm() + drift.norm();
    travel = std::max(travel, other * end + std::min(turning.norm() * end, 2 * radius));
  });
  return travel;
}

/// Returns the largest distance, m, that loads with prescribed motion or start velocities move a
/// particle. Forces are not considered.
double farthest(const Plan& plan) {
  const Model& model = *plan.model;
  const double end = plan.end_time();
  double travel = 0;
  for (const Load& load : model.loads) {
    double factor = std::max(std::abs(load.factor(0)), std::abs(load.factor(end)));
    for (const double corner : model.loads.corners)
      factor = std::max(factor, std::abs(load.factor(corner)));
    for (const LoadedParticle& loaded : load.particles)
      travel = std::max(travel,
                        factor * std::max(norm(loaded.displacement), norm(loaded.velocity) * end));
  }
  return std::max(travel, started(model, end));
}

double least_breaking_strain(const Model& model) {
  double strain = infinity;
  for (const NeighbourGeometry& to : model.springs.neighbours)
    for (std::size_t n = 0; n < model.materials.size(); ++n) {
      const auto material = static_cast<std::uint8_t>(n);
      strain =
          std::min(strain, model.springs.spring(material, material, to.site.spring_class).alarm /
                               to.rest_length);
    }
  return strain;
}

double most_rounding(const Model& model) {
  return std::min(1e-6, std::max(least_breaking_strain(model), 0.0) / 100);
}

double rounding_strain(const Model& model, double travel) {
  return std::ldexp(travel, -24) / model.body.grid.spacing;
}

}  // namespace

std::string precision_warning(const Model& model, double travel) {
  const double lost = rounding_strain(model, travel);
  if (!(lost > most_rounding(model))) return "";
  return fmt::format(
      "floats are coarse here: a particle moved by {:.3g} m, {:.3g} spacings, where they know "
      "strains to {:.2g}; compare with precision double",
      travel, travel / model.body.grid.spacing, lost);
}

void check_precision(const Plan& plan, Faults& faults) {
  if (plan.model->springs.choice.precision != Precision::floats) return;
  const double travel = farthest(plan), lost = rounding_strain(*plan.model, travel),
               breaking = least_breaking_strain(*plan.model);
  if (lost <= most_rounding(*plan.model)) return;
  faults.add("/precision", "float",
             fmt::format("double: the loads move particles by up to {:.3g} m, {:.3g} spacings, "
                         "where floats know strains to {:.2g} only{}",
                         travel, travel / plan.model->body.grid.spacing, lost,
                         breaking < 1e-4 ? fmt::format(", and springs break at {:.2g}", breaking)
                                         : std::string()));
}

}  // namespace hyperlattice
