#include <analyze/virtual_test.hpp>
#include <engine/stage_calls.hpp>
#include <scene/json.hpp>

#include <nlohmann/json.hpp>

#include <chrono>

namespace hyperlattice {

namespace {

/// The rest positions of a cube's particles, for its start displacements and its growth along an
/// axis.
class TestCube {
 public:
  explicit TestCube(const Body& body) : places_(body.particles) {
    for (Particle p = 0; p < body.particles; ++p) places_[p] = body.position(p);
  }

  /// Returns displacements, x y z each, of a uniform shortening along z towards the middle.
  std::vector<double> shortened(double strain) const {
    const auto [low, high] = ends(2);
    std::vector<double> xyz(3 * places_.size(), 0.0);
    for (std::size_t p = 0; p < places_.size(); ++p)
      xyz[3 * p + 2] = -strain * (places_[p].z - (low + high) / 2);
    return xyz;
  }

  /// Returns the mean displacement of the upper face less that of the lower face, m. A face is one
  /// layer of a structured lattice, and of a list the particles near the outermost one.
  double growth(int axis, const std::vector<double>& xyz) const {
    constexpr double nearby = 0.4;  // spacings; layers are half a spacing apart at least
    const auto [low, high] = ends(axis);
    double sum_low = 0, sum_high = 0, count_low = 0, count_high = 0;
    for (std::size_t p = 0; p < places_.size(); ++p) {
      const double place = places_[p][axis], moved = xyz[3 * p + static_cast<std::size_t>(axis)];
      if (place < low + nearby) {
        sum_low += moved;
        ++count_low;
      } else if (place > high - nearby) {
        sum_high += moved;
        ++count_high;
      }
    }
    return sum_high / count_high - sum_low / count_low;
  }

 private:
  std::pair<double, double> ends(int axis) const {
    double low = infinity, high = -infinity;
    for (const Vec3& place : places_) {
      low = std::min(low, place[axis]);
      high = std::max(high, place[axis]);
    }
    return {low, high};
  }

  std::vector<Vec3> places_;
};

}  // namespace

VirtualTest::VirtualTest(Host& host, Components components, Options options)
    : host_(host),
      components_(std::move(components)),
      options_(std::move(options)),
      length_(length_at_rest()),
      base_young_(compress({}, {}).young) {}

/// Returns the scene of the cube, in units with spacing 1 m and E = 1 Pa.
std::string VirtualTest::scene(const calibration::Ratios& ratios, std::optional<double> poisson,
                               double shortening) const {
  const int n = options_.particles;
  Json material = {
      {"type", components_.material}, {"young", 1}, {"density", 1}, {"membrane", "free"}};
  material["k_alpha"] = ratios.clamped ? Json("infinite") : Json(ratios.alpha);
  material["k_beta"] = ratios.beta;
  material["k_gamma"] = ratios.gamma;
  if (poisson)
    material = {{"type", components_.material},
                {"young", 1},
                {"density", 1},
                {"poisson", *poisson},
                {"volumetric", true}};
  const auto platen = [&](const char* on, double displacement) {
    const double at_once = 1e-9;  // a rise shorter than any time step
    return Json{{"type", components_.displacement},
                {"on", on},
                {"value", {0, 0, displacement}},
                {"axes", "z"},
                {"rise", at_once}};
  };
  Json scene;
  scene["format"] = "hyperlattice/1";
  // no check of stability: the test measures the linear response, also of lattices that are so soft
  // in shear that any pressure makes them buckle
  scene["pipeline"] = {{{"type", options_.lattice},
                        {"spacing", 1},
                        {"shape", {{"box", {{"low", {0, 0, 0}}, {"high", {n, n, n}}}}}}},
                       material,
                       platen("z_min", shortening / 2),
                       platen("z_max", -shortening / 2),
                       {{"type", components_.solver},
                        {"tolerance", options_.residual},
                        {"most_cutbacks", 0},
                        {"stability", false}}};
  return scene.dump();
}

double VirtualTest::length_at_rest() const {
  const auto read = read_scene_text(scene({}, {}, 0), host_);
  const auto model = build_model(*read);
  return model->body.highest.z - model->body.lowest.z;
}

VirtualTestResult VirtualTest::measure(const calibration::Ratios& ratios,
                                       std::optional<double> poisson) {
  VirtualTestResult measured = compress(ratios, poisson);
  measured.modulus_ratio = measured.young / base_young_;
  return measured;
}

VirtualTestResult VirtualTest::compress(const calibration::Ratios& ratios,
                                        std::optional<double> poisson) {
  const auto start = std::chrono::steady_clock::now();
  const auto plan = make_plan(
      read_scene_text(scene(ratios, poisson, options_.strain * length_), host_), options_.threads);
  const Model& model = *plan->model;
  Simulation simulation(model, plan->threads);
  const TestCube cube(model.body);
  simulation.set_displacements(cube.shortened(options_.strain), {});
  const RestReport rest = bring_to_rest(*plan, simulation);

  std::vector<double> moved;
  simulation.displacements(moved);
  const std::vector<Vec3> pushed = simulation.force_on_load();
  const double area = options_.particles * options_.particles,
               force = (pushed.at(1).z - pushed.at(0).z) / 2;
  VirtualTestResult measured;
  measured.poisson = -(cube.growth(0, moved) + cube.growth(1, moved)) / 2 / cube.growth(2, moved);
  measured.young =
      force / area / options_.strain / model.materials.front().constants.base_stiffness;
  measured.particles = model.body.particles;
  measured.residual = rest.residual;
  measured.iterations = rest.iterations;
  measured.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return measured;
}

}  // namespace hyperlattice
