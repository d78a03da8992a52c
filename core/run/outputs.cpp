#include <plan/columns.hpp>
#include <plan/fields.hpp>
#include <plan/plan.hpp>
#include <run/outputs.hpp>
#include <scene/stage_call.hpp>
#include <state/archive.hpp>
#include <state/force_sums.hpp>

#include <spdlog/fmt/fmt.h>

namespace hyperlattice {

Outputs::Outputs(const Model& model, Simulation& simulation, RunFolder& folder, double end_time)
    : model_(model),
      simulation_(simulation),
      source_(model, simulation),
      folder_(folder),
      regions_(model.body, model.scene->regions),
      acted_(model, regions_) {
  for (const std::string_view name : field_names)
    if (has_field(model, name)) fields_.push_back(name);
  for (const Family family : {Family::writers, Family::probes})
    for (const Stage* stage : model.scene->of(family)) {
      Output& output = outputs_.emplace_back();
      output.stage = stage;
      output.schedule = Schedule(0, output_interval(*stage, end_time), stage->cadence.first);
    }
}

void Outputs::archive(Archive& archive) {
  for (Output& output : outputs_) {
    archive(output.schedule);
    archive(output.shown);
  }
}

void Outputs::begin() {
  for (Output& output : outputs_) begin(output);
  source_.renew();
}

void Outputs::begin(Output& output) {
  const Stage& stage = *output.stage;
  output.component = make_component(stage);
  const bool is_probe = stage.family() == Family::probes;
  const std::string type = stage.component->type();
  const bool is_labelled =
      stage.name !=
      type.substr(type.find('.') + 1);  // two writers of a type must not share their files
  output.name = is_probe ? "probes" : is_labelled ? stage.name : "";
  output.directory =
      (output.name.empty() ? folder_.directory() : folder_.subfolder(output.name)).string();
  OutputContext context;
  context.directory = output.directory;
  context.title = model_.scene->title;
  context.fields = fields_;
  context.earlier = output.shown;
  context.self = this;
  context.region_particles = [](void* self, RegionId region) noexcept {
    return PluginCall::answer(std::span<const Particle>(), [&] {
      return static_cast<Outputs*>(self)->regions_.particles(region);
    });
  };
  context.announce_file = [](void* self, std::string_view file, bool rewritten) noexcept {
    return PluginCall::answer(false, [&] {
      static_cast<Outputs*>(self)->announce(file, rewritten);
      return true;
    });
  };
  offer_forces(context);
  if (!is_probe) {
    call(stage, "begin", [&](const Complaint& why) {
      return stage.functions<WriterFunctions>().begin(output.component.get(), context, why);
    });
    return;
  }
  std::vector<std::string> columns{"time"};
  const ColumnSink sink = columns_into(columns);
  call(stage, "begin", [&](const Complaint& why) {
    return stage.functions<ProbeFunctions>().begin(output.component.get(), context, source_.take(),
                                                   sink, why);
  });
  output.row.resize(columns.size());
  output.table = &folder_.table("probes/" + stage.name + ".csv", columns);
}

/// Sets the functions by which a probe asks for forces.
void Outputs::offer_forces(OutputContext& context) {
  context.acted_particles = [](void* self, LoadOrRegion of) noexcept {
    return PluginCall::answer(std::span<const Particle>(),
                              [&] { return static_cast<Outputs*>(self)->acted_.particles(of); });
  };
  context.external_forces = [](void* self, LoadOrRegion of) noexcept {
    return PluginCall::answer(ForcesId(), [&] {
      auto& outputs = *static_cast<Outputs*>(self);
      const std::span<const Particle> particles = outputs.acted_.particles(of);  // checks it
      return of.is_load()
                 ? outputs.simulation_.force_sums().follow(static_cast<std::size_t>(of.load))
                 : outputs.simulation_.force_sums().follow(particles);
    });
  };
  context.cut_section = [](void* self, Vec3 point, Vec3 normal, RegionId region) noexcept {
    return PluginCall::answer(Section(), [&] {
      auto& outputs = *static_cast<Outputs*>(self);
      const PlaneSection section =
          cut(outputs.model_, point, normal, outputs.regions_.particles(region));
      return Section{outputs.simulation_.force_sums().follow(section), section.springs.size(),
                     section.area};
    });
  };
}

void Outputs::announce(std::string_view file, bool rewritten) {
  if (writing_ == nullptr)
    throw PluginMistake("it announced a file when it was not asked to write");
  folder_.claim(
      writing_->name.empty() ? std::string(file) : fmt::format("{}/{}", writing_->name, file),
      rewritten);
}

void Outputs::show(double time_step) {
  for (Output& output : outputs_)
    if (output.schedule.due(simulation_.time(), time_step)) show_to(output);
  source_.renew();
}

void Outputs::show_now() {
  for (Output& output : outputs_)
    if (!has_seen_this(output)) show_to(output);
  source_.renew();
}

void Outputs::show_last() {
  for (Output& output : outputs_)
    if (output.stage->cadence.last && !has_seen_this(output)) show_to(output);
  source_.renew();
}

void Outputs::show_to(Output& output) {
  const Snapshot& snapshot = source_.take();
  const Stage& stage = *output.stage;
  writing_ = &output;
  call(stage, output.table != nullptr ? "sample" : "frame", [&](const Complaint& why) {
    return output.table != nullptr
               ? stage.functions<ProbeFunctions>().sample(output.component.get(), snapshot,
                                                          output.row.data() + 1, why)
               : stage.functions<WriterFunctions>().frame(output.component.get(), snapshot, why);
  });
  if (output.table != nullptr) output.shown.clear();
  output.shown.push_back({snapshot.step, snapshot.time});
  if (output.table == nullptr) return;
  output.row[0] = snapshot.time;
  output.table->row(output.row);
}

void Outputs::end() {
  for (Output& output : outputs_) {
    if (output.table != nullptr) continue;
    writing_ = &output;
    call(*output.stage, "end", [&](const Complaint& why) {
      return output.stage->functions<WriterFunctions>().end(output.component.get(), why);
    });
  }
}

}  // namespace hyperlattice
