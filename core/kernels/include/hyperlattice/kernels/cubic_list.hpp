// The forward neighbours of the cubic lattice, known at compile time: edges and face diagonals of a
// cube.
#pragma once

#include <hyperlattice/kernel_request.hpp>

#include <array>
#include <cstddef>

namespace hyperlattice {

/// Bit n and index n stand for neighbour n of the list.
struct CubicList {
  static constexpr std::array<Neighbour, 9> neighbours{{{1, 0, 0, 0},
                                                        {-1, 1, 0, 1},
                                                        {0, 1, 0, 0},
                                                        {1, 1, 0, 1},
                                                        {0, -1, 1, 1},
                                                        {-1, 0, 1, 1},
                                                        {0, 0, 1, 0},
                                                        {1, 0, 1, 1},
                                                        {0, 1, 1, 1}}};
  struct Line {
    int dy, dz;
  };
  static constexpr std::array<Line, 5> lines{
      {{0, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};  ///< rows that contain the neighbours

  /// Sets of springs whose instructions are interleaved, so that the processor need not wait for
  /// results.
  template <bool heights>
  static constexpr auto batches() {  // as many springs in a set as the registers can hold
    if constexpr (heights)
      return std::array<std::uint16_t, 5>{0b000010001, 0b000000110, 0b000001000, 0b001100000,
                                          0b110000000};
    else
      return std::array<std::uint16_t, 3>{0b000001110, 0b011100000, 0b100010001};
  }

  // Sets of neighbours.
  static constexpr std::uint16_t all() { return (1u << neighbours.size()) - 1; }
  static constexpr std::uint16_t in_line(Line line) {
    return bits([line](const Neighbour& n) { return n.dy == line.dy && n.dz == line.dz; });
  }
  static constexpr std::uint16_t leaning(int dx) {
    return bits([dx](const Neighbour& n) { return n.dx == dx; });
  }
  template <std::size_t number>
  static constexpr std::array<std::size_t, number> indices(std::uint16_t chosen) {
    std::array<std::size_t, number> found{};
    for (std::size_t n = 0, next = 0; n < neighbours.size(); ++n)
      if ((chosen >> n & 1u) != 0) found[next++] = n;
    return found;
  }

  static constexpr std::size_t line_of(const Neighbour& n) {
    for (std::size_t line = 0; line < lines.size(); ++line)
      if (lines[line].dy == n.dy && lines[line].dz == n.dz) return line;
    return 0;
  }

  static double spacing(std::span<const NeighbourGeometry> list) { return list[0].rest.x; }
  /// Returns whether a lattice's list is this one, at any spacing.
  static bool is(std::span<const NeighbourGeometry> list) {
    if (list.size() != neighbours.size()) return false;
    for (std::size_t n = 0; n < list.size(); ++n) {
      const Neighbour &a = list[n].site, &b = neighbours[n];
      const Vec3 rest = spacing(list) * Vec3{double(b.dx), double(b.dy), double(b.dz)};
      if (a.dx != b.dx || a.dy != b.dy || a.dz != b.dz || a.spring_class != b.spring_class)
        return false;
      if (list[n].rest.x != rest.x || list[n].rest.y != rest.y || list[n].rest.z != rest.z)
        return false;
    }
    return true;
  }

 private:
  template <class Chosen>
  static constexpr std::uint16_t bits(const Chosen& chosen) {
    std::uint16_t found = 0;
    for (std::size_t n = 0; n < neighbours.size(); ++n)
      if (chosen(neighbours[n])) found = static_cast<std::uint16_t>(found | 1u << n);
    return found;
  }
};

}  // namespace hyperlattice
