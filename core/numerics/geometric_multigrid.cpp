#include <numerics/chebyshev_iteration.hpp>
#include <numerics/geometric_multigrid.hpp>

namespace hyperlattice::numerics {

GeometricMultigrid::GeometricMultigrid(std::vector<const GridLevel*> levels,
                                       std::vector<TrilinearTransfer> transfers, Solve coarsest)
    : levels_(std::move(levels)), transfers_(std::move(transfers)), coarsest_(std::move(coarsest)) {
  for (const GridLevel* level : levels_) work_.emplace_back(level->layout().numbers());
}

void GeometricMultigrid::apply(const Field& r, Field& z) {
  work_.front().b = r;
  cycle(0);
  z = work_.front().x;
}

/// Solves K x = b of a level approximately.
void GeometricMultigrid::cycle(std::size_t level) {
  Work& work = work_[level];
  if (level + 1 == levels_.size()) return coarsest_(work.b.data(), work.x.data());
  const GridLevel &here = *levels_[level], &next = *levels_[level + 1];
  Work& below = work_[level + 1];
  smooth(here, work, true);
  here.multiply(work.d.data(),
                work.t.data());  // the smoother's residual lacks its last step
  in_pieces(work.r.size(), here.threads(), [&](std::size_t first, std::size_t last) {
    for (std::size_t n = first; n < last; ++n) work.r[n] -= work.t[n];
  });
  transfers_[level].restrict_to(next, below.b.data(), here, work.r.data());
  cycle(level + 1);
  transfers_[level].prolong_from(next, below.x.data(), here, work.x.data());
  smooth(here, work, false);
}

/// Chebyshev iteration on D^-1 K x = D^-1 b; leaves in r the residual before the last step d.
void GeometricMultigrid::smooth(const GridLevel& level, Work& w, bool from_zero) {
  ChebyshevIteration chebyshev(level.largest_eigenvalue());
  constexpr std::size_t piece =
      512;  // places; their numbers stay in the processor's caches between the loops
  for (int step = 0; step < chebyshev.degree(); ++step) {
    const ChebyshevIteration::Step weights = step == 0 ? chebyshev.first() : chebyshev.next();
    const bool from_nothing = from_zero && step == 0;
    if (!from_nothing) level.multiply(step == 0 ? w.x.data() : w.d.data(), w.t.data());
    const Field& left = step == 0 ? w.b : w.r;
    in_pieces<piece>(
        static_cast<std::size_t>(level.layout().places), level.threads(),
        [&](std::size_t first, std::size_t last) {
          level.layout().for_numbers(first, last, [&](std::size_t begin, std::size_t end) {
            for (std::size_t n = begin; n < end; ++n)
              w.r[n] = from_nothing ? left[n] : left[n] - w.t[n];
          });
          level.divide(first, last, w.r.data(), w.t.data());
          level.layout().for_numbers(first, last, [&](std::size_t begin, std::size_t end) {
            for (std::size_t n = begin; n < end; ++n) {
              w.d[n] = (step > 0 ? weights.keep * w.d[n] : 0.0) + weights.take * w.t[n];
              w.x[n] = from_nothing ? w.d[n] : w.x[n] + w.d[n];
            }
          });
        });
  }
}

}  // namespace hyperlattice::numerics
