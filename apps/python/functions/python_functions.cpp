// The components that call Python functions: a plugin that the package names in scenes with
// functions. The program can load it too, and then says why it cannot run such a scene.
#include "failure.hpp"
#include "load.hpp"
#include "writer.hpp"

hyperlattice::python::FindFunction hyperlattice_find_function = nullptr;

HYPERLATTICE_PLUGIN("1.0") {
  plugin.add<hyperlattice::python::Load>();
  plugin.add<hyperlattice::python::Failure>();
  plugin.add<hyperlattice::python::Writer>();
}
