// The module hyperlattice._core: the runtime for the Python package.
#include "bindings.hpp"
#include "errors.hpp"
#include "function_set.hpp"
#include "log_queue.hpp"

#include <run/interrupt.hpp>
#include <run/run.hpp>

#include <hyperlattice/field_table.hpp>

#include <lz4.h>
#include <pybind11/stl/filesystem.h>

namespace py = pybind11;
using namespace hyperlattice;

namespace {

/// Returns `size` unpacked bytes of a block that LZ4 packed. Throws std::invalid_argument if the
/// block does not hold them.
py::bytes lz4_block(const py::bytes& packed, int size) {
  const std::string_view bytes = packed;
  std::string out(static_cast<std::size_t>(size), '\0');
  if (LZ4_decompress_safe(bytes.data(), out.data(), static_cast<int>(bytes.size()), size) != size)
    throw std::invalid_argument("a block of the file is damaged");
  return py::bytes(out);
}

/// Returns the fields that runs may have: name, unit, names of the components, help.
py::list field_list() {
  py::list fields;
  for (const FieldInfo& field : field_table) {
    py::list parts;
    for (const std::string_view part : parts_of(field.kind)) parts.append(py::str(part));
    fields.append(
        py::make_tuple(py::str(field.name), py::str(field.unit), parts, py::str(field.help)));
  }
  return fields;
}

}  // namespace

PYBIND11_MODULE(_core, core) {
  core.doc() = "The runtime of Hyperlattice, for the package hyperlattice.";
  core.attr("version") = HYPERLATTICE_VERSION;
  python::catch_log();
  python::translate_errors();
  python::bind_job(core);
  python::bind_tools(core);
  core.def("connect_functions", python::connect_functions, py::arg("library"));
  core.def("lz4_block", lz4_block, py::arg("packed"), py::arg("size"));
  core.def("field_table", field_list);
  core.def("request_stop", request_stop);
  core.def("forget_stop", forget_stop);
}
