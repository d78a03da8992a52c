#include <equilibrium/signatures.hpp>

namespace hyperlattice::equilibrium {

// The axes follow each other: a signature becomes the hash of all signatures in its window.
Signatures coarse_signatures(Signatures sites, const TrilinearTransfer& transfer, int reach) {
  std::array<std::int64_t, 3> box = transfer.fine_sites();
  for (int axis = 0; axis < 3; ++axis) {
    const auto along = static_cast<std::size_t>(axis);
    const std::int64_t fine = box[along], coarse = transfer.coarse_sites()[along];
    const std::int64_t step = axis == 0   ? 1
                              : axis == 1 ? box[0]
                                          : box[0] * box[1],
                       blocks = box[0] * box[1] * box[2] / (step * fine);
    Signatures next(static_cast<std::size_t>(blocks * coarse * step), 0);
    for (std::int64_t n = 0; n < blocks; ++n)
      for (std::int64_t C = 0; C < coarse; ++C) {
        const Window window = transfer.window(axis, C, reach);
        std::uint64_t* to = next.data() + (n * coarse + C) * step;
        for (std::int64_t i = window.first; i <= window.last; ++i) {
          const std::uint64_t* from =
              i < 0 || i >= fine ? nullptr : sites.data() + (n * fine + i) * step;
          for (std::int64_t m = 0; m < step; ++m)
            to[m] = signed_by(to[m], from == nullptr ? 0 : from[m]);
        }
      }
    sites = std::move(next);
    box[along] = coarse;
  }
  return sites;
}

}  // namespace hyperlattice::equilibrium
