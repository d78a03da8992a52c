// The springs from a row of particles to all its forward neighbours in one pass, one vector of
// sites at a time, for a list of neighbours that is known at compile time. Results of springs stay
// in registers until all springs of these sites are summed.
//
// A spring that leans forward (dx = 1) pulls at sites one further than its own. A spring that leans
// backward (dx = -1) is computed from its far end, so that its own sites are one further. Forces on
// sites one further are carried to the next vector, so the pass never goes back.
#pragma once

#include <hyperlattice/kernels/cubic_list.hpp>
#include <hyperlattice/kernels/motion.hpp>
#include <hyperlattice/kernels/response.hpp>

#include <array>
#include <bit>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

/// The pass over one row. `List`: see CubicList.
template <class Law, KernelConfig config, class List>
class Stencil {
  using Real = NumberOf<config.computed>;
  using Pack = PackOf<Real>;
  using Bits = BitsOf<Real>;
  using Kind = SpringKind<Law, Real>;
  static constexpr Membrane membrane = config.membrane;
  static constexpr int components = config.components(), width = lanes_of<Real>;
  static constexpr std::size_t lines = List::lines.size();
  static constexpr bool has_cross = membrane != Membrane::none;

  using Packs = Forces<components, Real>;

 public:
  struct Kinds {
    Kind base, cross;
  };
  /// Places in the arrays of a row and of its neighbours' rows; element t belongs to site begin +
  /// t.
  struct Rows {
    std::ptrdiff_t displacement[lines];  ///< places of the row's sites in each line; the first line
                                         ///< is the row itself
    /// Forces on these sites, x; the next component is `scratch_width` further.
    Real* received[lines];
    const std::uint16_t* alive;
    const std::uint32_t* weight_sets;  ///< null: all weights are 1
    const Kinds* kinds;                ///< kinds of springs of each class
    std::uint32_t neighbours;          ///< bits of the row's neighbours in the list
    int count;                         ///< number of sites, padded to whole vectors
  };

  Stencil(const KernelRequest& request, const Rows& rows)
      : request_(request), rows_(rows), spacing_(List::spacing(request.neighbours)) {}

  /// Adds to the forces that later rows receive, calls take(t, forces) with the total force on each
  /// vector of sites, and clears the forces that these received. Returns the bits of neighbours
  /// with an alarm.
  template <class Take>
  HYPERLATTICE_INLINE std::uint32_t run(const Take& take) {
    Carried carried;
    if ((rows_.alive[0] & List::leaning(-1)) != 0) first(carried);
    for (int t = 0; t < rows_.count; t += width) {
      Packs forces;
      if (all_there(t)) [[likely]] {
        add<true, List::all()>(t, carried, forces);
      } else {
        Carried in_memory = carried;
        some(t, in_memory, forces);
        carried = in_memory;
      }
      take(t, forces);
    }
    last(carried);
    return rung_;
  }

 private:
  static constexpr bool leans_forward(std::size_t line) {
    return line != 0 && (List::in_line(List::lines[line]) & List::leaning(1)) != 0;
  }
  static constexpr std::size_t leaning_before(std::size_t line) {
    std::size_t number = 0;
    for (std::size_t l = 0; l < line; ++l) number += leans_forward(l) ? 1 : 0;
    return number;
  }

  /// Forces on sites one further than a vector's, on the row itself and on the lines that springs
  /// lean to: the last lane belongs to the next vector.
  struct Carried {
    static constexpr std::size_t rows = 1 + leaning_before(lines);
    Packs row[rows];  // the row itself first
    HYPERLATTICE_INLINE Carried() {
      every([&](std::size_t r, std::size_t c) __attribute__((always_inline)) { row[r][c] = 0; });
    }
    HYPERLATTICE_INLINE Carried(const Carried& other) { *this = other; }
    HYPERLATTICE_INLINE Carried& operator=(
        const Carried& other) {  // vector by vector: the compiler's own copy of an array of this
                                 // size is slow to start
      every([&](std::size_t r, std::size_t c)
                __attribute__((always_inline)) { row[r][c] = other.row[r][c]; });
      return *this;
    }
    template <std::size_t line>
    HYPERLATTICE_INLINE Packs& to_line() {
      return row[1 + leaning_before(line)];
    }
    template <std::size_t line>
    HYPERLATTICE_INLINE const Packs& to_line() const {
      return row[1 + leaning_before(line)];
    }

