// Writers: names of files, tables that read back exactly, refusals that list the valid names, and
// no influence of the locale.
#include <support/output.hpp>

#include <gtest/gtest.h>

#include <charconv>
#include <locale>
#include <thread>

namespace hyperlattice::test {
namespace writers_test {

std::vector<std::vector<double>> numbers_below_header(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  std::vector<std::vector<double>> rows;
  while (std::getline(in, line)) {
    auto& row = rows.emplace_back();
    for (const char* c = line.data(); c < line.data() + line.size(); ++c) {
      double value = 0;
      const auto result = std::from_chars(c, line.data() + line.size(), value);
      EXPECT_EQ(result.ec, std::errc{}) << line;
      if (result.ec != std::errc{}) return rows;
      row.push_back(value);
      c = result.ptr;
    }
  }
  return rows;
}

std::string first_line(const std::string& path) {
  std::ifstream in(path);
  std::string line;
  std::getline(in, line);
  return line;
}

std::string refusal(Plugin& writer, const Snapshot& snapshot) {
  try {
    writer.frame(snapshot);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(Csv, ReadsBackExactly) {
  Folder folder("csv");
  FakeBody body({4, 3, 2});
  Plugin writer("writers.csv", {{"fields", {"displacement", "broken_open"}}, {"file", "state"}});
  writer.begin(body.context(folder.path()));
  for (const double time : {0.0, 1.0 / 3}) {
    const Snapshot snapshot = body.at(time);
    writer.frame(snapshot);
  }
  writer.end();
  EXPECT_EQ(folder.names(),
            (std::vector<std::string>{"state_000000.csv", "state_000001.csv", "state_times.csv"}));
  EXPECT_EQ(first_line(folder.file("state_000001.csv")),
            "x,y,z,displacement_x,displacement_y,displacement_z,broken_open");
  const auto rows = numbers_below_header(folder.file("state_000001.csv"));
  ASSERT_EQ(rows.size(), 24u);
  for (std::size_t n = 0; n < rows.size(); ++n) {
    ASSERT_EQ(rows[n].size(), 7u);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(rows[n][axis], body.positions()[3 * n + axis]);
      EXPECT_EQ(rows[n][3 + axis], body.displacements[3 * n + axis]);
    }
    EXPECT_EQ(rows[n][6], body.open[n]);
  }
  EXPECT_EQ(contents(folder.file("state_times.csv")),
            "file,step,time\nstate_000000.csv,0,0\nstate_000001.csv,1,0.3333333333333333\n");
}

TEST(Csv, WritesOnlyTheRegionAndTheDeformedPlaces) {
  Folder folder("csv_region");
  FakeBody body({4, 3, 2});
  Plugin writer("writers.csv",
                {{"fields", {"broken_open"}}, {"region", "some"}, {"deformed", true}});
  writer.begin(body.context(folder.path()));
  writer.frame(body.at(0.25));
  const auto rows = numbers_below_header(folder.file("frames_000000.csv"));
  ASSERT_EQ(rows.size(), body.some().size());
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const Particle particle = body.some()[n];
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_EQ(rows[n][axis],
                body.positions()[3 * particle + axis] + body.displacements[3 * particle + axis]);
    EXPECT_EQ(rows[n][3], body.open[particle]);
  }
}

/// Runs the tasks of a writer on four threads, the last task first.
void run_on_four_threads(void*, std::uint64_t count, void* work,
                         void (*task)(void* work, std::uint64_t n) noexcept) noexcept {
  std::vector<std::thread> threads;
  for (std::uint64_t first = 0; first < 4; ++first)
    threads.emplace_back([=] {
      for (std::uint64_t n = count; n-- > 0;)
        if (n % 4 == first) task(work, n);
    });
  for (std::thread& thread : threads) thread.join();
}

/// Two frames of writers.vtu as one text. The body has several compressed blocks.
std::string frames_of_vtu(const nlohmann::json& options, bool four_threads) {
  Folder folder("threads");
  FakeBody body({40, 40, 40});
  Plugin writer("writers.vtu", options);
  writer.begin(body.context(folder.path()));
  for (const double time : {0.0, 1e-6}) {
    Snapshot snapshot = body.at(time);
    if (four_threads) snapshot.run_tasks = &run_on_four_threads;
    writer.frame(snapshot);
  }
  std::string all;
  for (const std::string& name : folder.names()) all += contents(folder.file(name));
  return all;
}

TEST(Vtu, SameBytesForAnyNumberOfThreads) {
  for (const char* codec : {"zlib", "lz4", "none"})
    for (const char* precision : {"single", "double"}) {
      const nlohmann::json options{{"codec", codec}, {"precision", precision}};
      EXPECT_TRUE(frames_of_vtu(options, true) == frames_of_vtu(options, false))
          << codec << " " << precision;
    }
}

TEST(Vtu, AsksOnceForWhatIsConstantAndNamesItsFields) {
  static std::vector<std::string> named, asked;
  static const std::vector<double> materials(24, 1.0);
  Folder folder("constant");
  FakeBody body({4, 3, 2});
  Plugin writer("writers.vtu", {{"fields", {"material", "velocity"}}, {"deformed", true}});
  OutputContext context = body.context(folder.path());
  context.use_field = [](void*, std::string_view name) noexcept { named.emplace_back(name); };
  writer.begin(context);
  for (const double time : {0.0, 1e-6}) {
    Snapshot snapshot = body.at(time);
    static const auto get_field = snapshot.get_field;
    snapshot.get_field = [](void* self, std::string_view name, Field& field) noexcept {
      asked.emplace_back(name);
      if (name != "material") return get_field(self, name, field);
      field = {1, materials};
      return true;
    };
    writer.frame(snapshot);
  }
  EXPECT_EQ(named, (std::vector<std::string>{"material", "velocity", "displacement"}));
  EXPECT_EQ(std::count(asked.begin(), asked.end(), "material"), 1);
  EXPECT_EQ(std::count(asked.begin(), asked.end(), "velocity"), 2);
}

/// The number of faces that writers.cracks writes of a body of 4 x 3 x 2 particles.
std::string faces_written(const nlohmann::json& options) {
  Folder folder("cracks");
  FakeBody body({4, 3, 2});
  Plugin writer("writers.cracks", options);
  writer.begin(body.context(folder.path()));
  writer.frame(body.at(0));
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"cracks.pvd", "cracks_000000.vtp"}));
  const std::string text = contents(folder.file("cracks_000000.vtp"));
  const std::string name = "NumberOfPolys=\"";
  const std::size_t at = text.find(name) + name.size();
  return text.substr(at, text.find('"', at) - at);
}

