// The reader and the program refuse each malformed scene with its own message. The program ends
// with exit code 2 and writes no file.
#include <scene/scene.hpp>

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

namespace malformed_scenes_test {

using namespace hyperlattice;
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

std::string contents(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

const Json& table() {
  static const Json all =
      Json::parse(contents(HYPERLATTICE_SOURCE "/tests/robustness/malformed_scenes.jsonc"), nullptr,
                  true, true);
  return all;
}

std::string from_hex(const std::string& digits) {
  std::string bytes;
  for (std::size_t n = 0; n < digits.size(); n += 2)
    bytes += static_cast<char>(std::stoi(digits.substr(n, 2), nullptr, 16));
  return bytes;
}

/// An empty folder of this process; the destructor removes it.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(fs::temp_directory_path() /
              ("hyperlattice_malformed_" + name + "_" + std::to_string(::getpid()))) {
    fs::remove_all(path_);
    fs::create_directories(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// Writes the text of a scene and returns its path.
  fs::path scene(const std::string& text) const {
    std::ofstream(path_ / "scene.json", std::ios::binary) << text;
    return path_ / "scene.json";
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// The text of the scene of a case.
std::string scene_of(const Json& one) {
  if (one.contains("text")) return one["text"];
  if (one.contains("text_hex")) return from_hex(one["text_hex"]);
  if (one.contains("text_repeat")) {
    std::string text;
    for (int n = 0; n < 10'000; ++n) text += one["text_repeat"].get<std::string>();
    return text;
  }
  Json scene = table()["base"];
  const Json set = one.value("set", Json::object()), drop = one.value("drop", Json::array());
  for (const auto& change : set.items()) scene[Json::json_pointer(change.key())] = change.value();
  for (const auto& gone : drop) {
    const Json::json_pointer pointer(gone.get<std::string>());
    Json& parent = scene[pointer.parent_pointer()];
    if (parent.is_array())
      parent.erase(std::stoul(pointer.back()));
    else
      parent.erase(pointer.back());
  }
  return scene.dump(2);
}

std::vector<std::string> settings_of(const Json& one) {
  return one.value("settings", std::vector<std::string>());
}

/// Does one of the faults have the place and the expectation of the case?
bool told(const std::string& message, const Json& one) {
  const std::string at = one["at"], says = one["says"];
  for (std::size_t begin = 0; begin <= message.size();) {
    const std::size_t end = std::min(message.find('\n', begin), message.size());
    const std::string line = message.substr(begin, end - begin);
    if (line.starts_with(at) && line.find(says, at.size()) != std::string::npos) return true;
    begin = end + 1;
  }
  return false;
}

class MalformedScenes : public testing::TestWithParam<std::size_t> {
 protected:
  const Json& one_ = table()["cases"][GetParam()];
  const Folder folder_{std::to_string(GetParam())};
  const fs::path scene_ = folder_.scene(scene_of(one_));
};

struct Ending {
  int code = 0;
  std::string message;
};

/// Runs the program in the folder of the scene.
Ending program(const fs::path& folder, const std::string& command,
               const std::vector<std::string>& settings) {
  std::string line =
      "cd '" + folder.string() + "' && '" HYPERLATTICE_BUILD "/bin/hyperlattice' " + command;
  for (const std::string& setting : settings) line += " --set '" + setting + "'";
  const int status = std::system((line + " > stdout.txt 2> stderr.txt").c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder / "stderr.txt")};
}

TEST_P(MalformedScenes, AreRefusedByTheReader) {
  Host host;
  if (one_.value("plan", false)) {
    EXPECT_NO_THROW(read_scene(scene_, settings_of(one_), host)) << one_["what"];
    return;
  }
  try {
    read_scene(scene_, settings_of(one_), host);
    ADD_FAILURE() << one_["what"] << " was accepted";
  } catch (const InputError& error) {
    EXPECT_TRUE(told(error.what(), one_)) << one_["what"] << ": expected " << one_["at"] << " ... "
                                          << one_["says"] << "\nbut was told\n"
                                          << error.what();
    for (const Fault& fault : error.faults()) EXPECT_FALSE(fault.expected.empty());
  }
}

TEST_P(MalformedScenes, EndTheProgramWithCode2AndNothingWritten) {
  for (const std::string command :
       {"run scene.json --out out", "run scene.json", "plan scene.json"}) {
    const Ending ending = program(folder_.path(), command, settings_of(one_));
    EXPECT_EQ(ending.code, 2) << one_["what"] << ": " << command << '\n' << ending.message;
    EXPECT_TRUE(told(ending.message, one_)) << one_["what"] << ": expected " << one_["at"]
                                            << " ... " << one_["says"] << "\nbut was told\n"
                                            << ending.message;
    std::vector<std::string> left;
    for (const auto& entry : fs::directory_iterator(folder_.path()))
      left.push_back(entry.path().filename());
    EXPECT_EQ(left.size(), 3u)
        << "besides scene.json, stdout.txt and stderr.txt something was written";
  }
}

INSTANTIATE_TEST_SUITE_P(Table, MalformedScenes,
                         testing::Range<std::size_t>(0, table()["cases"].size()),
                         [](const auto& parameter) {
                           std::string name = table()["cases"][parameter.param]["what"];
                           for (char& c : name)
                             if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
                           return name;
                         });

TEST(MalformedScenesTable, HoldsAtLeastSixty) { EXPECT_GE(table()["cases"].size(), 60u); }

TEST(MalformedScenesTable, TheBaseIsGoodAndResolvedReadsBackAsItself) {
  const Folder folder("base");
  Host host;
  const std::string resolved = read_scene(folder.scene(table()["base"].dump()), {}, host)->resolved;
  EXPECT_EQ(read_scene(folder.scene(resolved), {}, host)->resolved, resolved);
  EXPECT_EQ(program(folder.path(), "plan scene.json", {}).code, 0);
}

TEST(MalformedScenesTable, ExamplesOfAllPagesAreGood) {
  Host host;
  for (const Component* component : host.load_all()) {
    if (component->info.family == Family::engines) continue;  // no scene names one
    const auto names_a_file = [](const Option& option) { return option.kind == OptionKind::file; };
    if (std::any_of(component->info.options.begin(), component->info.options.end(), names_a_file))
      continue;  // such a page has no example
    Json scene = table()["base"], example = Json::parse(component_json(*component))["example"];
    if (component->info.family == Family::failures)
      scene["pipeline"][1]["failure"] = example;
    else if (component->info.family == Family::lattices)
      scene["pipeline"][0] = example;
    else
      scene["pipeline"].push_back(example);
    const Folder folder("example");
    EXPECT_NO_THROW(read_scene(folder.scene(scene.dump()), {}, host)) << example;
  }
}

TEST(MalformedScenesTable, ManyFaultsAreToldAtOnce) {
  Json scene = table()["base"];
  scene["pipeline"][0]["spacing"] = "5 s";
  scene["pipeline"][1]["failure"]["limit"] = -1;
  scene["pipeline"][2]["on"] = "nowhere";
  scene["pipeline"][3]["time_stp"] = 1;
  const Folder folder("many");
  folder.scene(scene.dump());
  const Ending ending = program(folder.path(), "plan scene.json", {"/titel=x"});
  EXPECT_EQ(ending.code, 2);
  for (const char* pointer : {"/pipeline/0/spacing: ", "/pipeline/1/failure/limit: ",
                              "/pipeline/2/on: ", "/pipeline/3/time_stp: ", "/titel: "})
    EXPECT_NE(ending.message.find(pointer), std::string::npos) << pointer << '\n' << ending.message;
}

}  // namespace malformed_scenes_test
