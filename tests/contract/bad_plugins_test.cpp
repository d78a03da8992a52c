// The host refuses every plugin in bad_plugins/ with its own message. A scene that needs such a
// plugin ends the program with the right exit code.
#include <host/gate.hpp>
#include <host/host.hpp>

#include <gtest/gtest.h>
#include <unistd.h>
#include <support/program.hpp>

#include <cstdlib>
#include <fstream>

namespace hyperlattice {
namespace bad_plugins_test {

namespace fs = std::filesystem;

const fs::path folder = HYPERLATTICE_BUILD "/tests/bad_plugins";

/// Runs the program with the bad plugins on its plugin path.
test::Result program(const std::vector<std::string>& arguments) {
  test::Launch launch;
  launch.environment = {"HYPERLATTICE_PLUGIN_PATH=" + folder.string()};
  return test::run_program(arguments, launch);
}

/// A scene whose only fault is the component that it names.
fs::path scene_with(const std::string& type, const std::string& plugins = "") {
  const std::string component = R"({"type": ")" + type + R"(", "limit": 1})";
  const bool failure = type.starts_with("failures.");
  const fs::path file = fs::temp_directory_path() /
                        ("hyperlattice_bad_plugins_" + std::to_string(getpid()) + ".json");
  std::ofstream(file) << R"({"format": "hyperlattice/1", "plugins": [)" << plugins
                      << R"(], "pipeline": [
    {"type": "lattices.cubic", "spacing": 1, "shape": {"box": {"low": [0, 0, 0], "high": [2, 2, 2]}}},
    {"type": "materials.elastic", "young": 1e9, "poisson": 0.25, "density": 1000, "membrane": "none")"
                      << (failure ? ", \"failure\": " + component + "}" : "}, " + component) << R"(,
    {"type": "solvers.explicit", "end_time": 1e-3}]})";
  return file;
}

struct BadPlugin {
  const char* type;
  const char* sentence;  ///< a part of the message
};

const BadPlugin bad_plugins[] = {
    {"failures.empty", "failures.empty.so: is an empty file"},
    {"failures.cut_short", "failures.cut_short.so: is damaged or cut short"},
    {"failures.old_interface",
     "failures.old_interface.so: interface version 999, this Hyperlattice has 4: rebuild it "
     "against these headers"},
    {"failures.old_strings",
     "failures.old_strings.so: C++ library ABI (_GLIBCXX_USE_CXX11_ABI) 0, this Hyperlattice has "
     "1: rebuild it with"},
    {"failures.later_headers",
     "failures.later_headers.so: was built against headers in which what crosses to a plugin is "
     "laid out otherwise: rebuild it against these "
     "headers"},
    {"failures.packed",
     "failures.packed.so: was built against headers in which what crosses to a plugin is laid out "
     "otherwise: rebuild it against these headers"},
#if defined(__x86_64__)
    {"failures.wide",
     "failures.wide.so: Eigen alignment 64, this Hyperlattice has 16: rebuild it without "
     "-march=native"},
#endif
    {"failures.undefined_symbol",
     "cannot be loaded: undefined symbol function_that_nobody_wrote(int): link the library that "
     "defines it"},
    {"failures.throws", "failures.throws.so: its registration failed: the licence has run out"},
    {"failures.twice", "failures.twice.so: registers failures.twice twice"},
    {"failures.registers_nothing", "failures.registers_nothing.so: registers nothing"},
    {"failures.no_marker", "failures.no_marker.so: is no plugin of Hyperlattice (it has no gate)"},
    {"failures.hollow", "failures.hollow.so: registers 'failures.hollow' with a function missing"},
    {"failures.bad_name",
     "registers the name 'failures.Bad Name', which is not of the form <family>.<name>"},
    {"failures.other_name",
     "does not register failures.other_name, the type it is named after, but failures.another"},
    {"loads.impostor",
     "registers 'loads.impostor', but the class is one of the family 'failures'"}};

void PrintTo(const BadPlugin& plugin, std::ostream* out) { *out << plugin.type; }

class Refused : public testing::TestWithParam<BadPlugin> {};

TEST_P(Refused, InASentenceAndWithoutATrace) {
  unsetenv("HYPERLATTICE_CONSTRUCTED");
  Host host({folder});
  EXPECT_EQ(host.find(GetParam().type), nullptr);
  EXPECT_TRUE(host.refused(GetParam().type));
  EXPECT_NE(host.why_not(GetParam().type).find(GetParam().sentence), std::string::npos)
      << host.why_not(GetParam().type);
  EXPECT_TRUE(host.loaded().empty());
}

TEST_P(Refused, WithExitCode4WhereASceneNeedsIt) {
  const test::Result page = program({"plugins", GetParam().type});
  EXPECT_EQ(page.exit_code, 4);
  EXPECT_NE(page.err.find(GetParam().sentence), std::string::npos) << page.err;
  const fs::path scene = scene_with(GetParam().type);
  const test::Result plan = program({"plan", scene.string()});
  EXPECT_EQ(plan.exit_code, 4);
  EXPECT_NE(plan.err.find(GetParam().sentence), std::string::npos) << plan.err;
  fs::remove(scene);
}

