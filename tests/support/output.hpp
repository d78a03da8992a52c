// Writers and probes in a test: a plugin loaded as the host loads it, and a small body whose motion
// is known.
#pragma once

#include <hyperlattice/output.hpp>

#include <dlfcn.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <deque>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace hyperlattice::test {

inline Complaint complaint_into(std::string& sentence) {
  return {&sentence, [](void* self, std::string_view text) noexcept {
            static_cast<std::string*>(self)->assign(text);
          }};
}

/// A component from a plugin of the build. Each option takes its value from `settings`, or else its
/// fallback. Throws the complaint of the plugin.
class Plugin {
 public:
  explicit Plugin(const std::string& type,
                  const nlohmann::json& settings = nlohmann::json::object()) {
    const std::string path = std::string(HYPERLATTICE_BUILD) + "/lib/hyperlattice/" + type + ".so";
    void* library = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) throw std::runtime_error(dlerror());
    const auto* plugin = static_cast<const PluginInfo*>(dlsym(library, "hyperlattice_plugin"));
    if (plugin == nullptr) throw std::runtime_error(path + " is no plugin");
    Registrar registrar(this, [](void* self, const ComponentInfo& info) noexcept {
      static_cast<Plugin*>(self)->info_ = info;
    });
    call([&](const Complaint& why) { return plugin->register_components(registrar, why); });
    call([&](const Complaint& why) { return (options_ = info_.create_options(why)) != nullptr; });
    for (const Option& option : info_.options) set(option, settings);
    const FaultSink sink{
        this, [](void* self, std::string_view option, std::string_view expected) noexcept {
          static_cast<Plugin*>(self)->faults_.push_back(std::string(option) + ": " +
                                                        std::string(expected));
        }};
    if (info_.check_options != nullptr)
      call([&](const Complaint& why) { return info_.check_options(options_, sink, why); });
    if (faults_.empty())
      call([&](const Complaint& why) {
        return (component_ = info_.create(options_, why)) != nullptr;
      });
  }
  Plugin(const Plugin&) = delete;
  Plugin& operator=(const Plugin&) = delete;
  ~Plugin() {
    if (component_ != nullptr) info_.destroy(component_);
    info_.destroy_options(options_);
  }

  const std::vector<std::string>& faults() const {
    return faults_;
  }  ///< faults of the cross-field check; if any exist, no component was made

  void begin(const OutputContext& context) {
    call([&](const Complaint& why) {
      return functions<WriterFunctions>().begin(component_, context, why);
    });
  }
  double memory_bytes() { return functions<WriterFunctions>().memory(component_); }
  void frame(const Snapshot& snapshot) {
    call([&](const Complaint& why) {
      return functions<WriterFunctions>().frame(component_, snapshot, why);
    });
  }
  void end() {
    call([&](const Complaint& why) { return functions<WriterFunctions>().end(component_, why); });
  }
  std::vector<std::string> begin_probe(const OutputContext& context, const Snapshot& first) {
    std::vector<std::string> columns;
    const ColumnSink sink{&columns, [](void* self, std::string_view name) noexcept {
                            static_cast<std::vector<std::string>*>(self)->emplace_back(name);
                          }};
    call([&](const Complaint& why) {
      return functions<ProbeFunctions>().begin(component_, context, first, sink, why);
    });
    return columns;
  }
  std::vector<double> sample(const Snapshot& snapshot, std::size_t columns) {
    std::vector<double> row(columns, std::numeric_limits<double>::quiet_NaN());
    call([&](const Complaint& why) {
      return functions<ProbeFunctions>().sample(component_, snapshot, row.data(), why);
    });
    return row;
  }

 private:
  template <class Functions>
  const Functions& functions() const {
    return *static_cast<const Functions*>(info_.functions);
  }

  template <class Call>
  static void call(Call&& function) {
    std::string sentence;
    if (!function(complaint_into(sentence))) throw std::runtime_error(sentence);
  }

  void set(const Option& option, const nlohmann::json& settings) {
    nlohmann::json value;
    if (const std::string name(option.name); settings.contains(name))
      value = settings.at(name);
    else if (!option.fallback.empty())
      value = nlohmann::json::parse(option.fallback);
    OptionValue out;
    std::vector<std::string_view> views;
    out.absent = value.is_null();
    if (value.is_boolean()) out.boolean = value.get<bool>();
    if (value.is_number_integer()) out.integer = value.get<std::int64_t>();
    if (value.is_number()) out.number = value.get<double>();
    if (value.is_string()) {
      out.text = texts_.emplace_back(value.get<std::string>());
      for (std::size_t n = 0; n < option.choices.size(); ++n)
        if (option.choices[n] == out.text) out.integer = static_cast<std::int64_t>(n);
      if (option.kind == OptionKind::region) out.region.index = out.text == "all" ? 0 : 1;
      if (option.kind == OptionKind::load_or_region)
        out.load_or_region.region.index = out.text == "all" ? 0 : 1;
    }
    if (value.is_array() && option.kind == OptionKind::texts) {
      for (const auto& text : value) views.push_back(texts_.emplace_back(text.get<std::string>()));
      out.texts = views;
    } else if (value.is_array()) {
      out.numbers = numbers_.emplace_back(value.get<std::vector<double>>());
    }
    call([&](const Complaint& why) { return option.set(options_, out, why); });
  }

  ComponentInfo info_;
  void* options_ = nullptr;
  void* component_ = nullptr;
  std::deque<std::string> texts_;
  std::deque<std::vector<double>> numbers_;
  std::vector<std::string> faults_;
};

/// A block of nx * ny * nz particles that moves by u(x, t) = t (x - c) + t^2 (y, z, x), without
/// heights. Region 0 holds all particles, any other region every third one. Each fifth particle has
/// a crack towards the next one; each second of these faces belongs to a diagonal.
class FakeBody {
 public:
  explicit FakeBody(std::array<int, 3> counts, double spacing = 1e-3) : spacing_(spacing) {
    for (int k = 0; k < counts[2]; ++k)
      for (int j = 0; j < counts[1]; ++j)
        for (int i = 0; i < counts[0]; ++i)
          for (const int index : {i, j, k}) positions_.push_back((index + 0.5) * spacing);
    for (Particle n = 0; n < positions_.size() / 3; ++n) {
      all_.push_back(n);
      if (n % 3 == 1) some_.push_back(n);
    }
  }

  /// The context is valid as long as the text of `directory`.
  OutputContext context(std::string_view directory) {
    OutputContext context;
    context.directory = directory;
    context.title = "a fake body";
    context.self = this;
    context.region_particles = [](void* self,
                                  RegionId region) noexcept -> std::span<const Particle> {
      const auto& body = *static_cast<FakeBody*>(self);
      return region.index == 0 ? body.all_ : body.some_;
    };
    return context;
  }

  /// The snapshot is valid until the next call.
  Snapshot at(double time) {
    displacements.resize(positions_.size());
    velocities.resize(positions_.size());
    open.assign(all_.size(), 0);
    closed.assign(all_.size(), 0);
    faces.clear();
    for (std::size_t n = 0; n < all_.size(); ++n) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double x = positions_[3 * n + axis], next = positions_[3 * n + (axis + 1) % 3];
        displacements[3 * n + axis] = time * (x - spacing_) + time * time * next;
        velocities[3 * n + axis] = x - spacing_ + 2 * time * next;
      }
      if (n % 5 == 0 && n + 1 < all_.size()) add_face(n);
      if (n % 5 == 0) open[n] = 1 + static_cast<double>(n % 3);
      if (n % 10 == 0) closed[n] = 1;
    }
    Snapshot snapshot;
    snapshot.time = time;
    snapshot.step = step_++;
    snapshot.particles = all_.size();
    snapshot.spacing = spacing_;
    snapshot.positions = positions_;
    snapshot.self = this;
    snapshot.get_field = [](void* self, std::string_view name, Field& field) noexcept {
      auto& body = *static_cast<FakeBody*>(self);
      if (name == "displacement")
        field = {3, body.displacements};
      else if (name == "velocity")
        field = {3, body.velocities};
      else if (name == "broken_open")
        field = {1, body.open};
      else if (name == "broken_closed")
        field = {1, body.closed};
      else
        return false;
      return true;
    };
    snapshot.get_crack_faces = [](void* self, double) noexcept {
      return std::span<const CrackFace>(static_cast<FakeBody*>(self)->faces);
    };
    return snapshot;
  }

  std::vector<double>& positions() { return positions_; }
  const std::vector<Particle>& some() const { return some_; }

  std::vector<double> displacements, velocities, open, closed;
  std::vector<CrackFace> faces;

 private:
  void add_face(Particle n) {
    CrackFace face;
    face.a = n;
    face.b = n + 1;
    face.spring_class = n % 2;
    face.damage = 1;
    face.area = face.spring_class == 0 ? spacing_ * spacing_ : 0;
    faces.push_back(face);
  }

  double spacing_;
  std::uint64_t step_ = 0;
  std::vector<double> positions_;
  std::vector<Particle> all_, some_;
};

/// A temporary folder; the destructor removes it.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_((std::filesystem::temp_directory_path() /
               ("hyperlattice_" + name + std::to_string(getpid())))
                  .string()) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }

  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }
  std::vector<std::string> names() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
  }

 private:
  std::string path_;
};

inline std::string contents(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace hyperlattice::test
