#include <numerics/block_inverse.hpp>
#include <numerics/block_jacobi.hpp>

namespace hyperlattice::numerics {

BlockJacobi::BlockJacobi(std::size_t nodes, std::size_t components, int threads,
                         const BlockOf& block_of)
    : nodes_(nodes),
      components_(components),
      threads_(threads),
      inverse_(nodes * components * components, 0),
      added_(inverse_) {
  in_pieces(nodes_, threads_, [&](std::size_t first, std::size_t last) {
    for (std::size_t p = first; p < last; ++p) {
      const Block block = block_of(p);
      const BlockInverse own(block.matrix);
      for (std::size_t a = 0; a < components_; ++a)
        for (std::size_t b = 0; b < components_; ++b)
          if (block.unknown[a] && block.unknown[b]) {
            const auto row = static_cast<Eigen::Index>(a), column = static_cast<Eigen::Index>(b);
            inverse_[(p * components_ + a) * components_ + b] = own.inverse(row, column);
            added_[(p * components_ + a) * components_ + b] = own.added(row, column);
          }
    }
  });
}

}  // namespace hyperlattice::numerics