   private:
    template <class Visit>
    HYPERLATTICE_INLINE static void every(const Visit& visit) {
      each<rows>([&]<std::size_t r>() __attribute__((always_inline)) {
        each<components>([&]<std::size_t c>() __attribute__((always_inline)) { visit(r, c); });
      });
    }
  };
  static constexpr auto batches = List::template batches<membrane == Membrane::free>();
  static constexpr std::size_t last_batch(std::size_t line) {
    std::size_t last = 0;
    for (std::size_t b = 0; b < batches.size(); ++b)
      if ((batches[b] & List::in_line(List::lines[line])) != 0) last = b;
    return last;
  }

  const Real* displacement(std::size_t line, std::size_t c) const {
    return static_cast<const Real*>(request_.displacement[c]) + rows_.displacement[line];
  }
  Real* received(std::size_t line, std::size_t c) const {
    return rows_.received[line] + static_cast<std::ptrdiff_t>(c) * request_.scratch_width;
  }

  /// Returns the bits of the existing springs of a vector that begins at t, each in its own lane.
  Bits alive(int t) const {
    Bits there = t < 0 ? Bits{} : load_bits<Real>(rows_.alive + t),
         ahead = load_bits<Real>(rows_.alive + t + 1);
    if (t < 0)
      for (int lane = 0; lane < width - 1; ++lane) ahead[lane] = 0;
    if (t + width >= rows_.count) ahead[width - 1] = 0;
    return of_lanes(there, ahead);
  }
  static Bits of_lanes(Bits there, Bits ahead) {
    constexpr std::uint16_t back = List::leaning(-1), rest = List::all() & ~back;
    return (there & rest) | (ahead & back);
  }
  bool all_there(int t) const {
    return t + width < rows_.count &&
           same(of_lanes(load_bits<Real>(rows_.alive + t), load_bits<Real>(rows_.alive + t + 1)),
                Bits{} + List::all()) &&
           (rows_.weight_sets == nullptr || whole(rows_.weight_sets + t / lanes));
  }
  static bool whole(const std::uint32_t* sets) {  // all weights are 1, the next site included
    std::uint32_t others = 0;
    for (int n = 0; n <= width / lanes; ++n) others |= sets[n] ^ whole_set;
    return others == 0;
  }

  /// Forces on the sites of a vector, and on those one further.
  struct Sums {
    Packs own, own_further, line[lines], line_further[lines];
    HYPERLATTICE_INLINE Sums() {
      each<components>([&]<std::size_t c>() __attribute__((always_inline)) {
        own[c] = own_further[c] = 0;
        each<lines>([&]<std::size_t l>()
                        __attribute__((always_inline)) { line[l][c] = line_further[l][c] = 0; });
      });
    }
  };

  // Not inlined, to keep them out of the loop over whole vectors.
  [[gnu::noinline]] void first(Carried& carried) {
    Packs none;
    add<false, List::leaning(-1)>(-width, carried, none);
  }
  [[gnu::noinline]] void some(int t, Carried& carried, Packs& forces) {
    add<false, List::all()>(t, carried, forces);
  }

