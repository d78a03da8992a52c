// A catalogue of components that declare options of every kind and do nothing else. Tests of the
// reading and the documentation of scenes use it.
#pragma once

#include <base/option_set.hpp>
#include <scene/scene_reader.hpp>

#include <map>

namespace fakes {

using namespace hyperlattice;

struct Grid {
  struct Options {
    double spacing = 0;
    const Shape* shape = nullptr;
    std::string boundary;
    std::optional<Vec3> anchor;
  };
  static Schema<Options> schema() {
    static constexpr std::string_view boundaries[] = {"particles", "cells"};
    return Schema<Options>("lattices.grid", "Points of a grid")
        .add<&Options::spacing>("spacing", "m", "lattice constant")
        .positive()
        .add<&Options::shape>("shape", "", "solid to fill")
        .formerly("solid", "0.9")
        .add<&Options::boundary>("boundary", "", "how the surface counts")
        .choices(boundaries)
        .fallback("\"particles\"")
        .add<&Options::anchor>("anchor", "m", "corner of a cell; the shape's own if auto")
        .word("auto")
        .fallback("\"auto\"");
  }
};

struct Spring {
  enum class Law { linear, cubic };
  struct Options {
    double young = 0, poisson = 0, density = 0;
    Law law = Law::linear;
  };
  static Schema<Options> schema() {
    static constexpr std::string_view laws[] = {"linear", "cubic"};
    return Schema<Options>("materials.spring", "Linear springs")
        .equation("f = k s")
        .source("the paper, eq. (2)")
        .restrictions("poisson up to 1/4")
        .add<&Options::young>("young", "Pa", "Young's modulus")
        .positive()
        .add<&Options::poisson>("poisson", "", "Poisson's ratio")
        .formerly("nu", "0.9")
        .above(-1)
        .at_most(0.25)
        .add<&Options::density>("density", "kg/m3", "mass by volume")
        .positive()
        .add<&Options::law>("law", "", "force by elongation")
        .choices(laws)
        .fallback("\"linear\"")
        .check([](const Options& options, const FaultSink& faults) {
          if (options.law == Law::cubic && options.poisson < 0)
            faults.fault("poisson", "no negative ratio with the cubic law");
        });
  }
};

struct Limit {
  struct Options {
    double limit = 0;
  };
  static Schema<Options> schema() {
    return Schema<Options>("failures.limit", "Breaks above an elongation")
        .add<&Options::limit>("limit", "m", "largest elongation")
        .positive();
  }
};

struct Push {
  struct Options {
    RegionId on;
    Vec3 force;
    std::vector<double> times;
    std::int32_t repeats = 0;
    bool follow = false;
    float scale = 0;
  };
  static Schema<Options> schema() {
    return Schema<Options>("loads.push", "A force")
        .add<&Options::on>("on", "", "where")
        .fallback("\"surface\"")
        .add<&Options::force>("force", "N", "sum over the region")
        .fallback("[0, 0, \"1 kN\"]")
        .add<&Options::times>("times", "s", "when")
        .at_least(0)
        .fallback("[]")
        .add<&Options::repeats>("repeats", "", "how often")
        .formerly("count", "0.9")
        .at_least(1)
        .at_most(100)
        .fallback("1")
        .add<&Options::follow>("follow", "", "whether it turns with the body")
        .fallback("false")
        .add<&Options::scale>("scale", "", "factor")
        .fallback("1");
  }
};

struct March {
  struct Options {
    double end_time = 0;
    std::optional<double> time_step;
  };
  static Schema<Options> schema() {
    return Schema<Options>("solvers.march", "Steps in time")
        .add<&Options::end_time>("end_time", "s", "when it ends")
        .formerly("until", "0.8")
        .formerly("duration", "0.9")
        .positive()
        .add<&Options::time_step>("time_step", "s", "length of a step")
        .positive()
        .word("auto")
        .fallback("\"auto\"");
  }
};

struct Table {
  struct Options {
    std::vector<std::string> fields;
    std::string heading;
  };
  static Schema<Options> schema() {
    static constexpr std::string_view names[] = {"displacement", "velocity", "damage"};
    return Schema<Options>("writers.table", "A table")
        .add<&Options::fields>("fields", "", "what to write")
        .choices(names)
        .fallback("[\"displacement\"]")
        .add<&Options::heading>("heading", "", "first line")
        .fallback("\"\"");
  }
};

struct Spot {
  struct Options {
    std::optional<Vec3> point;
  };
  static Schema<Options> schema() {
    return Schema<Options>("probes.spot", "Motion of a point")
        .add<&Options::point>("point", "m", "where");
  }
};

class Catalogue final : public hyperlattice::Catalogue {
 public:
  Catalogue() {
    add<Grid>(Family::lattices);
    add<Spring>(Family::materials);
    add<Limit>(Family::failures);
    add<Push>(Family::loads);
    add<March>(Family::solvers);
    add<Table>(Family::writers);
    add<Spot>(Family::probes);
  }
  template <class Declared>
  void add(Family family) {
    static const auto schema = Declared::schema();
    const OptionSet set = option_set<Declared>();
    ComponentInfo info;
    info.family = family;
    info.name = schema.name();
    info.summary = schema.summary();
    info.equation = schema.equation();
    info.source = schema.source();
    info.restrictions = schema.restrictions();
    info.options = set.options;
    info.old_names = set.old_names;
    info.create_options = set.create;
    info.destroy_options = set.destroy;
    info.check_options = set.check;
    components_[std::string(info.name)] = {info, std::string(info.name), "1.0",
                                           "/nowhere/" + std::string(info.name) + ".so"};
  }
  std::vector<const Component*> all() const {
    std::vector<const Component*> found;
    for (const auto& [type, component] : components_) found.push_back(&component);
    return found;
  }
  bool scene_plugins = true;
  std::string refused_type;  ///< type whose library the catalogue reports as present but refused

  const Component* find(const std::string& type) override {
    return components_.count(type) == 0 ? nullptr : &components_.at(type);
  }
  std::string why_not(const std::string& type) const override {
    return refused(type) ? "wrong interface version" : "no library " + type + ".so";
  }
  bool refused(const std::string& type) const override { return type == refused_type; }
  bool allows_scene_plugins() const override { return scene_plugins; }
  std::vector<std::string> known_types() const override {
    std::vector<std::string> types;
    for (const auto& [type, component] : components_) types.push_back(type);
    return types;
  }
  std::vector<SearchOutcome> add_scene_paths(const std::vector<std::string>& entries,
                                             const std::filesystem::path& scene_folder) override {
    std::vector<SearchOutcome> outcomes;
    for (const std::string& entry : entries) {
      const auto path = (scene_folder / entry).lexically_normal();
      const bool there = std::filesystem::exists(path);
      outcomes.push_back({path, there, !there, ""});
    }
    return outcomes;
  }

 private:
  std::map<std::string, Component> components_;
};

}  // namespace fakes
