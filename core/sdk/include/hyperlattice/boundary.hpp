// The boundary: one list of all structs that cross between the program and a plugin. The gate that
// a plugin must pass before any of its code runs comes from it, and .ci/abi compares it with the
// last release. The header of each family includes this one.
//
//   class Blast {
//    public:
//     struct Options {...};
//     static Schema<Options> schema();
//     explicit Blast(const Options&);
//     ...
//   };
//   HYPERLATTICE_PLUGIN("1.0") { plugin.add<Blast>(); }
#pragma once

#include <hyperlattice/engine.hpp>
#include <hyperlattice/failure.hpp>
#include <hyperlattice/kernel_request.hpp>
#include <hyperlattice/lattice.hpp>
#include <hyperlattice/layout.hpp>
#include <hyperlattice/load.hpp>
#include <hyperlattice/material.hpp>
#include <hyperlattice/output.hpp>
#include <hyperlattice/solver.hpp>

#include <iterator>

/// Raise this number if the meaning of anything in these headers changes; changes of layout are
/// detected without it.
#ifndef HYPERLATTICE_INTERFACE_VERSION
#define HYPERLATTICE_INTERFACE_VERSION 4
#endif

// clang-format off
/// Each struct with all of its members. A struct with a member that is missing here does not
/// compile.
#define HYPERLATTICE_BOUNDARY(CROSSES)                                                                                                                \
  CROSSES(Vec3, x, y, z)                                                                                                                              \
  CROSSES(RegionId, index)                                                                                                                            \
  CROSSES(LoadOrRegion, region, load)                                                                                                                 \
  CROSSES(Shape, self, contains_point, low, high, anchor, share_of_cube)                                                                                             \
  CROSSES(Complaint, self, receive)                                                                                                                   \
  CROSSES(OptionValue, absent, boolean, integer, number, text, numbers, texts, shape, region, load_or_region)                                         \
  CROSSES(Option, name, unit, help, fallback, word, example, choices, low, high, low_open, high_open, nonzero, optional, plugin_fields, kind, set)                            \
  CROSSES(OldValue, before, now)                                                                                                                      \
  CROSSES(OldName, name, option, since, values)                                                                                                       \
  CROSSES(FieldInfo, name, kind, unit, help, needs, is_measured)                                                                                      \
  CROSSES(FaultSink, self, receive)                                                                                                                   \
  CROSSES(ComponentInfo, family, name, summary, equation, source, restrictions, options, old_names, fields, create_options, destroy_options, check_options,   \
          create, destroy, functions, functions_size)                                                                                                 \
  CROSSES(PluginInfo, version, register_components)                                                                                                   \
  CROSSES(Neighbour, dx, dy, dz, spring_class)                                                                                                        \
  CROSSES(Grid, origin, spacing, basis, sites, site_volume, membrane_distance, neighbours, spring_classes, class_stiffness, boundary, shape)          \
  CROSSES(ListedSpring, a, b, stiffness)                                                                                                              \
  CROSSES(PointList, spacing, site_volume, membrane_distance, positions, volumes, springs, shape)                                                     \
  CROSSES(SampleSpring, a, b, rest, stiffness)                                                                                                        \
  CROSSES(PeriodicSample, particles, volume, springs)                                                                                                 \
  CROSSES(LatticeSink, self, for_analysis, receive_grid, receive_run, receive_points, receive_sample, receive_partial_run)                            \
  CROSSES(LatticeFunctions, build)                                                                                                                    \
  CROSSES(MaterialConstants, density, base_stiffness, cross_ratio, alpha_ratio, clamped, law, volumetric)                                                         \
  CROSSES(ElasticConstants, C11, C12, C44)                                                                                                            \
  CROSSES(LatticeFacts, spacing, basis, site_volume, membrane_distance, neighbours, spring_classes, class_stiffness, particles, squared_lengths,      \
          lengths, cubed_lengths, allow_unstable, has_cells, self, get_elastic_constants, get_stable)                                                            \
  CROSSES(KernelChoice, membrane, listed, precision)                                                                                \
  CROSSES(SpringIdentity, a, b)                                                                                                                       \
  CROSSES(OneSpring, stiffness, rest_length, elongation, law, memory)                                                                                 \
  CROSSES(SpringAnswer, force, energy, dissipated, integrity)                                                                                                                \
  CROSSES(KernelSet, step, measure, step_row, measure_row, linearise, ask, take, start, read_fields, memory, fields, linear, softens, instructions)                                                   \
  CROSSES(MaterialFunctions, constants, kernels, law, stable_step)                                                                                    \
  CROSSES(SpringConstants, stiffness, cross_stiffness, alarm, law)                                                                                    \
  CROSSES(NeighbourGeometry, site, rest, rest_length, cross_rest_length)                                                                              \
  CROSSES(Row, begin, end, start, neighbours, material, law, weights, first_boundary_particle, last_boundary_particle)                                                         \
  CROSSES(BoundaryParticle, index, row, site, mass, axes, force, velocity, path, reaction_work, reaction_now, sum, speed_before, place_before)                 \
  CROSSES(AlarmRow, row, neighbour, sites, elongation)                                                                                                \
  CROSSES(RowPlace, index, j, k)                                                                                                                      \
  CROSSES(RowEnergies, stored, dissipated, fractured)                                                                                                 \
  CROSSES(RowSums, stored, kinetic, kinetic_mean, momentum, potential, damped, fractured)                                                                        \
  CROSSES(ListedSlots, first, neighbour, stiffness, alarm, records, memory)                                                                           \
  CROSSES(VolumetricCells, spacing, modulus, moduli)                                                                                                  \
  CROSSES(KernelRequest, rows_per_plane, planes, reach, rows, displacement, velocity, alive, material, mixture, mixture_springs, memory, memory_numbers, memory_stride, weight_sets, weights, \
          listed, neighbours, springs, mass, alpha, materials, spring_classes, membrane_distance, exact, cells, back, forward, damping, damping_rate, acceleration, \
          boundary_particles, self, review, receive_gone, other_row, scratch, scratch_width, damped_work, fracture_work, sums)                                                                          \
  CROSSES(SpringRow, count, here, there, here_before, there_before, forward, time_step, stiffness, cross_stiffness, weight, law, memory, memory_stride, rest, rest_length, cross_rest_length, membrane_distance, spacing, pull,  \
          axial, cross_pull, cross_axial)                                                                                                             \
  CROSSES(SpringFacts, rest_length, stiffness, spacing, spring_class, crossings)                                                                      \
  CROSSES(SpringBatch, time, spring, elongation, a, b, rate, memory, time_step)                                                                       \
  CROSSES(PrincipalStress, first, second, third)                                                                                                      \
  CROSSES(CohesiveInputs, strength, fracture_energy, length, weibull_modulus, seed, allow_coarse, intact_near_supports)                               \
  CROSSES(SurfaceFunctions, inputs, ratios)                                                                                                           \
  CROSSES(FailureFunctions, alarm, review, asks_ends, asks_rate, memory, start, surface)                                                              \
  CROSSES(OpenArea, particle, area)                                                                                                                   \
  CROSSES(RestSpring, a, b, stiffness, share, rest_length, breakable)                                                                                 \
  CROSSES(SeveredSpring, a, b, stiffness, rest, normal, crossing)                                                                                         \
  CROSSES(LoadBody, self, spacing, rim, region_particles, particle_position, particle_mass, particle_share, region_open_areas, region_true_area,      \
          region_centre, region_springs, particle_gap, region_cut_springs)                                                                                                \
  CROSSES(WatchedMotion, time, factor, displacement, velocity, memory)                                                                                        \
  CROSSES(LoadStiffnessBound, stiffness, viscosity)                                                                                                             \
  CROSSES(LoadSink, self, receive_force, receive_displacement, receive_velocity, receive_acceleration, receive_start_velocity, receive_corner,        \
          receive_watched, receive_warning, receive_frequency, receive_memory)                                                                                                                            \
  CROSSES(LoadFunctions, declare, factor, answer, prepare, update)                                                                                            \
  CROSSES(StaticRow, begin, end)                                                                                                                      \
  CROSSES(StaticSpring, a, b, rest)                                                                                                                   \
  CROSSES(StaticGrid, sites, row, plane, origin, places, components, spacing, membrane_distance, neighbours, rows, cells, inertia, tears, listed, springs, tetrahedra, free, threads) \
  CROSSES(SpringTangents, axial, pull, cross_axial, cross_pull, own, cell_stiffness, cell_pressure, volume_stiffness, volume_pressure)                                             \
  CROSSES(DamageSearch, share, least_share, most_share, most_growth)                                                                                  \
  CROSSES(TimeStep, length, forward)                                                                                                                  \
  CROSSES(DamageFound, share, change)                                                                                                                 \
  CROSSES(StaticProblem, self, grid, state, respond_to, load_at, prescribe_at, scale_of, position_of, damages, grow_damage_at, restore_damage_at, begin_step_of, broke, growth, hold_with, overshoot_at, places_in)                                                 \
  CROSSES(RestReport, residual, displacement_error, iterations)                                                                                       \
  CROSSES(LocalSteps, time_step, parts, share, cost)                                                                                                                            \
  CROSSES(SolverFacts, start_time, critical_time_step, corners, sites_across, listed, nodal_volumes, remembers, damages, answering, breaks, self, divide, find_middle)                             \
  CROSSES(SolverPlan, end_time, time_step, stable_time_step, damping, steps, at_rest, grows_damage, resumes, local, bytes_per_site, sweeps_per_step)                       \
  CROSSES(SolverHost, self, time, steps_done, kept, take_step, show, open, take, measure_rest, stop_motion, set_damping_rate, show_rest, keep_motion, open_motion, take_motion, keep_numbers)       \
  CROSSES(SolverFunctions, plan, run)                                                                                                                 \
  CROSSES(Field, components, values)                                                                                                                  \
  CROSSES(Resultant, force, moment)                                                                                                                   \
  CROSSES(ForcesId, index)                                                                                                                            \
  CROSSES(Section, forces, springs, area)                                                                                                             \
  CROSSES(CrackFace, a, b, spring_class, corners, area, time, damage)                                                                                 \
  CROSSES(BodyCubes, origin, edge, count, particle)                                                                                                   \
  CROSSES(Snapshot, time, step, particles, spacing, positions, self, get_field, get_resultant, get_fragments, get_crack_faces, get_cubes, run_tasks)  \
  CROSSES(FrameMark, step, time)                                                                                                                      \
  CROSSES(OutputContext, directory, title, fields, earlier, self, region_particles, announce_file, acted_particles, external_forces, cut_section,     \
          use_field, get_cut_faces, receive_warning)                                                                                                  \
  CROSSES(WriterFunctions, begin, frame, end, memory)                                                                                                 \
  CROSSES(ColumnSink, self, receive)                                                                                                                  \
  CROSSES(ProbeFunctions, begin, sample)                                                                                                              \
  CROSSES(EngineFacts, rank, ranks, node_ranks)                                                                                                       \
  CROSSES(OutgoingBytes, rank, bytes)                                                                                                                 \
  CROSSES(IncomingBytes, rank, bytes)                                                                                                                 \
  CROSSES(EngineFunctions, join, exchange, largest, sum, spread, abort)
