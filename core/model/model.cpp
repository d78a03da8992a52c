#include <model/build.hpp>
#include <model/critical_step.hpp>
#include <model/cut_springs.hpp>

namespace hyperlattice {

namespace {

Body make_body(const Scene& scene) {
  Faults faults;
  const std::vector<const Stage*> lattices = scene.of(Family::lattices);
  if (lattices.empty()) faults.add("/pipeline", "", "a stage that is a lattice");
  for (std::size_t n = 1; n < lattices.size(); ++n)
    faults.add(lattices[n]->pointer, lattices[n]->component->type(), "one lattice only");
  faults.throw_if_any();
  const ComponentPointer lattice = make_component(*lattices[0]);
  try {
    return build_body(lattices[0]->functions<LatticeFunctions>(), lattice.get(), false,
                      lattices[0]->component);
  } catch (const std::invalid_argument& refused) {
    throw objection(scene, *lattices[0], refused.what());
  }
}

}  // namespace

std::unique_ptr<Model> build_model(const Scene& scene) {
  auto model = std::make_unique<Model>();
  model->scene = &scene;
  model->body = make_body(scene);
  RegionIndex regions(model->body, scene.regions);
  Faults faults;
  add_materials(*model, regions, faults);
  if (faults.empty()) set_springs(*model, faults);
  if (faults.empty()) cut_springs(*model, regions, faults);
  if (faults.empty()) set_volumetric(*model, regions, faults);
  if (faults.empty()) find_critical_step(*model, faults);
  add_loads(*model, regions, faults);
  faults.throw_if_any();
  set_intact(*model);
  limit_step_by_loads(*model);
  return model;
}

}  // namespace hyperlattice
