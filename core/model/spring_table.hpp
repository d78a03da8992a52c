// The springs of a body by the kinds of their ends, and the laws and kernels that move them.
#pragma once

#include <model/composite_spring.hpp>
#include <model/law.hpp>

#include <hyperlattice/kernel_request.hpp>
#include <hyperlattice/lattice.hpp>
#include <hyperlattice/material.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hyperlattice {

/// All springs of the body that differ, each once for its class and the kinds of its ends.
struct SpringTable {
  std::size_t materials = 0;         ///< number of materials of the body
  std::uint32_t spring_classes = 0;  ///< number of spring classes of the lattice
  std::vector<NeighbourGeometry> neighbours;
  /// [(a * materials + b) * spring_classes + class], then the springs of mixtures
  std::vector<SpringConstants> constants;
  /// [mixture * neighbours + n]: index in `constants`; empty in a body without mixtures
  std::vector<std::uint32_t> mixture_springs;
  /// The parts of each spring in `constants` by their index in `composites`; -1, or beyond the end:
  /// a spring of one law.
  std::vector<std::int32_t> composite_of;
  std::vector<CompositeSpring> composites;
  double crossings = 0;  ///< base springs through a unit of area, 1/m2, see SpringFacts
  KernelChoice choice;
  std::vector<Law> laws;     ///< each once; the first one's kernels move the particles
  std::uint32_t memory = 0;  ///< numbers that each base or cross spring keeps
  bool criteria = false;     ///< whether a material has a failure criterion of springs
  bool breakable = false;  ///< whether kernels watch for alarms: of criteria or cohesive materials
  bool softens = false;    ///< whether a law softens
  bool asks_rate = false;  ///< whether a failure criterion needs the rate of elongation

  /// Returns the index in `constants` of the springs of a class between two materials.
  std::size_t spring_index(std::uint8_t a, std::uint8_t b, std::uint32_t spring_class) const {
    return (a * materials + b) * spring_classes + spring_class;
  }
  /// Returns the constants of the springs of a class between two materials.
  const SpringConstants& spring(std::uint8_t a, std::uint8_t b, std::uint32_t spring_class) const {
    return constants[spring_index(a, b, spring_class)];
  }
  /// Returns the constants of the spring to a neighbour from a particle of kind `here` to one of
  /// kind `there`.
  const SpringConstants& spring_to(std::uint32_t neighbour, std::uint32_t here,
                                   std::uint32_t there) const {
    if (!mixture_springs.empty())
      return constants[mixture_springs[here * neighbours.size() + neighbour]];
    return spring(static_cast<std::uint8_t>(here), static_cast<std::uint8_t>(there),
                  neighbours[neighbour].site.spring_class);
  }
  /// Makes the spring with this index in `constants` a composite one.
  void add_composite(std::size_t spring, CompositeSpring composite);
  /// Returns the parts of a spring in `constants`; null if it has one law.
  const CompositeSpring* composite(const SpringConstants& of) const {
    const auto index = static_cast<std::size_t>(&of - constants.data());
    if (index >= composite_of.size() || composite_of[index] < 0) return nullptr;
    return &composites[static_cast<std::size_t>(composite_of[index])];
  }
  const KernelSet& kernels() const { return laws.front().kernels; }
};

/// Returns the rest vectors and lengths of a lattice's forward neighbours.
std::vector<NeighbourGeometry> geometry_of(const Grid& grid);

}  // namespace hyperlattice
