// Stiff particles take several steps within one step of the others, so that they do not dictate the
// step of all (docs/theory/local_steps.md):
//
//   From the state at the start of a step H, at rest, the stiff particles make p moves under the
//   springs that they touch and under their loads; the ends of these springs at other particles are
//   held. The springs act in the whole step by a weighted mean of their forces over the moves.
//
// For linear springs this is the scheme of Diaz and Grote, SIAM J. Sci. Comput. 31 (2009)
// 1985-2014, of second order, which conserves an energy, with the weights of Grote, Michel and
// Sauter, Math. Comp. 90 (2021) 2603-2643, which keep it stable. The forces on both ends of a
// spring are opposite, so that momentum stays.
#pragma once

#include <state/acting_loads.hpp>
#include <state/block_set.hpp>
#include <state/spring_review.hpp>

#include <array>
#include <utility>
#include <vector>

namespace hyperlattice {

/// One of the moves within a step H. The change of place since the last move is
///   s := keeps s + H^2 kick F / m.
struct LocalMove {
  double keeps = 0, kick = 0;
  double weight = 0;  ///< of the forces at its start in the mean
};
/// Returns the moves of a division into `parts`: with Chebyshev's polynomials T, x = 1 + nu / p^2
/// and c = 2 T_p'(x) / T_p(x),
///   keeps(m) = T_(m-1)(x) / T_(m+1)(x),   kick(m) = 2 T_m(x) / (c T_(m+1)(x)),
/// and half that kick in the first move. With nu = 0 they are p equal steps of leapfrog; nu = 0.01
/// keeps all motions of stiff particles away from resonance with the step.
std::vector<LocalMove> local_moves(std::int64_t parts);

class LocalForces {
 public:
  LocalForces(BlockSet& blocks, const ActingLoads& loads, const SpringReview& review)
      : blocks_(blocks), model_(blocks.model()), loads_(loads), review_(review) {}

  /// A particle at an end of a spring that touches a stiff particle.
  struct End {
    std::uint32_t block = 0, row = 0;
    std::int32_t site = 0;
    std::uint64_t index = 0;  ///< in the block's arrays
    double mass = 0;          ///< kg
    bool stiff = false;
    std::uint32_t support = no_support;  ///< number among the block's boundary particles
    std::array<double, 3> force{};       ///< mean over the step, N
    double stored = 0;                   ///< energy of some of the springs, J
  };

  /// Lets the particles whose own step is shorter than `time_step`, s, take `parts` steps within
  /// each step; `parts` 1: none.
  void start(double time_step, std::int64_t parts);
  bool empty() const { return springs_.empty(); }

  /// While it lives, kernels do not see the springs. Those that did not break return at its end.
  class Taken {
   public:
    explicit Taken(LocalForces* from) : from_(from) {}
    Taken(Taken&& other) noexcept : from_(std::exchange(other.from_, nullptr)) {}
    Taken& operator=(Taken&&) = delete;
    ~Taken() {
      if (from_ != nullptr) from_->give_back();
    }

   private:
    LocalForces* from_;
  };
  /// Computes the mean forces of a step of the length `step`, s, from the present state. The
  /// external forces of the blocks must be set. `breaks`: whether failure criteria are asked.
  [[nodiscard]] Taken compute(double step, bool breaks);
  /// Visits the ends in a row.
  template <class Visit>
  void for_row(const Block& block, std::uint32_t row, const Visit& visit) const {
    const auto [begin, end] = rows_[block.number][row];
    for (std::uint32_t n = begin; n < end; ++n) visit(ends_[n]);
  }

 private:
  static constexpr std::uint32_t no_support = ~std::uint32_t{0};
  struct Spring {
    std::uint32_t a = 0, b = 0;  ///< numbers of its ends
    std::uint32_t neighbour = 0;
    const SpringConstants* constants = nullptr;
    double share = 1;  ///< fraction of a whole spring
    std::uint32_t block = 0, row = 0;
    std::int32_t site = 0;
    bool broken = false;  ///< in this step
  };
  /// The bit of a spring in the arrays of a block, its own or a copy's.
  struct Bit {
    std::uint64_t index = 0;
    std::uint16_t bit = 0;
    std::uint32_t spring = 0;
  };
  /// Consecutive springs of one neighbour and one set of constants. The arrays have a number for
  /// each spring, padded to whole vectors by springs of weight 0.
  struct Piece {
    std::uint32_t begin = 0, end = 0;
    std::vector<std::uint32_t> a, b;  ///< numbers of the ends
    std::vector<double> weight, stiffness, cross_stiffness;
    double stored = 0;  ///< J
  };
  /// Sum over a spring's force: +1 at its first end.
  struct Pull {
    std::uint32_t spring = 0;
    double sign = 1;
  };

  void arrange();
  void find_ends();
  void add_springs();
  void find_pieces();
  template <class Visit>
  void for_bits(const Visit& visit);
  static void clear(Block& block, const Bit& bit);
  void review();
  void find_forces(Piece& piece, bool keeps_energy);
  void give_back();
  void read_motion();
  void move(std::uint32_t first, std::uint32_t last, const LocalMove& move, double step);

  BlockSet& blocks_;
  const Model& model_;
  const ActingLoads& loads_;
  const SpringReview& review_;
  std::vector<LocalMove> moves_;
  std::vector<std::uint8_t> stiff_;     // of each particle; empty: there are no local steps
  std::vector<End> ends_;               // in the order of their particles
  std::vector<Particle> particles_;     // of the ends
  std::vector<Spring> springs_;         // by neighbour, constants and first end
  std::vector<std::vector<Bit>> bits_;  // of each block
  std::vector<Piece> pieces_;
  std::vector<std::uint32_t> first_pull_;  // of each end, in pulls_
  std::vector<Pull> pulls_;
  /// [block][row]: its range in ends_.
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> rows_;
  std::array<std::vector<double>, 3> moved_, change_, outer_;  // of each end: m, m, N
  std::array<std::vector<double>, 3> force_;                   // of each spring on its first end, N
};

}  // namespace hyperlattice