  /// Adds the springs of a vector of sites to the neighbours in `only`. AllThere: none is missing
  /// and all count in full.
  template <bool AllThere, std::uint16_t only>
  HYPERLATTICE_INLINE void add(int t, Carried& carried, Packs& forces) {
    const Bits bits = AllThere ? Bits{} : alive(t);
    Packs here, further;
    each<components>([&]<std::size_t c>() __attribute__((always_inline)) {
      here[c] = load(displacement(0, c) + t);
      further[c] = load(displacement(0, c) + t + 1);
    });
    Sums sums;
    each<batches.size()>([&]<std::size_t b>() __attribute__((always_inline)) {
      if constexpr ((batches[b] & only) != 0)
        add_batch<AllThere, batches[b] & only>(t, bits, here, further, sums);
      each<lines>([&]<std::size_t line>() __attribute__((always_inline)) {
        if constexpr (line != 0 && (List::in_line(List::lines[line]) & only) != 0 &&
                      last_batch(line) == b)
          end_line<AllThere, line>(t, sums, carried);
      });
    });
    if constexpr (only == List::all())
      each<components>([&]<std::size_t c>() __attribute__((always_inline)) {
        Real* const so_far = received(0, c) + t;
        forces[c] =
            sums.own[c] + load(so_far) + one_further(carried.row[0][c], sums.own_further[c]);
        store(so_far, Pack(0));
      });
    carried.row[0] = sums.own_further;
  }

  /// Adds the forces of the springs on another row to that row.
  template <bool AllThere, std::size_t line>
  HYPERLATTICE_INLINE void end_line(int t, Sums& sums, Carried& carried) const {
    if (!AllThere && (rows_.neighbours & List::in_line(List::lines[line])) == 0) return;
    each<components>([&]<std::size_t c>() __attribute__((always_inline)) {
      Real* const so_far = received(line, c) + t;
      Pack sum = load(so_far) + sums.line[line][c];
      if constexpr (leans_forward(line))
        sum += one_further(carried.template to_line<line>()[c], sums.line_further[line][c]);
      store(so_far, sum);
    });
    if constexpr (leans_forward(line)) carried.template to_line<line>() = sums.line_further[line];
  }

  /// A vector of springs to one neighbour; r points from there to here.
  struct Alike {
    Pack r[3];                           ///< vector between the ends in space, m
    Pack base_q, cross_q;                ///< growth of the squared lengths, m2
    Pack height_difference, height_sum;  ///< there minus here; there plus here
    LanesOf<Real> alive;
  };

  /// Computes the springs of one batch: geometry, response, forces on both ends.
  template <bool AllThere, std::uint16_t batch>
  HYPERLATTICE_INLINE void add_batch(int t, Bits bits, const Packs& here, const Packs& further,
                                     Sums& sums) {
    constexpr std::size_t number = std::popcount(batch),
                          answers = has_cross ? 2 * number
                                              : number;  // base springs, then their cross springs
    constexpr auto neighbour = List::template indices<number>(batch);
    Alike springs[number];
    const Kind* kinds[answers];
    Pack q[answers], pulls[answers];
    each<number>([&]<std::size_t s>() __attribute__((always_inline)) {
      constexpr Neighbour to = List::neighbours[neighbour[s]];
      springs[s] = between<AllThere, neighbour[s]>(t, bits, to.dx < 0 ? further : here);
      q[s] = springs[s].base_q;
      kinds[s] = &rows_.kinds[to.spring_class].base;
      if constexpr (has_cross) {
        q[number + s] = springs[s].cross_q;
        kinds[number + s] = &rows_.kinds[to.spring_class].cross;
      }
    });
    const std::uint32_t rung = Kind::template pull<answers>(kinds, q, pulls);
    if (rung != 0) [[unlikely]]
      for (std::size_t s = 0; s < number; ++s)
        if ((rung >> s & 1u) != 0) rung_ |= 1u << neighbour[s];
    each<number>([&]<std::size_t s>() __attribute__((always_inline)) {
      push<AllThere, neighbour[s]>(t, springs[s], pulls[s], pulls[answers - number + s], sums);
    });
  }