INSTANTIATE_TEST_SUITE_P(BadPlugins, Refused, testing::ValuesIn(bad_plugins), [](const auto& info) {
  std::string name = info.param.type;
  name[name.find('.')] = '_';
  return name;
});

TEST(BadPlugins, NoCodeRunsBeforeTheGate) {
  unsetenv("HYPERLATTICE_CONSTRUCTED");
  Host host({folder});
  for (const char* type : {"failures.old_interface", "failures.old_strings", "failures.packed",
                           "failures.later_headers", "failures.wide", "failures.cut_short"})
    host.find(type);
  EXPECT_EQ(std::getenv("HYPERLATTICE_CONSTRUCTED"), nullptr);
  ASSERT_NE(host.find("failures.sound"), nullptr)
      << host.why_not("failures.sound");  // the same source leaves its trace
  EXPECT_STREQ(std::getenv("HYPERLATTICE_CONSTRUCTED"), "failures.sound");
}

TEST(BadPlugins, AStrippedPluginIsASoundOne) {
  Host host({folder});
  EXPECT_NE(host.find("failures.stripped"), nullptr) << host.why_not("failures.stripped");
}

TEST(BadPlugins, FindingOneOpensNoOther) {
  unsetenv("HYPERLATTICE_CONSTRUCTED");
  Host host({folder});
  host.find("failures.stripped");
  for (const SearchOutcome& outcome : host.searched())
    if (outcome.path.extension() == ".so") {
      EXPECT_EQ(outcome.path.stem(), "failures.stripped");
    }
}

TEST(BadPlugins, ALibraryNamedDirectlyThatLacksTheTypeOfItsNameIsRefusedForIt) {
  Host host({folder});
  const std::string other = (folder / "failures.other_name.so").string();
  host.add_scene_paths({other}, folder);
  EXPECT_NE(host.find("failures.another"), nullptr);
  EXPECT_EQ(host.find("failures.other_name"), nullptr);
  EXPECT_EQ(host.why_not("failures.other_name"),
            "failures.other_name.so: gives failures.another, not the type it is named after");
}

TEST(BadPlugins, TwoLibrariesOfOneTypeAreBothNamed) {
  Host host({folder / "here", folder / "there"});
  EXPECT_EQ(host.find("failures.duplicate"), nullptr);
  const std::string why = host.why_not("failures.duplicate");
  EXPECT_NE(why.find("here/failures.duplicate.so"), std::string::npos) << why;
  EXPECT_NE(why.find("there/failures.duplicate.so"), std::string::npos) << why;
}

TEST(BadPlugins, ATypeTakenByALibraryOfAnotherNameIsRefused) {
  Host host({folder});
  ASSERT_NE(host.find("failures.sound"), nullptr);
  const SearchOutcome outcome = host.add_scene_paths({"thief.so"}, folder).front();
  EXPECT_FALSE(outcome.accepted);
  EXPECT_FALSE(outcome.absent);
  EXPECT_NE(outcome.reason.find("thief.so: registers failures.sound, which " +
                                (folder / "failures.sound.so").string() + " registered before"),
            std::string::npos)
      << outcome.reason;
}

TEST(BadPlugins, ADirectlyNamedLibraryMayGiveAnyType) {
  Host host;
  EXPECT_TRUE(host.add_scene_paths({"thief.so"}, folder).front().accepted);
  const Component* component = host.find("failures.sound");
  ASSERT_NE(component, nullptr);
  EXPECT_EQ(component->plugin, "thief");
  EXPECT_EQ(component->version, "1.0");
}

TEST(BadPlugins, OneFileReachedByTwoPathsIsOneLibrary) {
  Host host({folder, folder / "here" / ".."});
  EXPECT_NE(host.find("failures.sound"), nullptr) << host.why_not("failures.sound");
}

TEST(BadPlugins, AnAbsentEntryIsToldFromARefusedOne) {
  Host host;
  const auto outcomes = host.add_scene_paths({"nowhere", "failures.text.so", "here"}, folder);
  ASSERT_EQ(outcomes.size(), 3u);
  EXPECT_TRUE(outcomes[0].absent);
  EXPECT_FALSE(outcomes[1].absent || outcomes[1].accepted);
  EXPECT_TRUE(outcomes[2].accepted);
}

TEST(BadPlugins, TheCurrentDirectoryIsNotSearched) {
  const fs::path before = fs::current_path();
  fs::current_path(folder);
  for (const char* path : {"", ":", "::/nowhere:"}) {
    setenv("HYPERLATTICE_PLUGIN_PATH", path, 1);
    EXPECT_EQ(Host().find("failures.sound"), nullptr) << path;
  }
  unsetenv("HYPERLATTICE_PLUGIN_PATH");
  fs::current_path(before);
}

