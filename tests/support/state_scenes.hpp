// Scenes of which each keeps something else from one step to the next: springs that broke, memories
// of laws, criteria and loads, added mass, velocities of implicit steps.
#pragma once

#include <support/program.hpp>

#include <ostream>

namespace hyperlattice::test {

/// Indices of stages in the scenes below.
inline constexpr std::size_t lattice_stage = 0, material_stage = 1;

/// A block that is pulled apart, with all kinds of outputs.
inline nlohmann::json pulled_block() {
  return nlohmann::json::parse(R"({ "format": "hyperlattice/1", "pipeline": [
    { "type": "lattices.cubic", "spacing": 1e-3, "shape": { "box": { "low": [0, 0, 0], "high": [0.012, 0.012, 0.02] } } },
    { "type": "materials.elastic", "young": "10 GPa", "poisson": 0.1, "density": 2500, "membrane": "I-m",
      "failure": { "type": "failures.elongation", "limit": "2e-3 mm" } },
    { "type": "loads.fixed", "on": "z_min" }, { "type": "loads.velocity", "on": "z_max", "value": [0, 0, 1], "rise": "10 us" },
    { "type": "loads.drag", "density": 1000 },
    { "type": "solvers.explicit", "end_time": "1 ms" },
    { "type": "writers.vtu", "every": "100 us" }, { "type": "writers.csv", "every": "300 us", "name": "tables" },
    { "type": "writers.picture", "every": "400 us", "width": 320, "height": 320 },
    { "type": "probes.point", "name": "top", "position": [0.006, 0.006, 0.02] }, { "type": "probes.line", "name": "axis", "start": [0.006, 0.006, 0],
      "end": [0.006, 0.006, 0.02], "points": 5, "every": "200 us" } ] })");
}

/// Steps of their own length, with numerical damping, in which springs break.
inline void make_implicit(nlohmann::json& scene) {
  nlohmann::json& pipeline = scene["pipeline"];
  pipeline.erase(4);
  pipeline[lattice_stage]["shape"]["box"]["high"] = {0.006, 0.006, 0.01};
  for (nlohmann::json& stage : pipeline)
    if (stage["type"] == "probes.point") stage["position"] = {0.003, 0.003, 0.01};
  pipeline[4] = {
      {"type", "solvers.implicit"}, {"end_time", "60 us"}, {"tolerance", 1e-5}, {"damping", 0.05}};
}

struct StateCase {
  const char* name;
  void (*change)(nlohmann::json& scene);
  std::size_t rows = 40;  ///< of the history between two cuts
};
inline void PrintTo(const StateCase& scene, std::ostream* out) { *out << scene.name; }
inline const StateCase state_cases[] = {
    {"breakable", [](nlohmann::json&) {}},
    {"floats", [](nlohmann::json& scene) { scene["precision"] = "float"; }},
    {"plastic",
     [](nlohmann::json& scene) {
       scene["pipeline"][material_stage] = {{"type", "materials.plastic"},
                                            {"young", "10 GPa"},
                                            {"density", 2500},
                                            {"membrane", "none"},
                                            {"yield", "5 MPa"}};
     }},
    {"friction",
     [](nlohmann::json& scene) {
       scene["pipeline"][lattice_stage]["cuts"] = {
           {{"plane", {{"point", {0, 0, 0.0105}}, {"normal", {0.2, 0.1, 1}}}}}};
       scene["pipeline"][material_stage] = {{"type", "materials.elastic"},
                                            {"young", "10 GPa"},
                                            {"poisson", 0.25},
                                            {"density", 2500},
                                            {"membrane", "none"}};
       scene["pipeline"][3]["value"] = {0.3, 0, -0.3};
       scene["pipeline"][4] = {{"type", "loads.friction"}, {"angle", "10 degrees"}};
       scene["pipeline"][5]["end_time"] = "0.5 ms";
     }},
    {"section",  // of more than 1024 springs, some of which are gone when the run goes on
     [](nlohmann::json& scene) {
       scene["pipeline"][lattice_stage]["shape"]["box"]["high"] = {0.018, 0.018, 0.02};
       for (nlohmann::json& stage : scene["pipeline"])
         if (stage["type"] == "solvers.explicit") stage["end_time"] = "0.6 ms";
       scene["pipeline"].push_back({{"type", "probes.section"},
                                    {"point", {0, 0, 0.0192}},
                                    {"normal", {0.05, 0.02, 1}},
                                    {"every", "10 us"}});
     }},
    {"listed",
     [](nlohmann::json& scene) {
       scene["pipeline"].erase(4);  // the drag needs a surface with more springs
       scene["pipeline"][lattice_stage]["type"] = "lattices.random";
       scene["pipeline"][material_stage]["membrane"] = "I";
     }},
    {"remembered_damage",
     [](nlohmann::json& scene) {
       scene["pipeline"][material_stage]["failure"] = {
           {{"type", "failures.strain"}, {"limit", 0.01}},
           {{"type", "failures.tuler_butcher"}, {"threshold", 5e-4}, {"impulse", 1e-11}}};
       scene["pipeline"][5]["end_time"] = "0.3 ms";  // springs are asked at every step
     }},
    {"added_mass",
     [](nlohmann::json& scene) {
       scene["pipeline"][material_stage].update({{"membrane", "none"}, {"poisson", 0.25}});
       scene["pipeline"][5]["mass_scaling"] = "1 us";
     }},
    {"after_rest",
     [](nlohmann::json& scene) {
       nlohmann::json& pipeline = scene["pipeline"];
       pipeline.erase(4);  // static solvers do not support the drag
       pipeline[3] = {
           {"type", "loads.force"}, {"on", "z_max"}, {"total", {5, 0, 200}}, {"rise", "10 us"}};
       pipeline.insert(pipeline.begin() + 4, nlohmann::json{{"type", "solvers.static"}});
       pipeline[5]["damping"] = 0.1;
     }},
    {"implicit", [](nlohmann::json& scene) { make_implicit(scene); }},
    {"implicit_list",  // with multigrid, whose levels are made anew where the run goes on
     [](nlohmann::json& scene) {
       scene["pipeline"][lattice_stage]["type"] = "lattices.random";
       make_implicit(scene);
       scene["pipeline"][4]["preconditioner"] = "multigrid";
     }},
};

}  // namespace hyperlattice::test
