// Options are declared once. From one declaration come parsing, units, validation, `hyperlattice
// plugins NAME`, the JSON Schema and the page in docs/components.
//
//   struct Options { double peak; std::optional<double> area; std::string law; };
//   static Schema<Options> schema() {
//     return Schema<Options>("loads.my_pulse", "Triangular pressure pulse on a surface")
//         .add<&Options::peak>("peak", "Pa", "largest pressure").at_least(0)
//         // std::optional: the option may be left out
//         .add<&Options::area>("area", "m2", "true area of the surface").positive()
//         .add<&Options::law>("law", "", "how it falls").choices(kLaws).fallback("\"linear\"");
//   }
#pragma once

#include <hyperlattice/field_table.hpp>
#include <hyperlattice/plain.hpp>

#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

namespace hyperlattice {

enum class OptionKind : std::uint32_t {
  number,
  integer,
  boolean,
  text,
  choice,
  vector,
  numbers,
  texts,
  shape,
  region,
  file,
  load_or_region
};

/// A validated value in SI units, which the core passes to an option's setter. Texts and shapes
/// outlive the component.
struct OptionValue {
  bool absent = false;  ///< not given, or given as the option's `word` ("auto")
  bool boolean = false;
  std::int64_t integer = 0;  ///< also the index of a choice
  double number = 0;
  std::string_view text;
  std::span<const double> numbers;
  std::span<const std::string_view> texts;
  const Shape* shape = nullptr;
  RegionId region;
  LoadOrRegion load_or_region;
};

/// One declared option. Every pointer stays valid as long as the plugin is loaded, which is until
/// the program ends.
struct Option {
  std::string_view name;
  std::string_view unit;  ///< SI unit that fixes the dimension: "m", "Pa", "kg/m3"; empty:
                          ///< dimensionless or not a number
  std::string_view help;
  std::string_view fallback;  ///< default as JSON text; empty: required, or absent if `optional`
  std::string_view word;      ///< a word accepted in place of the value: "auto"
  /// Value for examples and contract tests, as JSON text; empty: made from the range.
  std::string_view example;
  std::span<const std::string_view> choices;
  double low = -infinity, high = infinity;
  bool low_open = false, high_open = false;  ///< the bound itself is not allowed
  bool nonzero = false;                      ///< a vector must have a length
  bool optional = false;
  bool plugin_fields = false;  ///< fields that materials of the scene declare are choices too
  OptionKind kind = OptionKind::number;
  bool (*set)(void* options, const OptionValue& value, const Complaint& why) noexcept = nullptr;
};

/// A former value of an option and the present one of the same meaning, both as JSON text.
struct OldValue {
  std::string_view before, now;
};

/// A former name of an option. A scene may still use it, with a warning.
struct OldName {
  std::string_view name;    ///< the former name, which no option has
  std::string_view option;  ///< the present name
  std::string_view since;   ///< version that introduced the present name: "0.9"
  /// The only values that the former name takes; empty: it takes those of the present name.
  std::span<const OldValue> values = {};
};

/// Receives the errors of a cross-field check: the option, and the expected value.
struct FaultSink {
  void* self = nullptr;
  void (*receive)(void* self, std::string_view option,
                  std::string_view expected) noexcept = nullptr;

