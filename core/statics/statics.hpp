// Connects static and implicit solvers and the simulation: makes the StaticProblem of a model and a
// state, and brings the result of a solver into the simulation. The functions are in grid.cpp,
// cells.cpp, list.cpp, response.cpp, soft_springs.cpp, load_path.cpp, time_step.cpp, answers.cpp,
// rest.cpp and statics.cpp.
#pragma once

#include <state/simulation.hpp>

#include <hyperlattice/array_memory.hpp>
#include <hyperlattice/statics.hpp>

#include <array>
#include <functional>
#include <map>
#include <optional>

namespace hyperlattice {

struct RowBuffers;
struct SoftCell;
struct SoftParticle;
struct SoftSpring;

class Statics {
 public:
  /// What a solver searches: states of rest, or mean displacements of steps in time.
  enum class Search { rest, motion };
  /// Makes the problem of a stage from `start` to `end`, s, that begins with the present state.
  Statics(const Model& model, Simulation& simulation, Search search, double start, double end,
          int threads);
  Statics(const Statics&) = delete;
  Statics& operator=(const Statics&) = delete;

  const StaticProblem& problem() const { return problem_; }
  /// Makes `displacement` the simulation's state, at the fraction `share` of the load path from the
  /// loads of the stage's start to those of its end.
  void accept(double share, const double* displacement);
  /// Ends the step in time that the solver began, with the mean displacements `mean`.
  void accept_step(const double* mean);
  /// Returns what a stage that goes on from the present state needs besides the simulation's state;
  /// empty before the first step in time.
  std::vector<double> memory();
  /// Goes on with what memory() returned, before the first search. Throws std::runtime_error if it
  /// is of another body.
  void recall(std::span<const double> memory);
  /// Returns how near to rest the present state is under the loads of the stage's end. The report
  /// has an error from the third call on.
  RestReport rest();
  /// Returns `components` numbers per particle of a field, from component `first` on.
  std::vector<double> of_particles(const double* field, int first, int components) const;

 private:
  using Values = std::vector<double, ArrayMemory<double>>;

  void read_springs();
  EquilibriumUpdate rest_at(double share, const double* displacement) const;
  double overshoot(double share, const double* displacement);
  void apply(const EquilibriumUpdate& to);
  template <class Visit>
  void for_rest_memory(const Visit& visit);

  // grid.cpp
  void make_grid();
  void make_weights();
  /// Calls visit(first place, first particle, count) for every run.
  template <class Visit>
  void for_runs(const Visit& visit) const {
    if (problem_.grid.listed) return visit(std::int64_t{0}, Particle{0}, model_.body.particles);
    const Site low = model_.body.low;
    for (const Run& run : model_.body.runs)
      visit(problem_.grid.place(run.begin - low.i, run.j - low.j, run.k - low.k), run.first,
            static_cast<std::uint64_t>(run.end - run.begin));
  }
  std::int64_t place_of(Particle particle) const;
  void read_state(double* field) const;

  // list.cpp
  void make_list();
  void find_listed_weights();
  double respond_list(const double* u, double* force, const SpringTangents* tangents) const;
  double respond_volumes(const double* u, double* force, const SpringTangents* tangents) const;

  // cells.cpp
  void make_cells(const std::vector<std::uint16_t>& alive);
  /// Adds the forces of `count` cells from the place `first` on, and writes their tangents. Returns
  /// their energy, J.
  double respond_cells(std::int64_t first, std::size_t count, const double* u, double* force,
                       const SpringTangents* tangents) const;

  // soft_springs.cpp
  /// Takes over what damage softens; what it softened before returns.
  void take_soft(const std::vector<SoftSpring>& springs, const std::vector<SoftParticle>& particles,
                 const std::vector<SoftCell>& cells);
  DamageFound grow_damage(const double* displacement, const DamageSearch& search);
  void restore_damage();
  double respond_soft(const double* u, double* force, const SpringTangents* tangents) const;

