// The connected pieces of the body, over time: their number, mass, energy and sizes, and the motion
// of the heaviest ones.
#include "piece.hpp"

#include <hyperlattice/fields.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hyperlattice {
namespace {

class FragmentsProbe {
 public:
  struct Options {
    double least_mass = 0, damage = 1;
    std::int64_t largest = 0, bins = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>("probes.fragments",
                           "Number, mass, size, motion and energy of the connected pieces of the "
                           "body, over time")
        .add<&Options::least_mass>("least_mass", "kg",
                                   "least mass of a fragment; lighter pieces are dust")
        .at_least(0)
        .fallback("0")
        .add<&Options::damage>("damage", "",
                               "damage, 1 - integrity, from which on a spring does not join its "
                               "ends; 1: it carries no tension any more")
        .above(0)
        .at_most(1)
        .fallback("1")
        .add<&Options::largest>("largest", "", "how many of the heaviest fragments have columns")
        .at_least(0)
        .at_most(1000)
        .fallback("3")
        .add<&Options::bins>("bins", "", "columns of the histogram of masses")
        .at_least(0)
        .at_most(60)
        .fallback("10")
        .equation(
            "Base springs that exist, with a damage below the bound, join particles into pieces. "
            "mass = sum m; size = (6 V / pi)^(1/3), V the undeformed volume; x = sum m (X + u) / "
            "mass; velocity = sum m v / mass; spin w: J w = sum m r x (v - velocity), J the "
            "inertia "
            "about x; kinetic = sum m v^2 / 2, with the motion of the membrane")
        .restrictions(
            "fragments, mass, kinetic: of all fragments; dust, dust_mass, dust_kinetic: of the "
            "lighter pieces. size_20, size_50, size_80: the fragments up to this size hold 20, 50, "
            "80 % of the fragments' mass. Columns that end in _0, _1, ...: of the heaviest "
            "fragments, numbered as by the field `fragment`: 0 is the heaviest, and of equal "
            "masses the one with the first particle; all 0: there is no such fragment. spin is 0 "
            "if "
            "the particles lie on a line. bin_n: number of fragments with a mass above 2^-n and at "
            "most "
            "2^(1-n) of the body's; the last one also has all that are lighter. Velocities are "
            "half "
            "a step before the time. Volumetric energies, contacts and loads join nothing. With "
            "failures.cohesive each particle with d = 1 is a piece: let least_mass count it as "
            "dust.");
  }

  explicit FragmentsProbe(const Options& options) : options_(options) {}

  void begin(const OutputContext& context, const Snapshot& first, const ColumnSink& columns) {
    for (const char* name : fields) require_field(context, first, name);
    for (const char* name : {"fragments", "mass", "kinetic", "dust", "dust_mass", "dust_kinetic",
                             "size_20", "size_50", "size_80"})
      columns.column(name);
    for (std::int64_t n = 0; n < options_.largest; ++n)
      for (const char* name : {"particles", "mass", "size", "x", "y", "z", "velocity_x",
                               "velocity_y", "velocity_z", "spin_x", "spin_y", "spin_z", "kinetic"})
        columns.column(std::string(name) + "_" + std::to_string(n));
    for (std::int64_t n = 1; n <= options_.bins; ++n) columns.column("bin_" + std::to_string(n));
  }

  void sample(const Snapshot& snapshot, double* row) {
    gather(snapshot);
    row = write_sums(row);
    for (std::size_t n = 0; n < static_cast<std::size_t>(options_.largest); ++n)
      row = n < fragments_ ? write(pieces_[n], row) : std::fill_n(row, columns_of_piece, 0.0);
    write_histogram(row);
  }

 private:
  static constexpr const char* fields[] = {"fragment",     "mass",     "volume",
                                           "displacement", "velocity", "kinetic_energy_density"};
  static constexpr std::size_t columns_of_piece = 13;

