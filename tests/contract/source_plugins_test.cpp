// Plugins that are one source file beside the scene: compiled, kept in the cache, refused with the
// compiler's lines; and what happens without a compiler, or if it hangs or is killed.
#include <gtest/gtest.h>
#include <support/program.hpp>

#include <cstdlib>

namespace hyperlattice {
namespace source_plugins_test {

namespace fs = std::filesystem;

const char* const criterion = R"(#include <hyperlattice/failure.hpp>
#include "limit.hpp"

namespace {
using namespace hyperlattice;
class Mine {
 public:
  struct Options { double limit = 0; };
  static Schema<Options> schema() {
    return Schema<Options>("failures.mine", "A limit of the strain")
        .add<&Options::limit>("limit", "", "largest strain").positive().example("1e-3");
  }
  explicit Mine(const Options& options) : limit_(options.limit) {}
  double alarm(const SpringFacts& spring) const { return limit_ * spring.rest_length; }
  bool breaks(const SpringFacts& spring, double elongation) const {
    return elongation > factor * limit_ * spring.rest_length;
  }
 private:
  double limit_;
};
}  // namespace
HYPERLATTICE_PLUGIN("1.0") { plugin.add<Mine>(); }
)";

const char* const material = R"(#include <hyperlattice/elastic_solid.hpp>
#include <hyperlattice/kernels/choose.hpp>

struct MyLaw {
  struct Memory {};
  static void update(const hyperlattice::SpringState&, Memory&) {}
  static double force(const hyperlattice::SpringState& s, const Memory&) {
    return s.stiffness * s.elongation;
  }
  static double energy(const hyperlattice::SpringState& s, const Memory&) {
    return 0.5 * s.stiffness * s.elongation * s.elongation;
  }
};
HYPERLATTICE_LAW(MyLaw);

namespace {
using namespace hyperlattice;
class Solid {
 public:
  using Options = elastic_solid::Options;
  static constexpr std::string_view law = "mine";
  static Schema<Options> schema() {
    Schema<Options> schema("materials.mine", "Elastic springs");
    return Options::declare(schema);
  }
  explicit Solid(const Options& options) : options_(options) {}
  MaterialConstants constants(const LatticeFacts& lattice) const {
    return options_.constants(lattice);
  }
  static KernelSet kernels(const KernelChoice& choice) { return kernels_for_processor(choice); }
 private:
  Options options_;
};
}  // namespace
HYPERLATTICE_PLUGIN("1.0") { plugin.add<Solid>(); }
)";

class SourcePlugins : public testing::Test {
 protected:
  SourcePlugins() {
    write("mine.cpp", criterion);
    write("limit.hpp", "constexpr double factor = 1;\n");
    write_scene(R"("mine.cpp")", R"({ "type": "failures.mine", "limit": 1e-4 })");
  }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_.file(name)) << text;
  }
  void write_script(const std::string& name, const std::string& text) const {
    write(name, "#!/bin/sh\n" + text + "\n");
    fs::permissions(folder_.file(name), fs::perms::owner_all);
  }
  void write_scene(const std::string& plugins, const std::string& failure,
                   const std::string& type = "materials.elastic") const {
    write("scene.json", R"({"format": "hyperlattice/1", "plugins": [)" + plugins + R"(],
      "pipeline": [
      {"type": "lattices.cubic", "spacing": 1, "shape": {"box": {"low": [0, 0, 0], "high": [4, 4, 4]}}},
      {"type": ")" + type + R"(", "young": 1e9, "poisson": 0.25, "density": 1000, "failure": )" +
                            failure + R"(},
      {"type": "loads.start_velocity", "on": "z_max", "linear": [0, 0, 1]},
      {"type": "solvers.explicit", "end_time": 0.01, "energy_tolerance": 0}]})");
  }
  test::Result run(std::vector<std::string> environment = {},
                   const std::vector<std::string>& more = {}) const {
    test::Launch launch;
    launch.directory = folder_.file("");
    environment.push_back("XDG_CACHE_HOME=" + folder_.file("cache"));
    launch.environment = environment;
    std::vector<std::string> words{"run", "scene.json", "--out", "out", "--overwrite"};
    words.insert(words.end(), more.begin(), more.end());
    return test::run_program(words, launch);
  }
  std::string hash() const {
    return test::read_json(folder_.file("out/summary.json"))["state_hash"].get<std::string>();
  }
  /// The files below the cache's folder whose names end so.
  std::size_t count_in_cache(const std::string& suffix) const {
    std::size_t count = 0;
    std::error_code none;
    for (const auto& file : fs::recursive_directory_iterator(folder_.file("cache"), none))
      count += file.path().native().ends_with(suffix);
    return count;
  }
  static bool says(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  }

  test::Folder folder_{"source_plugins"};
};