  // response.cpp
  double respond_grid(const double* u, double* force, const SpringTangents* tangents) const;
  double respond(const double* u, double* force, const SpringTangents* tangents) const;
  using LawMemory = std::array<Layout::Memory, 2>;
  /// Springs with the same constants. `material`: one of their materials; `stiffness`: of the
  /// first, N/m; `memory`: of the first base and cross spring.
  struct AlikeSprings {
    const SpringConstants& constants;
    std::uint8_t material;
    double stiffness;
    LawMemory memory;
  };
  /// Returns the constants of a row's spring number t to a neighbour. `first`: place of the row's
  /// first particle; `step`: from a place to its neighbour; `exists`: whether there is such a
  /// spring.
  const SpringConstants& constants_of(std::size_t neighbour, std::int64_t first, std::int64_t step,
                                      std::size_t t, bool exists) const {
    const auto kind = [&](std::int64_t place) {
      return !exists || kind_.empty() ? 0 : kind_[static_cast<std::size_t>(place) + t];
    };
    return model_.springs.spring_to(static_cast<std::uint32_t>(neighbour), kind(first),
                                    kind(first + step));
  }
  double linearise_row(std::size_t neighbour, std::int32_t begin, std::int32_t j, std::int32_t k,
                       RowBuffers& buffer) const;
  double linearise(const AlikeSprings& alike, RowBuffers& buffer) const;
  double linearise_composite(const CompositeSpring& composite, const AlikeSprings& alike,
                             RowBuffers& buffer) const;
  double respond_plane(std::int32_t k, const double* u, double* force,
                       const SpringTangents* tangents) const;
  void fill_own(const SpringTangents& tangents) const;
  double hold_heights(const double* u, double* force) const;

  // time_step.cpp
  bool moves() const { return step_.has_value(); }
  std::vector<double> motion_memory() const;
  void recall_motion(std::span<const double> memory);
  void time_row(SpringRow& row) const;
  void place_row(const double* u, std::int64_t place, std::int64_t step, SpringRow& row) const;
  double end_of(std::size_t number, const double* mean) const {
    return state_[number] + (mean[number] - state_[number]) / step_->of.forward;
  }
  /// Calls visit(number, place, component, whether it can move) for each number of a field.
  template <class Visit>
  void for_numbers(const Visit& visit) const {
    std::size_t number = 0;
    for (int c = 0; c < problem_.grid.components; ++c)
      for (std::size_t place = 0; place < free_.size(); ++place, ++number)
        visit(number, place, c, (free_[place] >> c & 1u) != 0);
  }
  void expect_step() const;
  void read_velocity(double time_step);
  void begin_step(const TimeStep& step);
  void add_inertia(const double* mean, double* force) const;
  void add_step_loads(double* force) const;
  void prescribe_mean(double* mean) const;
  double motion_scale(const double* external);
  EquilibriumUpdate end_of_step(const double* mean, Values& after, Values& speed) const;
  double numerical_dissipation(const Values& after, const Values& speed);

  // answers.cpp
  /// A motion that loads answer to.
  struct Seen {
    double time;  ///< s
    const double* displacement;
    std::function<double(std::size_t number)> velocity;  ///< m/s
  };
  Seen mean_motion(const double* mean) const;
  WatchedMotion watched_motion(std::size_t load, double factor, const Seen& seen) const;
  void add_answers(const std::vector<double>& factors, const Seen& seen, double* force) const;

  // places.cpp
  std::span<const std::int64_t> places_in(RegionId region);

  // load_path.cpp
  void find_loaded();
  void make_loads();
  void find_preload();
  void add_loads(double share, double* force) const;
  void prescribe(double share, double* u) const;
  double force_scale(const double* internal, const double* external);
  std::vector<double> factors(double share) const;

