// Single options: accepted values, the resulting value, and the description.
#include "support/fake_components.hpp"

#include <geometry/primitives.hpp>
#include <host/component_check.hpp>
#include <scene/common_options.hpp>
#include <scene/examples.hpp>
#include <scene/expectation.hpp>
#include <scene/option_reader.hpp>
#include <scene/value_reader.hpp>

#include <hyperlattice/failure.hpp>

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

namespace options_test {
using namespace hyperlattice;

/// Reads one value by one option. Returns the SI value as JSON text, or the expectation of the
/// fault.
std::string read(const Option& option, const std::string& given) {
  Faults faults;
  std::deque<std::string> texts;
  Regions regions;
  const Json none = Json::object();
  RegionReader region_reader(none, regions, faults, texts);
  ReadValue value;
  Json resolved;
  const std::vector<std::string> loads{"pull", "fixed"};
  const bool good = read_value(option, Json::parse(given), "/option",
                               {faults, region_reader, texts, loads}, value, resolved);
  EXPECT_EQ(good, faults.empty()) << given;
  return good ? resolved.dump() : faults.all().at(0).pointer + ": " + faults.all().at(0).expected;
}

Option make(OptionKind kind, std::string_view unit = "") {
  Option option;
  option.name = "option";
  option.kind = kind;
  option.unit = unit;
  return option;
}

struct Whole {
  std::int32_t narrow = 0;
  std::uint32_t count = 0;
  std::optional<std::int8_t> tiny;
  std::int64_t wide = 0;
};

/// A criterion that is complete, so that component_fault() finds only what a test puts in.
struct Renamed : fakes::Limit {
  explicit Renamed(const Options&) {}
  double alarm(const SpringFacts&) const { return infinity; }
  bool breaks(const SpringFacts&, double) const { return false; }
};

/// Had a switch where it has a choice now.
struct Switched {
  enum class Pace { slow, fast };
  struct Options {
    Pace pace = Pace::slow;
  };
  static Schema<Options> schema() {
    static constexpr std::string_view paces[] = {"slow", "fast"};
    static constexpr OldValue before[] = {{"true", "\"fast\""}, {"false", "\"slow\""}};
    return Schema<Options>("probes.switched", "Of no effect")
        .add<&Options::pace>("pace", "", "how fast")
        .choices(paces)
        .fallback("\"slow\"")
        .formerly("hurry", "0.9", before);
  }
};

/// Returns the resolved options with the warning, or the fault.
std::string read_switched(const char* text) {
  Faults faults;
  std::deque<std::string> texts;
  Regions regions;
  const Json none = Json::object(), given = Json::parse(text);
  RegionReader region_reader(none, regions, faults, texts);
  OptionReader reader(given, "", {faults, region_reader, texts});
  Json resolved;
  const auto options = reader.fill(option_set<Switched>(), resolved);
  reader.reject_unknown();
  std::string all = options ? resolved.dump() : "";
  for (const Fault& fault : faults.all()) all += fault.pointer + ": " + fault.expected;
  for (const std::string& warning : faults.warnings()) all += ' ' + warning;
  return all;
}

TEST(Options, IntegersStayWithinTheirType) {
  const auto schema = Schema<Whole>("", "")
                          .add<&Whole::narrow>("narrow", "", "")
                          .add<&Whole::count>("count", "", "")
                          .at_least(-5)
                          .at_most(1e12)
                          .add<&Whole::tiny>("tiny", "", "")
                          .at_least(1)
                          .add<&Whole::wide>("wide", "", "");
  const auto of = [&](int n) { return schema.options()[static_cast<std::size_t>(n)]; };
  EXPECT_EQ(read(of(0), "2147483647"), "2147483647");
  EXPECT_EQ(read(of(0), "-2147483648"), "-2147483648");
  EXPECT_EQ(read(of(0), "2147483648"), "/option: an integer from -2147483648 to 2147483647");
  EXPECT_EQ(read(of(0), "4294967297"),
            // A cast to 32 bits would give 1.
            "/option: an integer from -2147483648 to 2147483647");
  EXPECT_EQ(read(of(1), "4294967295"), "4294967295");
  EXPECT_EQ(read(of(1), "-1"), "/option: an integer from 0 to 4294967295");
  EXPECT_EQ(read(of(2), "0"), "/option: an integer from 1 to 127");
  EXPECT_EQ(read(of(2), "128"), "/option: an integer from 1 to 127");
  EXPECT_EQ(read(of(3), "9223372036854775807"), "9223372036854775807");
  EXPECT_EQ(example_value(of(0)), 1);
}

TEST(Options, Numbers) {
  Option length = make(OptionKind::number, "m");
  EXPECT_EQ(read(length, "2"), "2.0");
  EXPECT_EQ(read(length, "\"2 mm\""), "0.002");
  EXPECT_EQ(read(length, "\"2 kg\""), "/option: a length such as \"1 mm\" (it is a mass)");
  length.low = 0;
  EXPECT_EQ(read(length, "0"), "0.0");
  EXPECT_EQ(read(length, "-1e-300"), "/option: a length of at least 0 m such as \"1 mm\"");
  length.high = 1;
  length.low_open = true;
  EXPECT_EQ(read(length, "0"), "/option: a length above 0 m and at most 1 m such as \"1 mm\"");
  EXPECT_EQ(read(length, "1"), "1.0");
  length.word = "auto";
  EXPECT_EQ(read(length, "\"auto\""), "\"auto\"");
  EXPECT_EQ(read(length, "\"Auto\""),
            "/option: a length above 0 m and at most 1 m such as \"1 mm\", or \"auto\" (it does "
            "not begin with a number)");
}

TEST(Options, Integers) {
  Option integer = make(OptionKind::integer);
  EXPECT_EQ(read(integer, "3"), "3");
  EXPECT_EQ(read(integer, "-3"), "-3");
  EXPECT_EQ(read(integer, "1e6"), "1000000");
  EXPECT_EQ(read(integer, "9223372036854775807"), "9223372036854775807");
  for (const char* bad : {"3.7", "\"3\"", "true", "null", "9223372036854775808", "1e300", "[3]"})
    EXPECT_EQ(read(integer, bad), "/option: an integer") << bad;
  integer.low = 1;
  integer.high = 9;
  EXPECT_EQ(read(integer, "10"), "/option: an integer from 1 to 9");
}

TEST(Options, BooleansTextsChoices) {
  EXPECT_EQ(read(make(OptionKind::boolean), "true"), "true");
  EXPECT_EQ(read(make(OptionKind::boolean), "1"), "/option: true or false");
  EXPECT_EQ(read(make(OptionKind::text), "\"1 mm\""), "\"1 mm\"");
  EXPECT_EQ(read(make(OptionKind::text), "1"), "/option: a text");
  static constexpr std::string_view names[] = {"linear", "cubic"};
  Option choice = make(OptionKind::choice);
  choice.choices = names;
  EXPECT_EQ(read(choice, "\"cubic\""), "\"cubic\"");
  EXPECT_EQ(read(choice, "\"qubic\""),
            "/option: one of \"linear\", \"cubic\"; did you mean \"cubic\"?");
  EXPECT_EQ(read(choice, "0"), "/option: one of \"linear\", \"cubic\"");
}

TEST(Options, Lists) {
  const Option vector = make(OptionKind::vector, "m");
  EXPECT_EQ(read(vector, "[1, \"2 mm\", -3]"), "[1.0,0.002,-3.0]");
  EXPECT_EQ(read(vector, "[1, 2]"),
            "/option: a list [x, y, z] of three, each a length such as \"1 mm\"");
  EXPECT_EQ(read(vector, "[1, 2, {}]"), "/option/2: a length such as \"1 mm\"");
  Option numbers = make(OptionKind::numbers, "s");
  numbers.low = 0;
  EXPECT_EQ(read(numbers, "[]"), "[]");
  EXPECT_EQ(read(numbers, "[0, -1]"), "/option/1: a time of at least 0 s such as \"1 us\"");
  const Option texts = make(OptionKind::texts);
  EXPECT_EQ(read(texts, "[\"a\", \"b\"]"), R"(["a","b"])");
  EXPECT_EQ(read(texts, "[\"a\", 1]"), "/option/1: a text");
  EXPECT_EQ(read(texts, "\"a\""), "/option: a list, each entry a text");
}

TEST(Options, ShapesAndRegions) {
  EXPECT_EQ(read(make(OptionKind::shape), R"({"sphere": {"radius": "1 mm"}})"),
            R"({"sphere":{"centre":[0.0,0.0,0.0],"radius":0.001}})");
  EXPECT_EQ(read(make(OptionKind::region), "\"z_max\""), "\"z_max\"");
  EXPECT_EQ(read(make(OptionKind::region), R"({"union": ["x_min", {"box": {"size": [1, 1, 1]}}]})"),
            R"({"union":["x_min",{"box":{"size":[1.0,1.0,1.0]}}]})");
}

TEST(Options, LoadsOrRegions) {
  const Option option = make(OptionKind::load_or_region);
  EXPECT_EQ(read(option, "\"pull\""), "\"pull\"");
  EXPECT_EQ(read(option, "\"z_max\""), "\"z_max\"");
  EXPECT_EQ(read(option, R"({"sphere": {"radius": 1}})"),
            R"({"sphere":{"centre":[0.0,0.0,0.0],"radius":1.0}})");
  const std::string unknown = read(option, "\"pul\"");
  EXPECT_EQ(unknown.find("/option: the name of a load, or a region such as"), 0u) << unknown;
  EXPECT_NE(unknown.find("did you mean \"pull\""), std::string::npos) << unknown;
}

TEST(Options, EveryFaultOfAnObjectIsFound) {
  Faults faults;
  std::deque<std::string> texts;
  Regions regions;
  const Json none = Json::object(),
             given = Json::parse(R"({"young": "1 s", "poison": 0.1, "law": "qubic"})");
  RegionReader region_reader(none, regions, faults, texts);
  OptionReader reader(given, "/m", {faults, region_reader, texts});
  Json resolved;
  EXPECT_EQ(reader.fill(option_set<fakes::Spring>(), resolved), nullptr);
  reader.reject_unknown();
  // Wrong: young, law; missing: poisson, density; unknown: poison.
  EXPECT_EQ(faults.size(), 5u);
}

TEST(Options, AFormerNameBelongsToOneOptionAndHasAVersion) {
  const auto fault = [](OldName old, bool twice = false) {
    ComponentInfo info = detail::describe<Renamed>();
    const std::vector<OldName> names(twice ? 2 : 1, old);
    info.old_names = names;
    return component_fault(info);
  };
  const auto refusal = [](const std::string& name, const std::string& reason) {
    return "registers 'failures.limit' with a bad former name '" + name +
           "' of an option: " + reason;
  };
  EXPECT_EQ(fault({"threshold", "limit", "0.9"}), "");
  EXPECT_EQ(fault({"limit", "limit", "0.9"}), refusal("limit", "it is declared twice"));
  EXPECT_EQ(fault({"threshold", "limit", "0.9"}, true),
            refusal("threshold", "it is declared twice"));
  EXPECT_EQ(fault({"type", "limit", "0.9"}), refusal("type", "a stage has that key already"));
  EXPECT_EQ(
      fault({"Threshold", "limit", "0.9"}),
      refusal("Threshold", "it must be small letters, digits and underscores, a letter first"));
  EXPECT_EQ(fault({"threshold", "limits", "0.9"}),
            refusal("threshold", "no option has its present name"));
  EXPECT_EQ(fault({"threshold", "limit", ""}),
            refusal("threshold", "it has no version since when it is the former one"));
}

TEST(Options, AFormerNameMayHaveFormerValues) {
  EXPECT_EQ(read_switched(R"({"hurry": true})"),
            R"({"pace":"fast"} /hurry: "hurry": true is "pace": "fast" since version 0.9; the old )"
            "name will go");
  EXPECT_EQ(read_switched(R"({"hurry": false})").find(R"({"pace":"slow"} )"), 0u);
  EXPECT_EQ(read_switched(R"({"hurry": "fast"})"),
            R"(/hurry: true or false; since version 0.9 use "pace")");
  EXPECT_EQ(read_switched(R"({"pace": "fast"})"), R"({"pace":"fast"})");
  EXPECT_EQ(read_switched(R"({"pace": "fast", "hurry": true})"),
            R"(/hurry: "pace" alone; "hurry" is its name before version 0.9)");

  ComponentInfo info = detail::describe<Renamed>();
  const OldValue no_json[] = {{"true", "fast"}};
  const OldName old[] = {{"hurry", "limit", "0.9", no_json}};
  info.old_names = old;
  EXPECT_EQ(component_fault(info),
            "registers 'failures.limit' with a bad former name 'hurry' of an option: one of its "
            "values is not JSON");
}

TEST(Options, AFieldBelongsToAMaterialAndHasANameOfItsOwn) {
  static constexpr MaterialFunctions functions{
      [](const void*, const LatticeFacts&, MaterialConstants&, const Complaint&) noexcept {
        return true;
      },
      [](const void*, const KernelChoice&, KernelSet&, const Complaint&) noexcept { return true; },
      [](const void*) noexcept -> std::string_view { return "none"; }, nullptr};
  ComponentInfo info = detail::describe<Renamed>();
  const auto fault = [&](FieldInfo field) {
    const FieldInfo fields[] = {field};
    info.fields = fields;
    return component_fault(info);
  };
  EXPECT_EQ(fault({"wear", FieldKind::number, "", "amount"}),
            "registers 'failures.limit' with a bad field 'wear': only the laws of materials give "
            "fields");
  info.family = Family::materials;
  info.name = "materials.limit";
  info.functions = &functions;
  info.functions_size = sizeof functions;
  const std::string bad = "registers 'materials.limit' with a bad field ";
  EXPECT_EQ(fault({"wear", FieldKind::number, "", "amount"}), "");
  EXPECT_EQ(fault({"stress_xx", FieldKind::number, "", "amount"}),
            bad + "'stress_xx': the core has a field of that name");
  EXPECT_EQ(fault({"Wear", FieldKind::number, "", "amount"}),
            bad + "'Wear': its name must be small letters, digits and underscores, a letter first");
  EXPECT_EQ(fault({"wear", FieldKind::vector, "", "amount"}),
            bad + "'wear': it must be one number");
  EXPECT_EQ(fault({"wear", FieldKind::number, "", ""}), bad + "'wear': it has no help");
}

TEST(Options, RangesInWords) {
  Option option = make(OptionKind::number, "m");
  EXPECT_EQ(range_text(option), "");
  option.low = 0;
  EXPECT_EQ(range_text(option), "of at least 0 m");
  option.high = 0.25;
  EXPECT_EQ(range_text(option), "from 0 to 0.25 m");
  option.low = -infinity;
  EXPECT_EQ(range_text(option), "at most 0.25 m");
  option.high_open = true;
  EXPECT_EQ(range_text(option), "below 0.25 m");
}

TEST(Options, ExamplesAreAcceptedByTheirOwnOptions) {
  fakes::Catalogue catalogue;
  for (const Component* component : catalogue.all())
    for (const Option& option : component->info.options)
      EXPECT_NE(read(option, example_value(option).dump())[0], '/')
          << component->type() << ' ' << option.name;
  for (const Primitive& primitive : primitives())
    for (const Option& option : primitive.options.options) {
      if (option.kind == OptionKind::file) continue;  // no example can name an existing file
      EXPECT_NE(read(option, example_value(option).dump())[0], '/') << primitive.name;
    }
}

TEST(Pages, SayWhatIsDeclared) {
  fakes::Catalogue catalogue;
  const std::string page = component_page(*catalogue.find("materials.spring"));
  for (const char* part :
       {"# materials.spring\n\nLinear springs", "f = k s",
        "| `young` | Pa | above 0 | required | Young's modulus |",
        "| `poisson` |  | above -1 and at most 0.25 | required |",
        "| `law` |  | `\"linear\"`, `\"cubic\"` | `\"linear\"` | force by elongation |",
        "`failure`", "`region`", "## Restrictions\n\npoisson up to 1/4",
        "## Source\n\nthe paper, eq. (2)", "\"type\":\"materials.spring\""})
    EXPECT_NE(page.find(part), std::string::npos) << part << "\nis not in\n" << page;
  const Json json = Json::parse(component_json(*catalogue.find("solvers.march")));
  EXPECT_EQ(json["type"], "solvers.march");
  EXPECT_EQ(json["options"][1]["word"], "auto");
  EXPECT_EQ(json["options"][0]["above"], 0);
  EXPECT_TRUE(json["options"][0]["required"]);
  EXPECT_EQ(json["common_options"][2]["name"], "energy_tolerance");
}

TEST(Pages, NameWhatOptionsWereCalledBefore) {
  fakes::Catalogue catalogue;
  const std::string page = component_page(*catalogue.find("solvers.march"));
  EXPECT_NE(page.find("| `end_time` | s | above 0 | required | when it ends; named `until` before "
                      "version 0.8; named `duration` before version 0.9 |"),
            std::string::npos)
      << page;
  const Json json = Json::parse(component_json(*catalogue.find("solvers.march")));
  EXPECT_EQ(json["options"][0]["formerly"].dump(),
            R"([{"name":"until","since":"0.8"},{"name":"duration","since":"0.9"}])");
  EXPECT_FALSE(json["options"][1].contains("formerly"));
  const Json schema = Json::parse(scene_schema(catalogue.all()));
  const Json &march = schema["$defs"]["solvers.march"], &push = schema["$defs"]["loads.push"];
  EXPECT_EQ(march["properties"]["until"]["deprecated"], true);
  EXPECT_EQ(march["properties"]["until"]["description"], "named \"end_time\" since version 0.8");
  EXPECT_FALSE(march["properties"]["end_time"].contains("deprecated"));
  // exactly one name of a required option, at most one of another
  EXPECT_EQ(march["required"].dump(), R"(["type"])");
  EXPECT_EQ(march["allOf"].dump(), R"([{"oneOf":[{"required":["end_time"]},)"
                                   R"({"required":["until"]},{"required":["duration"]}]}])");
  EXPECT_EQ(push["allOf"].dump(),
            R"([{"oneOf":[{"required":["repeats"]},{"required":["count"]},)"
            R"({"not":{"anyOf":[{"required":["repeats"]},{"required":["count"]}]}}]}])");
}

TEST(Pages, SchemaIsStrict) {
  fakes::Catalogue catalogue;
  const Json schema = Json::parse(scene_schema(catalogue.all()));
  EXPECT_EQ(schema["$schema"], "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(schema["additionalProperties"], false);
  for (const Component* component : catalogue.all()) {
    const Json& stage = schema["$defs"][component->type()];
    EXPECT_EQ(stage["additionalProperties"], false);
    for (const Option& option : component->info.options)
      EXPECT_TRUE(stage["properties"].contains(std::string(option.name)));
  }
}

}  // namespace options_test