TEST(BadPlugins, ATypeIsNoPath) {
  Host host({folder / "here"});
  EXPECT_EQ(host.find("../failures.sound"), nullptr);
  EXPECT_EQ(host.find("failures./../../failures.sound"), nullptr);
  EXPECT_NE(host.why_not("../failures.sound").find("<family>.<name>"), std::string::npos);
}

TEST(BadPlugins, AMissingLibraryIsAnUnknownTypeAndExit2) {
  Host host({folder});
  EXPECT_EQ(host.find("failures.missing"), nullptr);
  EXPECT_FALSE(host.refused("failures.missing"));
  EXPECT_NE(
      host.why_not("failures.missing").find("no library failures.missing.so in " + folder.string()),
      std::string::npos);
  EXPECT_EQ(program({"plugins", "failures.missing"}).exit_code, 2);
  const test::Result near = program({"plugins", "failures.sond"});
  EXPECT_EQ(near.exit_code, 2);
  EXPECT_NE(near.err.find("failures.sound"), std::string::npos) << near.err;
  const fs::path unknown_type = scene_with("failures.missing");
  EXPECT_EQ(program({"plan", unknown_type.string()}).exit_code, 2);
  const fs::path absent_entry = scene_with("failures.sound", "\"no_such_folder\"");
  EXPECT_EQ(program({"plan", absent_entry.string()}).exit_code, 2);
  fs::remove(absent_entry);
}

TEST(BadPlugins, ARefusedLibraryNamedDirectlyIsExit4) {
  const fs::path scene =
      scene_with("failures.sound", '"' + (folder / "failures.text.so").string() + '"');
  const test::Result plan = program({"plan", scene.string()});
  EXPECT_EQ(plan.exit_code, 4);
  EXPECT_NE(plan.err.find("failures.text.so: is not a shared library"), std::string::npos)
      << plan.err;
  fs::remove(scene);
}

TEST(BadPlugins, ASoundOneAmongThemRuns) {
  const fs::path scene = scene_with("failures.sound");
  const test::Result plan = program({"plan", scene.string()});
  EXPECT_EQ(plan.exit_code, 0) << plan.err;
  fs::remove(scene);
}

TEST(BadPlugins, WhyListsEveryRefusal) {
  const test::Result why = program({"plugins", "--why"});
  EXPECT_EQ(why.exit_code, 0);
  for (const char* part : {"refused  ", "failures.text.so: is not a shared library",
                           "interface version 999", "accepted  ", "gives failures.sound"})
    EXPECT_NE(why.out.find(part), std::string::npos) << part << "\n" << why.out;
}

TEST(Gate, NamesEachNumberThatDiffers) {
  const GateNumbers own = own_gate();
  EXPECT_EQ(gate_mismatch(own, own), "");
  GateNumbers other = own;
  other.eigen_alignment = own.eigen_alignment / 2;
  other.library_abi += 1;
  const std::string why = gate_mismatch(other, own);
  EXPECT_NE(
      why.find("Eigen alignment 8, this Hyperlattice has 16: rebuild it for the instruction set"),
      std::string::npos)
      << why;
  EXPECT_NE(
      why.find("C++ library ABI (_GLIBCXX_USE_CXX11_ABI) 2, this Hyperlattice has 1: rebuild it"),
      std::string::npos)
      << why;
  other.compiler_abi = 2;
  EXPECT_NE(gate_mismatch(other, own).find("C++ compiler ABI 2"), std::string::npos);
  other = own;
  other.boundary += 1;
  EXPECT_NE(gate_mismatch(other, own).find("laid out otherwise: rebuild it against these headers"),
            std::string::npos);
}

/// The message for a copy of the sound plugin with one changed byte.
std::string refusal_with_byte(std::streamoff offset, char value) {
  const fs::path copy =
      fs::temp_directory_path() / ("hyperlattice_patched_" + std::to_string(getpid()) + ".so");
  fs::copy_file(folder / "failures.sound.so", copy, fs::copy_options::overwrite_existing);
  std::fstream file(copy, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(offset).put(value);
  file.close();
  std::string why;
  try {
    read_gate(copy);
  } catch (const Refusal& refusal) {
    why = refusal.what();
  }
  fs::remove(copy);
  return why;
}

TEST(Gate, SurvivesAnyDamageToTheHeader) {
  EXPECT_EQ(refusal_with_byte(5000, 0), "");  // the gate reads no code
  EXPECT_NE(refusal_with_byte(4, 1).find("another processor"), std::string::npos);  // 32 bits
  EXPECT_NE(refusal_with_byte(18, 8).find("another processor"),
            std::string::npos);                                                 // another machine
  EXPECT_NE(refusal_with_byte(16, 2).find("another kind"), std::string::npos);  // an executable
  EXPECT_NE(refusal_with_byte(46, 127).find("damaged"),
            std::string::npos);  // sections beyond the end
  for (std::streamoff offset = 0; offset < 64; ++offset)
    for (const int value : {0, 1, 127, 255}) refusal_with_byte(offset, static_cast<char>(value));
}

}  // namespace bad_plugins_test
}  // namespace hyperlattice