  template <bool AllThere, std::size_t n>
  HYPERLATTICE_INLINE Alike between(int t, Bits bits, const Packs& here) const {
    constexpr Neighbour to = List::neighbours[n];
    constexpr int offset[3] = {to.dx, to.dy, to.dz};
    const auto there = [&](std::size_t c) {
      return load(displacement(List::line_of(to), c) + t + (to.dx > 0 ? 1 : 0));
    };
    Alike springs;
    Pack growth[3];
    each<3>([&]<std::size_t c>() __attribute__((always_inline)) {  // d (2 rest + d) along each axis
      const Pack d = here[c] - there(c);
      springs.r[c] = offset[c] == 0 ? d : offset[c] > 0 ? d - spacing_ : d + spacing_;
      growth[c] = d * (offset[c] == 0  ? d
                       : offset[c] > 0 ? springs.r[c] - spacing_
                                       : springs.r[c] + spacing_);
    });
    springs.cross_q = springs.base_q = growth[0] + growth[1] + growth[2];
    if constexpr (membrane == Membrane::free) {
      const Pack height = there(3);
      springs.height_difference = height - here[3];
      springs.height_sum = height + here[3];
      springs.base_q += springs.height_difference * springs.height_difference;
      springs.cross_q += springs.height_sum * (2 * request_.membrane_distance + springs.height_sum);
    }
    if constexpr (!AllThere) {
      springs.alive = lanes_with<Real>(bits, 1u << n);
      springs.base_q = where(springs.alive, springs.base_q);
      springs.cross_q = where(springs.alive, springs.cross_q);
    }
    return springs;
  }

  /// `base`, `cross`: force over length of the springs.
  template <bool AllThere, std::size_t n>
  HYPERLATTICE_INLINE void push(int t, const Alike& springs, Pack base, Pack cross,
                                Sums& sums) const {
    constexpr Neighbour to = List::neighbours[n];
    constexpr std::size_t line = List::line_of(to);
    Packs& own = to.dx < 0 ? sums.own_further : sums.own;
    Packs& other = line == 0   ? sums.own_further
                   : to.dx > 0 ? sums.line_further[line]
                               : sums.line[line];
    if constexpr (!AllThere) {
      if (rows_.weight_sets != nullptr) {
        const Pack weight = weights<n>(t);
        base *= weight;
        cross *= weight;
      }
      base = where(springs.alive, base);
      cross = where(springs.alive, cross);
    }
    Pack pull = base;
    if constexpr (has_cross) pull += cross;
    if constexpr (membrane == Membrane::free) {  // the cross spring pushes both heights in the same
                                                 // direction: not action and reaction
      const Pack along = base * springs.height_difference,
                 both = cross * (request_.membrane_distance + springs.height_sum);
      own[3] += along - both;
      other[3] -= along + both;
    }
    each<3>([&]<std::size_t c>() __attribute__((always_inline)) {
      const Pack force = product(pull, springs.r[c]);
      own[c] -= force;
      other[c] += force;
    });
  }

  template <std::size_t n>
  Pack weights(int t) const {
    const auto of = [&](int site) {
      return load_weights<Real>(request_.weights, rows_.weight_sets + site / lanes,
                                lanes * (static_cast<int>(n) + 1));
    };
    if constexpr (List::neighbours[n].dx >= 0) return of(t);
    return one_back(of(t < 0 ? 0 : t), of(t + width < rows_.count ? t + width : t));
  }

  /// Adds the forces of the last sites on sites beyond the row's end.
  void last(const Carried& carried) {
    each<lines>([&]<std::size_t line>() __attribute__((always_inline)) {
      if constexpr (leans_forward(line)) {
        if ((rows_.neighbours & List::in_line(List::lines[line])) == 0) return;
        for (std::size_t c = 0; c < components; ++c) {
          Real* const so_far = received(line, c) + rows_.count;
          store(so_far, load(so_far) + one_further(carried.template to_line<line>()[c], Pack(0)));
        }
      }
    });
  }

  const KernelRequest& request_;
  const Rows& rows_;
  const Pack spacing_;
  std::uint32_t rung_ = 0;
};

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS
