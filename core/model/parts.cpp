// The number of connected parts of a body. Most bodies are long rows that springs
// along x connect; each such row is one entry, so that a body of many millions of particles is
// counted by rows.
#include <model/body_figures.hpp>
#include <numerics/disjoint_sets.hpp>

#include <algorithm>

namespace hyperlattice {

namespace {

/// Sets of pieces that springs join, with their number.
class Sets {
 public:
  explicit Sets(std::size_t count)
      : sets_(static_cast<std::int64_t>(count)), is_joined_(count, false), count_(count) {}

  void join(std::size_t a, std::size_t b) {
    is_joined_[a] = is_joined_[b] = true;
    const auto first = static_cast<std::int64_t>(a), second = static_cast<std::int64_t>(b);
    if (sets_.root(first) == sets_.root(second)) return;
    sets_.join(first, second);
    --count_;
  }
  std::size_t count() const { return count_; }
  bool is_joined(std::size_t n) const { return is_joined_[n]; }  ///< to any other

 private:
  numerics::DisjointSets sets_;
  std::vector<bool> is_joined_;
  std::size_t count_;
};

/// The sites begin <= i < end of a row, connected by springs along x, or a single site.
struct Piece {
  std::int32_t begin = 0, end = 0;
};

/// The pieces of all rows, in the order z, y, x.
struct Pieces {
  std::vector<Piece> all;
  std::vector<std::size_t> rows;  ///< [k * ny + j]: first piece of a row; one more entry at the end

  explicit Pieces(const Body& body) {
    const auto along_x =
        std::find_if(body.neighbours.begin(), body.neighbours.end(),
                     [](const Neighbour& n) { return n.dx == 1 && n.dy == 0 && n.dz == 0; });
    for (std::int32_t k = 0; k < body.grid.sites[2]; ++k)
      for (std::int32_t j = 0; j < body.grid.sites[1]; ++j) {
        rows.push_back(all.size());
        const std::vector<Range> springs = along_x == body.neighbours.end()
                                               ? std::vector<Range>{}
                                               : body.springs_of(j, k, *along_x);
        auto spring = springs.begin();
        for (const Run& run : body.row(j, k))
          for (std::int32_t i = run.begin; i < run.end;) {
            while (spring != springs.end() && spring->end <= i) ++spring;
            const std::int32_t end =
                spring != springs.end() && spring->begin <= i ? spring->end + 1 : i + 1;
            all.push_back({i, end});
            i = end;
          }
      }
    rows.push_back(all.size());
  }

  /// Returns the index of the first piece of a row that ends after the site.
  std::size_t from(std::size_t row, std::int32_t site) const {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(rows[row]),
               last = all.begin() + static_cast<std::ptrdiff_t>(rows[row + 1]);
    return static_cast<std::size_t>(
        std::upper_bound(first, last, site,
                         [](std::int32_t i, const Piece& piece) { return i < piece.end; }) -
        all.begin());
  }
};

}  // namespace

Parts parts_of(const Body& body) {
  Parts parts;
  const auto add_loose = [&parts](Particle particle) {
    if (parts.loose++ == 0) parts.first_loose = particle;
  };
  if (body.is_listed()) {
    Sets sets(body.particles);
    for (const ListedSpring& spring : body.listed.springs) sets.join(spring.a, spring.b);
    for (Particle particle = 0; particle < body.particles; ++particle)
      if (!sets.is_joined(particle)) add_loose(particle);
    parts.count = sets.count();
    return parts;
  }
  const Pieces pieces(body);
  const auto row_of = [&](std::int32_t j, std::int32_t k) {
    return static_cast<std::size_t>(k) * static_cast<std::size_t>(body.grid.sites[1]) +
           static_cast<std::size_t>(j);
  };
  Sets sets(pieces.all.size());
  for (std::int32_t k = 0; k < body.grid.sites[2]; ++k)
    for (std::int32_t j = 0; j < body.grid.sites[1]; ++j)
      for (const Neighbour& to : body.neighbours)
        for (const Range& range : body.springs_of(j, k, to)) {
          std::size_t here = pieces.from(row_of(j, k), range.begin),
                      there = pieces.from(row_of(j + to.dy, k + to.dz), range.begin + to.dx);
          for (std::int32_t i = range.begin; i < range.end;) {
            sets.join(here, there);
            const std::int32_t here_ends = pieces.all[here].end,
                               there_ends = pieces.all[there].end - to.dx;
            i = std::min(here_ends, there_ends);
            if (here_ends <= i) ++here;
            if (there_ends <= i) ++there;
          }
        }
  for (std::int32_t k = 0; k < body.grid.sites[2]; ++k)
    for (std::int32_t j = 0; j < body.grid.sites[1]; ++j)
      for (std::size_t n = pieces.rows[row_of(j, k)]; n < pieces.rows[row_of(j, k) + 1]; ++n)
        if (const Piece& piece = pieces.all[n]; piece.end == piece.begin + 1 && !sets.is_joined(n))
          add_loose(body.at({piece.begin, j, k}));
  parts.count = sets.count();
  return parts;
}

}  // namespace hyperlattice