  void fault(std::string_view option, std::string_view expected) const {
    receive(self, option, expected);
  }
};

namespace detail {

template <class T>
struct Unwrapped {
  using type = T;
  static constexpr bool optional = false;
};
template <class T>
struct Unwrapped<std::optional<T>> {
  using type = T;
  static constexpr bool optional = true;
};

template <class T>
constexpr OptionKind kind_of() {
  if constexpr (std::is_same_v<T, bool>)
    return OptionKind::boolean;
  else if constexpr (std::is_enum_v<T>)
    return OptionKind::choice;
  else if constexpr (std::is_integral_v<T>)
    return OptionKind::integer;
  else if constexpr (std::is_floating_point_v<T>)
    return OptionKind::number;
  else if constexpr (std::is_same_v<T, Vec3>)
    return OptionKind::vector;
  else if constexpr (std::is_same_v<T, std::vector<double>>)
    return OptionKind::numbers;
  else if constexpr (std::is_same_v<T, std::vector<std::string>>)
    return OptionKind::texts;
  else if constexpr (std::is_same_v<T, const Shape*>)
    return OptionKind::shape;
  else if constexpr (std::is_same_v<T, RegionId>)
    return OptionKind::region;
  else if constexpr (std::is_same_v<T, LoadOrRegion>)
    return OptionKind::load_or_region;
  else {
    static_assert(std::is_same_v<T, std::string>, "an option of this type cannot be declared");
    return OptionKind::text;
  }
}

/// Sets the bounds of an integer option to those of its type, so that no value wraps. Values arrive
/// as std::int64_t; a type as wide as that gets no upper bound, and a signed one no lower bound.
template <class T>
constexpr void bound_by_type(Option& option) {
  if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
    if (std::is_unsigned_v<T> || sizeof(T) < sizeof(std::int64_t))
      option.low = static_cast<double>(std::numeric_limits<T>::lowest());
    if (sizeof(T) < sizeof(std::int64_t))
      option.high = static_cast<double>(std::numeric_limits<T>::max());
  }
}

template <class T>
T convert(const OptionValue& value) {
  if constexpr (std::is_same_v<T, bool>)
    return value.boolean;
  else if constexpr (std::is_enum_v<T> || std::is_integral_v<T>)
    return static_cast<T>(value.integer);
  else if constexpr (std::is_floating_point_v<T>)
    return static_cast<T>(value.number);
  else if constexpr (std::is_same_v<T, Vec3>)
    return {value.numbers[0], value.numbers[1], value.numbers[2]};
  else if constexpr (std::is_same_v<T, std::vector<double>>)
    return {value.numbers.begin(), value.numbers.end()};
  else if constexpr (std::is_same_v<T, std::vector<std::string>>)
    return {value.texts.begin(), value.texts.end()};
  else if constexpr (std::is_same_v<T, const Shape*>)
    return value.shape;
  else if constexpr (std::is_same_v<T, RegionId>)
    return value.region;
  else if constexpr (std::is_same_v<T, LoadOrRegion>)
    return value.load_or_region;
  else
    return std::string(value.text);
}

template <class Class, class T>
T member_type(T Class::*);

template <auto Member, class Options>
bool assign(void* options, const OptionValue& value, const Complaint& why) noexcept {
  return guarded(why, [&] {
    using Declared = decltype(member_type(Member));
    auto& target = static_cast<Options*>(options)->*Member;
    if constexpr (Unwrapped<Declared>::optional) {
      if (value.absent)
        target.reset();
      else
        target = convert<typename Unwrapped<Declared>::type>(value);
    } else {
      target = convert<Declared>(value);
    }
  });
}

}  // namespace detail

/// The declaration of a component: its name, its options, and checks across options.
template <class Options>
class Schema {
 public:
  Schema(std::string_view name, std::string_view summary) : name_(name), summary_(summary) {}

  /// Sets the equation shown on the component's page.
  Schema& equation(std::string_view text) {
    equation_ = text;
    return *this;
  }
  /// Sets the source: an equation of a paper, or a reference.
  Schema& source(std::string_view text) {
    source_ = text;
    return *this;
  }
  Schema& restrictions(std::string_view text) {
    restrictions_ = text;
    return *this;
  }