TEST_F(SourcePlugins, AreCompiledOnce) {
  const test::Result first = run();
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_PRED2(says, first.err, "compiling");
  const std::string own = hash();
  EXPECT_FALSE(says(run().err, "compiling"));
  EXPECT_EQ(count_in_cache("mine.so"), 1u);
  EXPECT_EQ(count_in_cache("compiling_"), 0u);
  const auto resolved = test::read_json(folder_.file("out/scene.resolved.json"));
  EXPECT_PRED2(says, resolved["plugins"][0].get<std::string>(), "mine.cpp");

  // a header of its own
  write("limit.hpp", "constexpr double factor = 2;\n");
  EXPECT_PRED2(says, run().err, "compiling");
  EXPECT_NE(hash(), own);
  write("limit.hpp", "constexpr double factor = 1;\n");
  EXPECT_FALSE(says(run().err, "compiling"));
  EXPECT_EQ(hash(), own);
  EXPECT_EQ(count_in_cache("mine.so"), 2u);

  // the same criterion of the installation
  write_scene("", R"({ "type": "failures.strain", "limit": 1e-4 })");
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_EQ(hash(), own);
}

TEST_F(SourcePlugins, MaterialsGetTheirKernels) {
  write("solid.cpp", material);
  write_scene(R"("solid.cpp")", R"({ "type": "failures.strain", "limit": 1e-4 })",
              "materials.mine");
  const test::Result own = run();
  ASSERT_EQ(own.exit_code, 0) << own.err;
  const auto broken = test::read_json(folder_.file("out/summary.json"))["broken_springs"];
  write_scene("", R"({ "type": "failures.strain", "limit": 1e-4 })");
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_EQ(test::read_json(folder_.file("out/summary.json"))["broken_springs"], broken);
}

TEST_F(SourcePlugins, FaultsOfTheSourceAreShown) {
  std::string text = criterion;
  text.replace(text.find("return elongation"), 6, "retrun");
  write("mine.cpp", text);
  const test::Result refused = run();
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_PRED2(says, refused.err,
               "/plugins/0: \"mine.cpp\": expected a source file that can be compiled");
  EXPECT_PRED2(says, refused.err, "mine.cpp:16:5: error: ");
  EXPECT_PRED2(says, refused.err, "retrun elongation > factor");
  EXPECT_FALSE(fs::exists(folder_.file("out")));
  EXPECT_EQ(count_in_cache(".so"), 0u);
}

TEST_F(SourcePlugins, AMissingFunctionIsNamed) {
  const auto err_of = [this](const std::string& from, const std::string& to) {
    std::string text = criterion;
    text.replace(text.find(from), from.size(), to);
    write("mine.cpp", text);
    const test::Result result = run();
    EXPECT_EQ(result.exit_code, 2);
    return result.err;
  };
  EXPECT_PRED2(says, err_of("double alarm", "double alert"),
               "this criterion lacks the public member: double alarm(const SpringFacts&) const");
  EXPECT_PRED2(says, err_of("double elongation) const", "double elongation)"),
               "a function lacks const or has other arguments");
}

TEST_F(SourcePlugins, WithoutACompilerTheOutsideFails) {
  const test::Result refused = run({"CXX=no-such-compiler"});
  EXPECT_EQ(refused.exit_code, 4);
  EXPECT_PRED2(says, refused.err, "no C++ compiler \"no-such-compiler\": install one");
}

TEST_F(SourcePlugins, ACompilerThatHangsOrDiesLeavesNothing) {
  write_script("hangs", "echo half > \"$(echo \"$@\" | sed 's/.*-o //')\"; sleep 100");
  const test::Result hung = run({"CXX=" + folder_.file("hangs"), "HYPERLATTICE_COMPILE_SECONDS=1"});
  EXPECT_EQ(hung.exit_code, 4);
  EXPECT_PRED2(says, hung.err, "took more than 1 s");
  write_script("dies", "kill -9 $$");
  const test::Result killed = run({"CXX=" + folder_.file("dies")});
  EXPECT_EQ(killed.exit_code, 4);
  EXPECT_PRED2(says, killed.err, "a signal ended its compilation");
  EXPECT_EQ(count_in_cache("") - count_in_cache("plugins") - count_in_cache("hyperlattice"), 0u);
  EXPECT_EQ(run().exit_code, 0);
}

TEST_F(SourcePlugins, CanBeRefused) {
  test::Launch launch;
  launch.directory = folder_.file("");
  launch.environment = {"XDG_CACHE_HOME=" + folder_.file("cache")};
  EXPECT_EQ(test::run_program({"--no-plugins", "run", "scene.json"}, launch).exit_code, 2);
  EXPECT_EQ(count_in_cache(".so"), 0u);
}

TEST_F(SourcePlugins, TheProgramWritesOneToStartFrom) {
  test::Launch launch;
  launch.directory = folder_.file("");
  launch.environment = {"XDG_CACHE_HOME=" + folder_.file("cache")};
  const auto start = [&](const std::string& type) {
    return test::run_program({"plugins", "--new", type, "--out", "fresh.cpp"}, launch).exit_code;
  };
  EXPECT_EQ(start("materials.fresh"), 2);  // its project has several files
  EXPECT_EQ(start("failures.fresh"), 0);
  EXPECT_EQ(start("failures.fresh"), 2);  // the file is there
  const test::Result tested = test::run_program(
      {"plugins", "--test", "failures.fresh", "--plugin-path", "fresh.cpp"}, launch);
  EXPECT_EQ(tested.exit_code, 0) << tested.out << tested.err;
}

}  // namespace source_plugins_test
}  // namespace hyperlattice
