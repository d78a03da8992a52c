// What a class lacks to be a component, in words of the compiler.
//
// A class is of the family whose functions it has. If one is missing or takes other arguments, no
// table of functions fits it (component.hpp), and a message here names the function.
#pragma once

namespace hyperlattice::detail {

/// Whether the class T has a public member of this name. It is false if the name is overloaded.
#define HYPERLATTICE_HAS(name) (requires { &T::name; })

/// Stops the compiler with a message: `T` is of no family whose header is included. A class with
/// one of the names of a family is taken for one of this family.
template <class T>
struct MissingFunction {
  static constexpr bool lattice = HYPERLATTICE_HAS(build);
  static constexpr bool material = HYPERLATTICE_HAS(constants) || HYPERLATTICE_HAS(kernels);
  static constexpr bool criterion = HYPERLATTICE_HAS(alarm) || HYPERLATTICE_HAS(breaks);
  static constexpr bool surface = HYPERLATTICE_HAS(ratio);
  static constexpr bool load = HYPERLATTICE_HAS(declare) || HYPERLATTICE_HAS(factor);
  static constexpr bool solver = HYPERLATTICE_HAS(plan) || HYPERLATTICE_HAS(run);
  static constexpr bool writer = HYPERLATTICE_HAS(frame);
  static constexpr bool probe = HYPERLATTICE_HAS(sample);
  static constexpr bool engine = HYPERLATTICE_HAS(join) || HYPERLATTICE_HAS(exchange);

#define HYPERLATTICE_NEEDS(kind, name, declaration) \
  static_assert(!(kind) || HYPERLATTICE_HAS(name),  \
                "this " #kind " lacks the public member: " declaration)

  HYPERLATTICE_NEEDS(material, constants, "MaterialConstants constants(const LatticeFacts&) const");
  HYPERLATTICE_NEEDS(material, kernels, "KernelSet kernels(const KernelChoice&) const");
  HYPERLATTICE_NEEDS(material, law, "std::string_view law");
  HYPERLATTICE_NEEDS(criterion, alarm, "double alarm(const SpringFacts&) const");
  HYPERLATTICE_NEEDS(criterion, breaks, "bool breaks(const SpringFacts&, double elongation) const");
  HYPERLATTICE_NEEDS(load, declare, "void declare(const LoadBody&, const LoadSink&)");
  HYPERLATTICE_NEEDS(load, factor, "double factor(double time) const");
  HYPERLATTICE_NEEDS(solver, plan, "SolverPlan plan(const SolverFacts&) const");
  HYPERLATTICE_NEEDS(solver, run, "void run(const SolverFacts&, SolverHost&) const");
  HYPERLATTICE_NEEDS(writer, begin, "void begin(const OutputContext&)");
  HYPERLATTICE_NEEDS(writer, end, "void end()");
  HYPERLATTICE_NEEDS(probe, begin,
                     "void begin(const OutputContext&, const Snapshot& first, const ColumnSink&)");

  /// All names are there.
  static constexpr bool named =
      lattice || surface || engine ||
      (HYPERLATTICE_HAS(constants) && HYPERLATTICE_HAS(kernels) && HYPERLATTICE_HAS(law)) ||
      (HYPERLATTICE_HAS(alarm) && HYPERLATTICE_HAS(breaks)) ||
      (HYPERLATTICE_HAS(declare) && HYPERLATTICE_HAS(factor)) ||
      (HYPERLATTICE_HAS(plan) && HYPERLATTICE_HAS(run)) ||
      (HYPERLATTICE_HAS(begin) && ((writer && HYPERLATTICE_HAS(end)) || probe));
  static_assert(!named,
                "the header of this component's family is not included, or a function lacks const "
                "or has other arguments than the family's header says");
  static_assert(lattice || material || criterion || surface || load || solver || writer || probe ||
                    engine,
                "this class has no public function of a component. Each family has its own: build "
                "(lattices), constants and kernels (materials), alarm and breaks (failures), "
                "ratio (strength surfaces), declare and factor (loads), plan and run (solvers), "
                "begin, frame and end (writers), begin and sample (probes)");

#undef HYPERLATTICE_NEEDS
};

#undef HYPERLATTICE_HAS

}  // namespace hyperlattice::detail
