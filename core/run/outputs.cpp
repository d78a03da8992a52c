#include <plan/columns.hpp>
#include <plan/fields.hpp>
#include <plan/plan.hpp>
#include <plan/writer_warning.hpp>
#include <run/outputs.hpp>
#include <scene/stage_call.hpp>
#include <state/archive.hpp>
#include <state/crack_faces.hpp>
#include <state/force_sums.hpp>

#include <spdlog/spdlog.h>

#include <algorithm>
#include <system_error>

namespace hyperlattice {

Outputs::Outputs(const Plan& plan, Simulation& simulation, RunFolder& folder, Ranks& ranks)
    : plan_(plan),
      model_(*plan.model),
      simulation_(simulation),
      source_(model_, simulation),
      folder_(folder),
      ranks_(ranks),
      fields_(fields_of(model_)),
      regions_(model_.body, model_.scene->regions),
      acted_(model_, regions_) {
  for (const Family family : {Family::writers, Family::probes})
    for (const Stage* stage : model_.scene->of(family)) {
      Output& output = outputs_.emplace_back();
      output.owner = this;
      output.stage = stage;
      const double start = plan.start_time();
      output.schedule =
          Schedule(start, output_interval(*stage, plan.end_time() - start), stage->cadence.first);
    }
}

void Outputs::archive(Archive& archive) {
  for (Output& output : outputs_) {
    archive(output.schedule);
    archive(output.shown);
  }
}

void Outputs::begin() {
  if (outputs_.empty()) return;
  share_needs();
  std::vector<Output*> all;
  for (Output& output : outputs_) all.push_back(&output);
  bring_state(all);
  if (!ranks_.is_first()) return source_.renew();
  const Ranks::Solo solo(ranks_);
  for (Output& output : outputs_) begin(output);
  cut_faces_ = {};
  source_.renew();
  const bool any = std::any_of(outputs_.begin(), outputs_.end(), [](const Output& output) {
    return output.table == nullptr && !output.fields.empty();
  });
  if (!any || plan_.threads == 1) return;
  try {
    queue_.emplace(model_, plan_.threads);
  } catch (const OutsideError& error) {
    spdlog::info("frames are written between the steps: {}", error.what());
  } catch (const std::system_error& error) {
    spdlog::info("frames are written between the steps: {}", error.what());
  }
}

/// Lets every rank know what each output needs of the state. The first rank knows it from the plan.
void Outputs::share_needs() {
  if (ranks_.is_alone()) return;
  using Motion = Simulation::Motion;
  static constexpr std::pair<const char*, Motion> names[] = {{"displacement", Motion::displacement},
                                                             {"velocity", Motion::velocity},
                                                             {"height", Motion::height}};
  constexpr std::uint8_t state_bit = 1U << 7;
  std::vector<std::uint8_t> bits;
  for (const Output& output : outputs_) {
    std::uint8_t& of = bits.emplace_back(state_bit);
    const auto needs = plan_.needs.find(output.stage);
    if (needs == plan_.needs.end() || needs->second.state) continue;
    of = 0;
    for (const auto& [name, motion] : names)
      if (needs->second.fields.contains(name))
        of = static_cast<std::uint8_t>(of | 1U << static_cast<unsigned>(motion));
  }
  ranks_.meet(Ranks::Meeting::state);
  ranks_.spread(0, std::as_writable_bytes(std::span(bits)));
  auto of = bits.begin();
  for (Output& output : outputs_) {
    output.needs_state = (*of & state_bit) != 0;
    for (const auto& [name, motion] : names)
      if ((*of >> static_cast<unsigned>(motion) & 1U) != 0) output.motions.insert(motion);
    ++of;
  }
}

/// Brings to the first rank what these outputs need. All ranks must call it.
void Outputs::bring_state(const std::vector<Output*>& shown) {
  if (ranks_.is_alone()) return;
  if (std::any_of(shown.begin(), shown.end(), [](const Output* one) { return one->needs_state; }))
    return simulation_.gather_in_first();
  std::set<Simulation::Motion> motions;
  for (const Output* one : shown) motions.insert(one->motions.begin(), one->motions.end());
  source_.collect(motions);
}

void Outputs::begin(Output& output) {
  const Stage& stage = *output.stage;
  output.component = make_component(stage);
  const std::string type = stage.component->type();
  const bool is_labelled =
      stage.name !=
      type.substr(type.find('.') + 1);  // two writers of a type must not share their files
  output.name = output.is_probe() ? "probes" : is_labelled ? stage.name : "";
  output.directory =
      (output.name.empty() ? folder_.directory() : folder_.subfolder(output.name)).string();
  const OutputContext context = context_of(output);
  if (!output.is_probe()) {
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
    return PluginCall::answer(std::span<const Particle>(), [&] {
      return static_cast<Output*>(self)->owner->acted_.particles(of);
    });
  };
  context.external_forces = [](void* self, LoadOrRegion of) noexcept {
    return PluginCall::answer(ForcesId(), [&] {
      auto& outputs = *static_cast<Output*>(self)->owner;
      outputs.source_.must_have_state("forces");
      const std::span<const Particle> particles = outputs.acted_.particles(of);  // checks it
      return of.is_load()
                 ? outputs.simulation_.force_sums().follow(static_cast<std::size_t>(of.load))
                 : outputs.simulation_.force_sums().follow(particles);
    });
  };
  context.cut_section = [](void* self, Vec3 point, Vec3 normal, RegionId region) noexcept {
    return PluginCall::answer(Section(), [&] {
      auto& outputs = *static_cast<Output*>(self)->owner;
      outputs.source_.must_have_state("the forces through a section");
      const PlaneSection section =
          cut(outputs.model_, point, normal, outputs.regions_.particles(region));
      return Section{outputs.simulation_.force_sums().follow(section), section.springs.size(),
                     section.area};
    });
  };
}

OutputContext Outputs::context_of(Output& output) const {
  OutputContext context;
  context.directory = output.directory;
  context.title = model_.scene->title;
  context.fields = fields_;
  context.earlier = output.shown;
  context.self = &output;
  context.region_particles = [](void* self, RegionId region) noexcept {
    return PluginCall::answer(std::span<const Particle>(), [&] {
      return static_cast<Output*>(self)->owner->regions_.particles(region);
    });
  };
  context.announce_file = [](void* self, std::string_view file, bool rewritten) noexcept {
    return PluginCall::answer(false, [&] {
      const Output& writer = *static_cast<Output*>(self);
      writer.owner->announce(writer, file, rewritten);
      return true;
    });
  };
  context.get_cut_faces = [](void* self) noexcept {
    return PluginCall::answer(std::span<const CrackFace>(), [&] {
      auto& owner = *static_cast<Output*>(self)->owner;
      if (owner.cut_faces_.empty()) owner.cut_faces_ = cut_faces(owner.model_);
      return std::span<const CrackFace>(owner.cut_faces_);
    });
  };
  context.use_field = [](void* self, std::string_view name) noexcept {
    PluginCall::answer([&] {
      auto& writer = *static_cast<Output*>(self);
      if (has_field(writer.owner->model_, name)) writer.fields.emplace(name);
    });
  };
  context.receive_warning = [](void* self, std::string_view sentence) noexcept {
    PluginCall::answer([&] {
      const Output& writer = *static_cast<Output*>(self);
      writer.owner->warn(writer, sentence);
    });
  };
  offer_forces(context);
  return context;
}

void Outputs::announce(const Output& output, std::string_view file, bool rewritten) {
  if (!output.is_writing) throw PluginMistake("it announced a file when it was not asked to write");
  folder_.claim(output.name.empty() ? std::string(file) : fmt::format("{}/{}", output.name, file),
                rewritten);
}

/// The plan has told the warnings of begin().
void Outputs::warn(const Output& output, std::string_view sentence) {
  if (!output.is_writing) return;
  const std::lock_guard lock(warnings_mutex_);
  if (warnings_.size() >= most_writer_warnings) return;
  warnings_.push_back(writer_warning(*output.stage, sentence));
  spdlog::warn("warning: {}", warnings_.back());
}

std::vector<std::string> Outputs::warnings() const {
  const std::lock_guard lock(warnings_mutex_);
  return warnings_;
}

void Outputs::show(double time_step) {
  if (queue_) queue_->check();
  std::vector<Output*> due;
  for (Output& output : outputs_)
    if (output.schedule.due(simulation_.time(), time_step)) due.push_back(&output);
  show_to(due);
}

void Outputs::show_now() {
  std::vector<Output*> due;
  for (Output& output : outputs_)
    if (!has_seen_this(output)) due.push_back(&output);
  show_to(due);
}

void Outputs::show_last() {
  std::vector<Output*> due;
  for (Output& output : outputs_)
    if (output.stage->cadence.last && !has_seen_this(output)) due.push_back(&output);
  show_to(due);
}

/// Shows the present state to outputs. All ranks bring it up to date, and the first one shows it.
void Outputs::show_to(const std::vector<Output*>& due) {
  if (due.empty()) return;
  bring_state(due);
  if (ranks_.is_first()) {
    const Ranks::Solo solo(ranks_);
    show_here(due);
  } else {
    source_.renew();
  }
  for (Output* output : due) {
    if (output->is_probe()) output->shown.clear();
    output->shown.push_back({simulation_.steps(), simulation_.time()});
  }
}

void Outputs::show_here(const std::vector<Output*>& due) {
  const Snapshot& snapshot = source_.take();
  std::vector<Output*> queued;
  FieldNames fields;
  for (Output* output : due) {
    if (output->is_probe()) {
      sample(*output, snapshot);
    } else if (!queue_ || output->fields.empty()) {
      write(*output, snapshot);
    } else {
      queued.push_back(output);
      fields.insert(output->fields.begin(), output->fields.end());
    }
  }
  if (!queued.empty())
    queue_->put(source_, fields, [queued](const Snapshot& copy) {
      for (Output* output : queued) write(*output, copy);
    });
  source_.renew();
}

void Outputs::sample(Output& probe, const Snapshot& snapshot) {
  call(*probe.stage, "sample", [&](const Complaint& why) {
    return probe.stage->functions<ProbeFunctions>().sample(probe.component.get(), snapshot,
                                                           probe.row.data() + 1, why);
  });
  probe.row[0] = snapshot.time;
  probe.table->row(probe.row);
}

void Outputs::write(Output& writer, const Snapshot& snapshot) {
  writer.is_writing = true;
  call(*writer.stage, "frame", [&](const Complaint& why) {
    return writer.stage->functions<WriterFunctions>().frame(writer.component.get(), snapshot, why);
  });
}

void Outputs::drain() {
  if (queue_) queue_->drain();
}

void Outputs::end() {
  if (!ranks_.is_first()) return;
  const Ranks::Solo solo(ranks_);
  drain();
  for (Output& output : outputs_) {
    if (output.is_probe()) continue;
    output.is_writing = true;
    call(*output.stage, "end", [&](const Complaint& why) {
      return output.stage->functions<WriterFunctions>().end(output.component.get(), why);
    });
  }
}

}  // namespace hyperlattice