// Faces of the particles 0, 5, 10, 15, 20 to the next one; 5 and 15 are of diagonals.
TEST(Cracks, WritesTheFacesThatTheOptionsAskFor) {
  EXPECT_EQ(faces_written({}), "3");
  EXPECT_EQ(faces_written({{"diagonals", true}}), "5");
  // No two successive particles are in the region.
  EXPECT_EQ(faces_written({{"diagonals", true}, {"region", "some"}}), "0");
}

TEST(Cracks, ShowsTheFacesOfCutsIfAsked) {
  FakeBody body({4, 3, 2});
  body.at(0);
  static const std::vector<CrackFace> cuts(body.faces.begin(), body.faces.begin() + 2);
  Folder folder("cuts");
  OutputContext context = body.context(folder.path());
  context.get_cut_faces = [](void*) noexcept { return std::span<const CrackFace>(cuts); };
  const auto bytes = [&](const nlohmann::json& options, std::string& text) {
    Plugin writer("writers.cracks", options);
    writer.begin(context);
    writer.frame(body.at(0));
    text = contents(folder.file("cracks_000000.vtp"));
    return writer.memory_bytes();
  };
  // Besides 5 faces of which 3 are of class 0: one cut of class 0 and one diagonal.
  std::string without, with, all;
  EXPECT_EQ(bytes({}, without), 0);
  const double one = bytes({{"cuts", true}}, with);
  EXPECT_GT(one, sizeof(CrackFace));
  EXPECT_EQ(bytes({{"cuts", true}, {"diagonals", true}}, all), 2 * one);
  EXPECT_NE(without.find("NumberOfPolys=\"3\""), std::string::npos);
  EXPECT_NE(with.find("NumberOfPolys=\"4\""), std::string::npos);
  EXPECT_NE(all.find("NumberOfPolys=\"7\""), std::string::npos);
}

