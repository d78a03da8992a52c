"""Hyperlattice for Spack. In the folder of the project:

spack repo add .ci/recipes/spack
spack dev-build hyperlattice@0.1.0
"""
from spack.package import *


class Hyperlattice(CMakePackage):
    """The four-dimensional lattice spring model of solids."""

    has_code = True
    license("MIT")

    version("0.1.0")

    variant("mpi", default=True, description="Several processes for one run")
    variant("python", default=True, description="The Python package")
    variant("render", default=False, description="Pictures for papers, writers.render")

    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("boost@1.74:")
    depends_on("nlohmann-json@3.11:")
    depends_on("spdlog")
    depends_on("eigen@3.4:")
    depends_on("cli11")
    depends_on("udunits")
    depends_on("zlib-api")
    depends_on("lz4")
    depends_on("xxhash")
    depends_on("libpng")
    depends_on("muparser")
    depends_on("mpi", when="+mpi")
    depends_on("embree@3", when="+render")
    depends_on("cairo+pdf+png", when="+render")
    depends_on("pkgconfig", when="+render", type="build")
    depends_on("python@3.9:", when="+python", type=("build", "link", "run"))
    depends_on("py-pybind11", when="+python", type="build")
    depends_on("py-numpy", when="+python", type=("build", "run"))

    generator("ninja")

    def cmake_args(self):
        return [
            self.define("HYPERLATTICE_TESTS", False),
            self.define("CMAKE_UNITY_BUILD", True),
            self.define("CMAKE_DISABLE_FIND_PACKAGE_MPI", self.spec.satisfies("~mpi")),
            self.define("CMAKE_DISABLE_FIND_PACKAGE_pybind11", self.spec.satisfies("~python")),
            self.define("CMAKE_DISABLE_FIND_PACKAGE_embree", self.spec.satisfies("~render")),
        ]
