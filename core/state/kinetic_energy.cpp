#include <state/kinetic_energy.hpp>

#include <algorithm>

namespace hyperlattice {

double KineticEnergy::now() {
  const Model& model = blocks_.model();
  if (masses_.empty())
    for (Particle particle = 0; particle < model.body.particles; ++particle)
      masses_.push_back(model.mass(particle));
  struct Piece {
    const Block* block;
    std::uint64_t place, count;
    Particle first;
    double twice;
  };
  // The same pieces for any number of blocks, because blocks are cut between rows.
  std::vector<Piece> pieces;
  blocks_.for_runs(
      [&](const Block& block, std::uint64_t place, Particle first, std::uint64_t count) {
        for (std::uint64_t n = 0; n < count; n += Listed::stretch)
          pieces.push_back({&block, place + n, std::min<std::uint64_t>(Listed::stretch, count - n),
                            first + n, 0});
      });
  blocks_.team().for_each(pieces.size(), [&](std::size_t number) {
    Piece& piece = pieces[number];
    for (std::uint64_t n = 0; n < piece.count; ++n) {
      double square = 0;
      for (int c = 0; c < model.degrees_of_freedom; ++c) {
        const double velocity = piece.block->velocity[c][piece.place + n];
        square += velocity * velocity;
      }
      piece.twice += masses_[piece.first + n] * square;
    }
  });
  double twice = 0;
  for (const Piece& piece : pieces) twice += piece.twice;
  return twice / 2;
}

}  // namespace hyperlattice