TEST(Cracks, NamesNoFieldSoThatItSeesTheSprings) {
  static std::vector<std::string> named;
  Folder folder("no_fields");
  FakeBody body({4, 3, 2});
  Plugin writer("writers.cracks", {{"deformed", true}});
  OutputContext context = body.context(folder.path());
  context.use_field = [](void*, std::string_view name) noexcept { named.emplace_back(name); };
  writer.begin(context);
  EXPECT_TRUE(named.empty());
}

TEST(Snapshot, RethrowsTheExceptionOfTheFirstTask) {
  FakeBody body({2, 2, 2});
  for (const bool shared : {false, true}) {
    Snapshot snapshot = body.at(0);
    if (shared) snapshot.run_tasks = &run_on_four_threads;
    try {
      snapshot.for_each(100, [](std::uint64_t n) {
        if (n % 7 == 5) throw std::runtime_error(std::to_string(n));
      });
      FAIL() << "no exception";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "5");
    }
  }
}

class EveryWriter : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Types, EveryWriter, testing::Values("writers.vtu", "writers.csv"));

TEST_P(EveryWriter, RefusesRepeatedFieldsAndFolders) {
  const auto faults =
      Plugin(GetParam(), {{"fields", {"damage", "damage"}}, {"file", "a/b"}}).faults();
  EXPECT_EQ(faults,
            (std::vector<std::string>{"file: a name of letters, digits, '_', '-' and '.', without "
                                      "folders, of at most 80 characters",
                                      "fields: each field once; \"damage\" is there twice"}));
}

TEST_P(EveryWriter, RefusesAFieldThatTheRunLacks) {
  Folder folder("missing_field");
  FakeBody body({2, 2, 2});
  Plugin writer(GetParam(), {{"fields", {"height"}}});
  const std::string expected =
      "this run has no field \"height\"; it has displacement, velocity, broken_open, broken_closed";
  OutputContext context = body.context(folder.path());
  // This context does not know the fields, so that the first frame must report the fault.
  writer.begin(context);
  EXPECT_EQ(refusal(writer, body.at(0)), expected);
  EXPECT_TRUE(folder.names().empty());
  const std::string_view present[] = {"displacement", "velocity", "broken_open", "broken_closed"};
  context.fields = present;
  try {
    writer.begin(context);
    FAIL() << "begin() took it";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), expected);
  }
}

struct CommaPoint : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST_P(EveryWriter, IgnoresTheLocale) {
  const auto write = [&] {
    Folder folder("locale");
    FakeBody body({12, 10, 10});
    Plugin writer(GetParam());
    writer.begin(body.context(folder.path()));
    writer.frame(body.at(1.5e-6));
    std::string all;
    for (const std::string& name : folder.names()) all += name + ":" + contents(folder.file(name));
    return all;
  };
  const std::string plain = write();
  const std::locale before =
      std::locale::global(std::locale(std::locale::classic(), new CommaPoint));
  // The system may lack this locale; the facet above changes streams in any case.
  const char* c_locale = std::setlocale(LC_ALL, "de_DE.UTF-8");
  const std::string foreign = write();
  std::locale::global(before);
  if (c_locale != nullptr) std::setlocale(LC_ALL, "C");
  EXPECT_TRUE(plain == foreign);
  EXPECT_NE(plain.find("1.5e-06"), std::string::npos);
}

}  // namespace writers_test
}  // namespace hyperlattice::test