  const Model& model_;
  Simulation& simulation_;
  double start_, end_;
  StaticProblem problem_;
  std::vector<StaticRow> rows_;
  std::vector<StaticSpring> springs_;                              ///< of a listed body
  std::vector<double> spring_stiffness_, spring_cross_stiffness_;  ///< N/m
  std::vector<Simulation::SpringMemory> spring_memory_;  ///< of a listed body whose laws keep some
  std::vector<std::uint8_t> free_;
  std::vector<std::uint32_t> kind_;  ///< ParticleKinds::of() of each place; empty: one material
  /// Fraction of each spring that counts, [n * places + place] or per listed spring; 0: no spring.
  std::vector<float, ArrayMemory<float>> weight_;
  /// K_v times the share of the cell of each place, Pa; empty: no cells.
  Values cell_modulus_;
  Values cell_remains_;  ///< what damage leaves of their tension; empty: all of it
  struct Soft {
    std::int64_t place, step;  ///< of the first end, and on to the other
    std::size_t at;            ///< in weight_
    float weight;              ///< there, before it was softened
    SpringProperties of;
    double factor;
  };
  struct SoftAlpha {
    std::int64_t place;
    double lost;  ///< of its stiffness, N/m
  };
  std::vector<Soft> soft_;  ///< springs that respond_soft() computes
  std::vector<SoftAlpha> soft_alphas_;
  std::vector<float> particle_weight_;  ///< fraction of a whole particle at each place

  Values state_;              ///< displacements, m
  double hold_ = 0;           ///< see StaticProblem::hold, N/m
  double share_ = 0;          ///< place of the state on the load path, 0 to 1
  double largest_scale_ = 0;  ///< largest force so far that residuals were compared with, N
  /// A step in time (StaticProblem::begin_step).
  struct Step {
    TimeStep of;
    std::vector<double> factor;  ///< mean of each load
    std::vector<double> held;    ///< displacement of each prescribed number at the end, m
    Values anchor;               ///< u + forward h v, m
    double mean(double start, double end) const {
      return (1 - of.forward) * start + of.forward * end;
    }
    double inertia() const {  ///< 1/s2, times mass
      const double time = of.forward * of.length;
      return 1 / (time * time);
    }
  };
  std::optional<Step> step_;
  mutable double mean_force_ = 0;  ///< of the springs on a particle, N, in the last response
  Values velocity_;                ///< at the time of the state, m/s; empty at rest
  /// The particles that a load watches, in its order, and its last answers to their mean motion.
  struct Watching {
    std::vector<std::int64_t> places;
    std::vector<Vec3> moved, velocity, answers;  ///< m, m/s and N
  };
  mutable std::vector<Watching> watching_;  ///< of each load
  Values force_;                            ///< forces of the springs at the state, N
  Values holding_;  ///< further forces that hold the state at share 0 at rest, N
  std::vector<double> factor_start_, factor_end_;  ///< one per load
  double gravity_start_ = 1;
  std::uint64_t broken_ = 0;  ///< springs when they were read last
  double preload_ = 0;        ///< loads of the start over their change in the stage
  std::vector<double> mass_;  ///< at each place, kg; empty without body acceleration and inertia
  struct Loaded {
    std::int64_t place;
    std::size_t load;
    Vec3 force;  ///< amplitude, N
  };
  /// A number that a load prescribes.
  struct Prescribed {
    std::int64_t place;
    int component;
    std::size_t load;
    bool displaced;    ///< else driven with a velocity
    double amplitude;  ///< m, or m/s
  };
  std::vector<Prescribed> prescribed_;
  struct Held {
    std::int64_t place;
    unsigned axes;
    double from[3], to[3];  ///< m, at the start and the end
  };
  std::vector<Loaded> loaded_;
  bool compared_ = false;
  /// The least Rayleigh quotient so far of a motion between two states, 1/s^2.
  double slowest_ = infinity;
  std::vector<Held> held_;  ///< one entry per particle
  std::map<std::uint32_t, std::vector<std::int64_t>>
      places_in_;  ///< of regions that were asked for
};

}  // namespace hyperlattice
