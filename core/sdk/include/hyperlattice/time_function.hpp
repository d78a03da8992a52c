// Functions of time for loads: shapes of height 1, which a load multiplies by its own amplitude.
//
//   struct Options : TimeOptions { ... };
//   static Schema<Options> schema() {
//     ... add_time_options(schema); schema.check(check_time_options<Options>); ...
//   }
//   void declare(const LoadBody&, const LoadSink& sink) const { ... time_.corners(sink); }
//   double factor(double time) const { return time_(time); }
#pragma once

#include <hyperlattice/load.hpp>

#include <algorithm>
#include <numbers>

namespace hyperlattice {

enum class TimeForm : std::uint32_t { constant, triangle, half_sine, harmonic, table };
inline constexpr std::string_view time_form_names[] = {"constant", "triangle", "half_sine",
                                                       "harmonic", "table"};

/// Options of a function of time: its form, and times in s, frequency in Hz, phase in rad.
struct TimeOptions {
  TimeForm form = TimeForm::constant;
  double start = 0;
  std::optional<double> rise, fall, duration, frequency, phase, period;
  std::vector<double> times, values;
  int pulses = 1;
};

/// Declares the options above.
template <class Options>
void add_time_options(Schema<Options>& schema) {
  schema.template add<&Options::form>("form", "", "shape of the function of time")
      .choices(time_form_names)
      .fallback("\"constant\"")
      .template add<&Options::start>("start", "s", "when it begins; 0 before")
      .at_least(0)
      .fallback("0")
      .template add<&Options::rise>("rise", "s",
                                    "of triangle: from nothing to the peak; of constant and "
                                    "harmonic: to the full size, at once if left out")
      .positive()
      .template add<&Options::fall>("fall", "s", "of triangle: from the peak to nothing")
      .positive()
      .template add<&Options::duration>("duration", "s",
                                        "of half_sine: its length; of constant and harmonic: after "
                                        "it nothing, without end if left out")
      .positive()
      .template add<&Options::frequency>("frequency", "Hz", "of harmonic")
      .positive()
      .template add<&Options::phase>("phase", "rad", "of harmonic: at start; 0 if left out")
      .template add<&Options::times>(
          "times", "s", "of table: ascending, counted from start; after the last nothing")
      .fallback("[]")
      .template add<&Options::values>("values", "",
                                      "of table: one for each time, over the load's amplitude")
      .fallback("[]")
      .template add<&Options::period>("period", "s", "from one pulse to the next")
      .positive()
      .template add<&Options::pulses>(
          "pulses", "",
          "how often triangle, half_sine or table follows; more than one needs a period")
      .at_least(1)
      .at_most(100000)
      .fallback("1");
}

/// Returns the length of one pulse, s; infinity if it has no end.
inline double pulse_length(const TimeOptions& o) {
  switch (o.form) {
    case TimeForm::triangle:
      return o.rise.value_or(0) + o.fall.value_or(0);
    case TimeForm::table:
      return o.times.empty() ? 0 : o.times.back();
    default:
      return o.duration.value_or(infinity);
  }
}

/// Checks the options above against each other.
template <class Options>
void check_time_options(const Options& options, const FaultSink& faults) {
  const TimeOptions& o = options;
  const std::string_view form = time_form_names[static_cast<std::size_t>(o.form)];
  const auto is = [&](auto... forms) { return ((o.form == forms) || ...); };
  const auto say = [&](std::string_view option, const std::string& what) {
    faults.fault(option, what + " with the form " + std::string(form));
  };
  const auto rule = [&](std::string_view option, bool given, bool needed, bool allowed) {
    if (needed && !given) say(option, "it is needed");
    if (given && !allowed) say(option, "it left out");
  };
  rule("rise", o.rise.has_value(), is(TimeForm::triangle),
       is(TimeForm::triangle, TimeForm::constant, TimeForm::harmonic));
  rule("fall", o.fall.has_value(), is(TimeForm::triangle), is(TimeForm::triangle));
  rule("duration", o.duration.has_value(), is(TimeForm::half_sine),
       is(TimeForm::half_sine, TimeForm::constant, TimeForm::harmonic));
  rule("frequency", o.frequency.has_value(), is(TimeForm::harmonic), is(TimeForm::harmonic));
  rule("phase", o.phase.has_value(), false, is(TimeForm::harmonic));
  rule("times", !o.times.empty(), is(TimeForm::table), is(TimeForm::table));
  rule("values", !o.values.empty(), is(TimeForm::table), is(TimeForm::table));
  rule("period", o.period.has_value(), o.pulses > 1,
       is(TimeForm::triangle, TimeForm::half_sine, TimeForm::table));
  if (o.times.size() != o.values.size())
    faults.fault("values", "as many as there are times, " + std::to_string(o.times.size()));
  for (std::size_t n = 1; n < o.times.size(); ++n)
    if (!(o.times[n] > o.times[n - 1])) return faults.fault("times", "times that ascend");
  if (!o.times.empty() && o.times[0] < 0)
    faults.fault("times", "times of at least 0: they count from start");
  if (o.period && *o.period < pulse_length(o) * (1 - 1e-12))
    faults.fault("period", "at least as long as one pulse");
}

/// A function of time, without unit, from TimeOptions.
class TimeFunction {
 public:
  TimeFunction() = default;
  explicit TimeFunction(const TimeOptions& options) : o_(options), length_(pulse_length(options)) {}

  double operator()(double time) const {
    double t = time - o_.start;
    if (t < 0) return 0;
    if (o_.period) t -= *o_.period * std::min(std::floor(t / *o_.period), o_.pulses - 1.0);
    return t > length_ ? 0 : shape(t);
  }

  /// Returns the largest magnitude of the function.
  double largest() const {
    double size = 1;
    if (o_.form == TimeForm::table) {
      size = 0;
      for (const double value : o_.values) size = std::max(size, std::abs(value));
    }
    return size;
  }

  /// Declares the times of kinks and jumps, and the frequency.
  void corners(const LoadSink& sink) const {
    if (o_.frequency) sink.frequency(*o_.frequency);
    for (int pulse = 0; pulse < o_.pulses; ++pulse) {
      const double from = o_.start + pulse * o_.period.value_or(0);
      sink.corner(from);
      if (o_.rise) sink.corner(from + *o_.rise);
      if (length_ < infinity) sink.corner(from + length_);
      for (const double time : o_.times) sink.corner(from + time);
    }
  }

 private:
  double shape(double t) const {
    switch (o_.form) {
      case TimeForm::triangle:
        return t < *o_.rise ? t / *o_.rise : (length_ - t) / *o_.fall;
      case TimeForm::half_sine:
        return std::sin(std::numbers::pi * t / length_);
      case TimeForm::harmonic:
        return ramp(t, o_.rise.value_or(0)) *
               std::sin(2 * std::numbers::pi * *o_.frequency * t + o_.phase.value_or(0));
      case TimeForm::table:
        return between(t);
      default:
        return ramp(t, o_.rise.value_or(0));
    }
  }
  double between(double t) const {
    if (t < o_.times.front()) return 0;
    const auto after = std::upper_bound(o_.times.begin(), o_.times.end(), t);
    if (after == o_.times.end()) return o_.values.back();
    const auto n = static_cast<std::size_t>(after - o_.times.begin());
    const double share = (t - o_.times[n - 1]) / (o_.times[n] - o_.times[n - 1]);
    return (1 - share) * o_.values[n - 1] + share * o_.values[n];
  }

  TimeOptions o_;
  double length_ = infinity;
};

}  // namespace hyperlattice