  /// Finds the pieces in the order of their numbers: the heaviest is first.
  void gather(const Snapshot& snapshot) {
    const std::span<const double> numbers = snapshot.fragments(options_.damage),
                                  mass = require_field(snapshot, "mass").values,
                                  volume = require_field(snapshot, "volume").values,
                                  u = require_field(snapshot, "displacement").values,
                                  v = require_field(snapshot, "velocity").values,
                                  energy = require_field(snapshot, "kinetic_energy_density").values;
    const auto place = [&](Particle p) {
      return position_of(snapshot, p) + Vec3{u[3 * p], u[3 * p + 1], u[3 * p + 2]};
    };
    const auto velocity = [&](Particle p) { return Vec3{v[3 * p], v[3 * p + 1], v[3 * p + 2]}; };
    pieces_.assign(static_cast<std::size_t>(*std::max_element(numbers.begin(), numbers.end())) + 1,
                   Piece());
    for (Particle p = 0; p < snapshot.particles; ++p)
      pieces_[static_cast<std::size_t>(numbers[p])].add(mass[p], volume[p], volume[p] * energy[p],
                                                        place(p), velocity(p));
    fragments_ = static_cast<std::size_t>(
        std::find_if(pieces_.begin(), pieces_.end(),
                     [&](const Piece& piece) { return piece.mass() < options_.least_mass; }) -
        pieces_.begin());
    const auto shown =
        std::min(static_cast<double>(fragments_), static_cast<double>(options_.largest));
    for (Particle p = 0; p < snapshot.particles; ++p)
      if (numbers[p] < shown)
        pieces_[static_cast<std::size_t>(numbers[p])].add_rotation(mass[p], place(p), velocity(p));
  }

  double* write_sums(double* row) const {
    double sums[2][2] = {};  // mass and kinetic energy, of fragments and of dust
    for (std::size_t n = 0; n < pieces_.size(); ++n) {
      double(&sum)[2] = sums[n < fragments_ ? 0 : 1];
      sum[0] += pieces_[n].mass();
      sum[1] += pieces_[n].kinetic();
    }
    *row++ = static_cast<double>(fragments_);
    row = std::copy_n(sums[0], 2, row);
    *row++ = static_cast<double>(pieces_.size() - fragments_);
    row = std::copy_n(sums[1], 2, row);
    return write_sizes(sums[0][0], row);
  }

  /// Writes the sizes up to which fragments hold parts of their mass.
  double* write_sizes(double mass, double* row) const {
    std::vector<std::pair<double, double>> sizes;  // with masses
    sizes.reserve(fragments_);
    for (std::size_t n = 0; n < fragments_; ++n)
      sizes.emplace_back(pieces_[n].size(), pieces_[n].mass());
    std::sort(sizes.begin(), sizes.end());
    for (const double part : {0.2, 0.5, 0.8}) {
      double below = 0, size = 0;
      for (std::size_t n = 0; n < sizes.size() && !(below >= part * mass); ++n) {
        size = sizes[n].first;
        below += sizes[n].second;
      }
      *row++ = size;
    }
    return row;
  }

  static double* write(const Piece& piece, double* row) {
    *row++ = static_cast<double>(piece.particles());
    *row++ = piece.mass();
    *row++ = piece.size();
    for (const Vec3 vector : {piece.centre(), piece.velocity(), piece.spin()})
      for (int axis = 0; axis < 3; ++axis) *row++ = vector[axis];
    *row++ = piece.kinetic();
    return row;
  }

  void write_histogram(double* row) const {
    if (options_.bins == 0) return;
    std::fill_n(row, options_.bins, 0.0);
    double all = 0;
    for (const Piece& piece : pieces_) all += piece.mass();
    for (std::size_t n = 0; n < fragments_; ++n) {
      // Masses are compared with bounds that are exact: powers of two of the whole.
      std::int64_t bin = 1;
      for (double bound = all / 2; bin < options_.bins && !(pieces_[n].mass() > bound); bound /= 2)
        ++bin;
      row[bin - 1] += 1;
    }
  }

  Options options_;
  std::vector<Piece> pieces_;
  std::size_t fragments_ = 0;  ///< number of pieces that are no dust
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::FragmentsProbe>(); }
