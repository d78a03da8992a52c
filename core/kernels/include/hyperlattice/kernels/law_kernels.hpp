// The kernels of a law, for every choice that a scene can make. Included by the generated file of
// each instruction set.
#pragma once

#include <hyperlattice/kernels/listed.hpp>
#include <hyperlattice/kernels/sweep.hpp>
#include <hyperlattice/kernels/tangent.hpp>

#include <string_view>

namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS {

#define HYPERLATTICE_TEXT_OF(name) #name
#define HYPERLATTICE_TEXT(name) HYPERLATTICE_TEXT_OF(name)

/// The kernels of a law for a KernelChoice, all compiled for one instruction set. Those of AVX-512
/// have no measurements, which are rare and take half of the time of the compiler: choose.hpp adds
/// those of AVX2.
template <class Law>
class Kernels {
  static constexpr bool measures =
      std::string_view(HYPERLATTICE_TEXT(HYPERLATTICE_INSTRUCTIONS)) != "avx512";

 public:
  static KernelSet of(const KernelChoice& choice, const char* instructions) {
    KernelSet set = of_membrane(choice);
    set.memory = memory_of<Law>();
    set.linear = is_linear<Law> && !LawWithConstants<Law> && !LawWithMemory<Law>;
    set.softens = has_integrity<Law>;
    if constexpr (has_start<Law>)
      set.start = [](const double* law, const SpringIdentity& spring, double* kept,
                     const Complaint& why) noexcept {
        return detail::guarded(why, [&] { SpringWithMemory<Law>(law).start(spring, kept); });
      };
    set.ask = [](const OneSpring& spring, SpringAnswer& answer, const Complaint& why) noexcept {
      return detail::guarded(why, [&] { answer = asked(spring); });
    };
    set.take = [](const OneSpring& spring, double time_step, double* kept, SpringAnswer& answer,
                  const Complaint& why) noexcept {
      return detail::guarded(why, [&] { answer = taken(spring, time_step, kept); });
    };
    set.fields = field_count<Law>();
    if constexpr (field_count<Law>() > 0)
      set.read_fields = [](const OneSpring& spring, double* values, const Complaint& why) noexcept {
        return detail::guarded(why, [&] {
          SpringWithMemory<Law>(spring.law).read_fields(state_of(spring), spring.memory, values);
        });
      };
    set.instructions = instructions;
    return set;
  }

 private:
  static SpringState state_of(const OneSpring& spring, double time_step = 0) {
    return {spring.stiffness, spring.rest_length, spring.elongation, 0, time_step};
  }
  static SpringAnswer asked(const OneSpring& spring) {
    if constexpr (LawWithMemory<Law>)
      return answer_of(SpringWithMemory<Law>(spring.law).present(state_of(spring), spring.memory));
    else
      return taken(spring, 0, nullptr);
  }

  static SpringAnswer taken(const OneSpring& spring, double time_step, double* kept) {
    if constexpr (LawWithMemory<Law>) {
      return answer_of(SpringWithMemory<Law>(spring.law).take(state_of(spring, time_step), kept));
    } else {
      const SpringOf<double> of{spring.stiffness, spring.rest_length, spring.elongation};
      return {force_of<Law>(of, spring.law), energy_of<Law>(of, spring.law)};
    }
  }
  static SpringAnswer answer_of(const SpringStep& step) {
    return {step.force, step.energy, step.dissipated, step.integrity};
  }

  /// The try block is outside of the kernel, so that it does not affect the loops.
  template <class Kernel>
  static bool run(const KernelRequest& request, const Complaint& why) noexcept {
    return detail::guarded(why, [&] { Kernel::run(request); });
  }
  template <class Kernel>
  static bool run_row(const KernelRequest& request, const RowPlace& row, RowEnergies& energies,
                      const Complaint& why) noexcept {
    return detail::guarded(why, [&] { Kernel::run_row(request, row, energies); });
  }

  static KernelSet of_membrane(const KernelChoice& choice) {
    switch (choice.membrane) {
      case Membrane::none:
        return of_precision<Membrane::none>(choice);
      case Membrane::clamped:
        return of_precision<Membrane::clamped>(choice);
      default:
        return of_precision<Membrane::free>(choice);
    }
  }
  template <Membrane membrane>
  static KernelSet of_precision(const KernelChoice& choice) {
    return choice.precision == Precision::floats
               ? of_topology<membrane, Precision::floats>(choice)
               : of_topology<membrane, Precision::doubles>(choice);
  }
  template <Membrane membrane, Precision stored>
  static KernelSet of_topology(const KernelChoice& choice) {
    constexpr KernelConfig step = config_of<Law>(membrane, stored, Task::step),
                           measure = config_of<Law>(membrane, stored, Task::measure);
    KernelSet set = choice.listed ? of_sweeps<ListedSweep<Law, step>, ListedSweep<Law, measure>>()
                                  : of_sweeps<Sweep<Law, step>, Sweep<Law, measure>>();
    set.linearise = [](const SpringRow& row, double& energy, const Complaint& why) noexcept {
      return detail::guarded(why, [&] { energy = Tangent<Law, membrane>::run(row); });
    };
    return set;
  }
  template <class Step, class Measure>
  static KernelSet of_sweeps() {
    KernelSet set;
    set.step = &run<Step>;
    set.step_row = &run_row<Step>;
    if constexpr (measures) {
      set.measure = &run<Measure>;
      set.measure_row = &run_row<Measure>;
    }
    return set;
  }
};

#define HYPERLATTICE_JOIN_OF(a, b) a##b
#define HYPERLATTICE_JOIN(a, b) HYPERLATTICE_JOIN_OF(a, b)

template <class Law>
KernelSet kernels_of_law(const KernelChoice& choice) {
  return Kernels<Law>::of(choice, HYPERLATTICE_TEXT(HYPERLATTICE_INSTRUCTIONS));
}

}  // namespace hyperlattice::HYPERLATTICE_INSTRUCTIONS

/// Defines hyperlattice_kernels_avx2(choice), or its like; used once in each generated file.
#define HYPERLATTICE_KERNELS(Law)                                                              \
  hyperlattice::KernelSet HYPERLATTICE_JOIN(hyperlattice_kernels_, HYPERLATTICE_INSTRUCTIONS)( \
      const hyperlattice::KernelChoice& choice) {                                              \
    return hyperlattice::HYPERLATTICE_INSTRUCTIONS::kernels_of_law<Law>(choice);               \
  }

/// The same for one law of several: defines kernels_of_law<Law>(choice).
#define HYPERLATTICE_KERNELS_OF(Law)                                                             \
  template hyperlattice::KernelSet hyperlattice::HYPERLATTICE_INSTRUCTIONS::kernels_of_law<Law>( \
      const hyperlattice::KernelChoice& choice);