// clang-format on

namespace hyperlattice {
namespace detail {

HYPERLATTICE_BOUNDARY(HYPERLATTICE_LAYOUT)

/// A template, so that the compiler computes it only for plugins and for the program's own gate.
template <class = void>
constexpr std::uint32_t boundary_hash() {
  LayoutHash hash;
  for (const std::uint64_t constant :
       {std::uint64_t{max_spring_classes}, std::uint64_t{max_neighbours},
        std::uint64_t{max_law_constants}, std::uint64_t{max_law_memory},
        std::uint64_t{max_failure_memory}, std::uint64_t{max_law_fields}, std::uint64_t{lanes},
        std::uint64_t{slots_ahead}, std::uint64_t{record_numbers}, std::uint64_t{record_moved},
        std::uint64_t{record_material}, std::uint64_t{particle_bit}, std::uint64_t{cell_bit},
        std::uint64_t{scratch_margin}, std::uint64_t{std::size(family_names)},
        std::uint64_t{std::size(field_names)}})
    hash.add(constant);
#define HYPERLATTICE_ADD(Struct, ...) Layout<Struct>::add_to(hash);
  HYPERLATTICE_BOUNDARY(HYPERLATTICE_ADD)
#undef HYPERLATTICE_ADD
  return hash.folded();
}

// Further numbers that decide whether two libraries can share objects. Eigen aligns by the widest
// vector unit of its compilation.
inline constexpr unsigned compiler_abi =
    __GXX_ABI_VERSION / 1000;  // the C++ ABI, without its minor revision
#if defined(_GLIBCXX_USE_CXX11_ABI)
inline constexpr unsigned library_abi = _GLIBCXX_USE_CXX11_ABI;
#else
inline constexpr unsigned library_abi = 2;
#endif
#if defined(__AVX512F__)
inline constexpr unsigned eigen_alignment = 64;
#elif defined(__AVX__)
inline constexpr unsigned eigen_alignment = 32;
#else
inline constexpr unsigned eigen_alignment = 16;
#endif

}  // namespace detail

/// A symbol whose mangled name carries the gate's numbers, so that the core reads them from the
/// file without loading it.
template <unsigned Interface, unsigned CompilerAbi, unsigned LibraryAbi, unsigned EigenAlignment,
          unsigned Boundary>
struct HYPERLATTICE_EXPORT Gate {
  static const char marker;
};
template <unsigned A, unsigned B, unsigned C, unsigned D, unsigned E>
const char Gate<A, B, C, D, E>::marker = 1;

template <class Now = void>
using ThisGate = Gate<HYPERLATTICE_INTERFACE_VERSION, detail::compiler_abi, detail::library_abi,
                      detail::eigen_alignment, detail::boundary_hash<Now>()>;

}  // namespace hyperlattice

/// Begins the registration function of a plugin, one per plugin; its body names the components.
#define HYPERLATTICE_PLUGIN(version_text)                                                         \
  static void hyperlattice_register_body(::hyperlattice::Registrar& plugin);                      \
  extern "C" HYPERLATTICE_EXPORT const char* hyperlattice_gate() {                                \
    return &::hyperlattice::ThisGate<>::marker;                                                   \
  }                                                                                               \
  extern "C" HYPERLATTICE_EXPORT const ::hyperlattice::PluginInfo hyperlattice_plugin{            \
      version_text,                                                                               \
      [](::hyperlattice::Registrar& plugin, const ::hyperlattice::Complaint& why) noexcept {      \
        return ::hyperlattice::detail::guarded(why, [&] { hyperlattice_register_body(plugin); }); \
      }};                                                                                         \
  static void hyperlattice_register_body(::hyperlattice::Registrar& plugin)
