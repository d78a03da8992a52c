// Studies with one replaced value. Each is read, or refused with a pointer to the fault; no other
// outcome is allowed.
#include <study/grid.hpp>

#include <gtest/gtest.h>
#include <support/output.hpp>

namespace mutated_studies_test {
using namespace hyperlattice;
using namespace hyperlattice::study;

const char* const good = R"({
  "format": "hyperlattice-study/1", "title": "a study",
  "scene": { "format": "hyperlattice/1", "pipeline": [{ "type": "lattices.cubic", "spacing": 1 }, { "type": "materials.elastic" }] },
  "set": { "/title": "set" },
  "vary": { "spacing": { "/pipeline/0/spacing": [4, 2, 1] }, "law": { "/pipeline/1": [{ "young": 1 }, { "young": 2 }], "labels": ["soft", "stiff"] },
            "threads": [1, 2] },
  "exclude": [{ "law": "soft", "threads": [2] }],
  "refine": "spacing",
  "truth": [{ "when": { "law": "soft" }, "csv": "truth.csv", "over": "t", "over_scale": 2, "where": { "line": "a", "h": { "axis": "spacing", "scale": 0.5 } } },
            { "when": { "law": "stiff" }, "values": { "u": 1 } }],
  "compare": { "one": { "probe": "p", "column": "c", "truth": "u", "at": "1 mm", "reduce": "max", "scale": 2 } },
  "error": "relative_max", "repeats": 2, "target_error": "1 %", "peers": ["peers.csv"] })";

/// Collects all pointers into a document.
void collect(const Json& json, const Json::json_pointer& here,
             std::vector<Json::json_pointer>& all) {
  all.push_back(here);
  if (json.is_object())
    for (const auto& item : json.items()) collect(item.value(), here / item.key(), all);
  if (json.is_array())
    for (std::size_t n = 0; n < json.size(); ++n) collect(json[n], here / n, all);
}

class MutatedStudies : public testing::Test {
 protected:
  MutatedStudies() {
    std::ofstream(folder_.file("truth.csv")) << "t,line,h,u@0.0005,u@0.002\n0,a,2,0,0\n1,a,2,1,2\n";
    std::ofstream(folder_.file("peers.csv")) << "label,error,seconds\nother,0.1,1\n";
  }

  /// Returns true if the study was accepted. A refusal must name the place and the expectation.
  bool accepted(const Json& study) {
    std::ofstream(folder_.file("study.json")) << study.dump();
    try {
      grid(read_study(folder_.file("study.json"), {}));
      return true;
    } catch (const InputError& error) {
      EXPECT_FALSE(error.faults().empty());
      for (const Fault& fault : error.faults()) {
        EXPECT_FALSE(fault.pointer.empty()) << study;
        EXPECT_FALSE(fault.expected.empty()) << study;
      }
      return false;
    }
  }

  test::Folder folder_{"mutated_studies"};
};

/// Tables with any bytes are read, or refused with the place that names them.
TEST_F(MutatedStudies, TablesOfAnyBytesAreReadOrRefused) {
  const Json study = Json::parse(good);
  const std::string truth = test::contents(folder_.file("truth.csv")),
                    peers = test::contents(folder_.file("peers.csv"));
  const std::string bytes[] = {"",  "\n",  ",",  "\xff", std::string(1, '\0'), "1e999",
                               "-", "nan", "\"", ";",    "\xEF\xBB\xBF"};
  for (const auto& [name, whole] : {std::pair{"truth.csv", truth}, std::pair{"peers.csv", peers}}) {
    for (std::size_t at = 0; at < whole.size(); ++at)
      for (const std::string& other : bytes) {
        std::ofstream(folder_.file(name), std::ios::binary)
            << whole.substr(0, at) + other + whole.substr(at + 1);
        accepted(study);
      }
    std::ofstream(folder_.file(name), std::ios::binary) << whole;
  }
  std::ofstream(folder_.file("peers.csv"), std::ios::binary)
      << "label,error,seconds\n\xff\xfe,0.1,1\n";
  EXPECT_FALSE(accepted(study)) << "what is no text cannot be shown";
}

TEST_F(MutatedStudies, AreReadOrRefused) {
  const Json study = Json::parse(good);
  ASSERT_TRUE(accepted(study));
  std::vector<Json::json_pointer> places;
  collect(study, Json::json_pointer(), places);
  const Json others[] = {nullptr,
                         true,
                         -1,
                         1e300,
                         "",
                         "x",
                         "/a~2",
                         Json::array(),
                         Json::object(),
                         Json::array({1, "1 mm"}),
                         Json::object({{"/a", 1}})};
  std::size_t refused = 0;
  for (const Json::json_pointer& place : places) {
    for (const Json& other : others) {
      Json mutated = study;
      mutated[place] = other;
      if (!accepted(mutated)) ++refused;
    }
    if (place.empty()) continue;
    Json less = study;
    Json& parent = less[place.parent_pointer()];
    if (parent.is_array())
      parent.erase(std::stoul(place.back()));
    else
      parent.erase(place.back());
    accepted(less);
  }
  EXPECT_GT(refused, 5 * places.size());
}

}  // namespace mutated_studies_test