  /// Declares a field that the material's law gives: a number of each particle, `unit` in SI. See
  /// Fields in law.hpp, whose members have the order of these calls. Outputs name it as any field.
  Schema& field(std::string_view name, std::string_view unit, std::string_view help) {
    fields_.push_back({name, FieldKind::number, unit, help});
    return *this;
  }
  /// Declares the member as an option. A std::optional member may be left out of a scene; any other
  /// needs a fallback or is required.
  template <auto Member>
  Schema& add(std::string_view name, std::string_view unit, std::string_view help) {
    using Declared = decltype(detail::member_type(Member));
    Option option;
    option.name = name;
    option.unit = unit;
    option.help = help;
    option.optional = detail::Unwrapped<Declared>::optional;
    option.kind = detail::kind_of<typename detail::Unwrapped<Declared>::type>();
    detail::bound_by_type<typename detail::Unwrapped<Declared>::type>(option);
    option.set = &detail::assign<Member, Options>;
    options_.push_back(option);
    return *this;
  }
  // The functions below refine the option added last. Bounds can only narrow those of an integer's
  // type.
  Schema& fallback(std::string_view json) {
    last().fallback = json;
    return *this;
  }
  Schema& word(std::string_view text) {
    last().word = text;
    return *this;
  }
  /// Sets a value that makes the component act on solids of 1 mm and 10 GPa. The page's example and
  /// `hyperlattice plugins --test` use it.
  Schema& example(std::string_view json) {
    last().example = json;
    return *this;
  }
  Schema& positive() { return above(0); }
  Schema& at_least(double low) {
    if (low < last().low) return *this;
    last().low = low;
    last().low_open = false;
    return *this;
  }
  Schema& at_most(double high) {
    if (high > last().high) return *this;
    last().high = high;
    last().high_open = false;
    return *this;
  }
  Schema& above(double low) {
    if (low < last().low) return *this;
    last().low = low;
    last().low_open = true;
    return *this;
  }
  Schema& below(double high) {
    if (high > last().high) return *this;
    last().high = high;
    last().high_open = true;
    return *this;
  }
  /// Refuses the vector [0, 0, 0], which has no direction.
  Schema& nonzero() {
    last().nonzero = true;
    return *this;
  }
  /// Sets the names allowed for a text, for each text of a list, or for an enum member in the order
  /// of its values. The array must be static.
  template <std::size_t N>
  Schema& choices(const std::string_view (&names)[N]) {
    if (last().kind == OptionKind::text) last().kind = OptionKind::choice;
    last().choices = names;
    return *this;
  }
  /// Lets the option also take the names of fields that materials of the scene declare. For choices
  /// that are names of fields.
  Schema& plugin_fields() {
    last().plugin_fields = true;
    return *this;
  }
  /// Keeps a former name of the option valid. `since` is the version in which the option got its
  /// present name.
  Schema& formerly(std::string_view name, std::string_view since) {
    old_names_.push_back({name, last().name, since});
    return *this;
  }
  /// Does the same where the values were others too. The array must be static and has at least one.
  template <std::size_t N>
  Schema& formerly(std::string_view name, std::string_view since, const OldValue (&values)[N]) {
    old_names_.push_back({name, last().name, since, values});
    return *this;
  }
  /// Makes the text the name of a file, relative to the scene's folder. The file must exist; the
  /// component gets its full path.
  Schema& file() {
    last().kind = OptionKind::file;
    return *this;
  }
  /// Sets a check across options, which runs if each single option is valid.
  Schema& check(void (*test)(const Options&, const FaultSink&)) {
    check_ = test;
    return *this;
  }

  std::string_view name() const { return name_; }
  std::string_view summary() const { return summary_; }
  std::string_view equation() const { return equation_; }
  std::string_view source() const { return source_; }
  std::string_view restrictions() const { return restrictions_; }
  std::span<const Option> options() const { return options_; }
  std::span<const OldName> old_names() const { return old_names_; }
  std::span<const FieldInfo> fields() const { return fields_; }
  auto cross_check() const { return check_; }

 private:
  Option& last() { return options_.back(); }

  std::string_view name_, summary_, equation_, source_, restrictions_;
  std::vector<Option> options_;
  std::vector<OldName> old_names_;
  std::vector<FieldInfo> fields_;
  void (*check_)(const Options&, const FaultSink&) = nullptr;
};

}  // namespace hyperlattice
