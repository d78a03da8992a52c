// One PNG picture of the particles per frame, drawn without a screen. The body is whole or cut
// open, and coloured by a field or by failure: a particle with an open failure is red, with closed
// failures only green, and without broken springs blue.
#include "legend.hpp"
#include "png.hpp"
#include "render.hpp"

#include <picture/colourings.hpp>
#include <picture/drawn_particles.hpp>

#include <hyperlattice/frames.hpp>

#include <functional>

namespace hyperlattice {
namespace {

using namespace picture;

constexpr std::string_view forms[] = {"cubes", "spheres"};

std::string time_text(double time) {
  const bool micro = time < 1e-3, milli = time < 1;
  return "t = " +
         short_number(time * (micro   ? 1e6
                              : milli ? 1e3
                                      : 1),
                      4) +
         (micro   ? " us"
          : milli ? " ms"
                  : " s");
}

class Picture {
 public:
  struct Options {
    std::string file;
    RegionId region;
    std::optional<RegionId> cut;
    std::optional<std::string> colour_by;
    std::optional<std::vector<double>> range;
    Vec3 view;
    Projector camera = Projector::orthographic;
    Fit fit = Fit::rest;
    Form particles = Form::cubes;
    double scale = 1;
    int width = 0, height = 0;
  };

  static Schema<Options> schema() {
    return Schema<Options>("writers.picture",
                           "A picture of the particles a frame, as PNG, drawn without a screen")
        .add<&Options::file>("file", "", "base name of the files")
        .fallback("\"picture\"")
        .add<&Options::region>("region", "", "particles to draw")
        .fallback("\"all\"")
        .add<&Options::cut>("cut", "",
                            "particles to take away, so that the inside is seen; left out: none")
        .add<&Options::colour_by>("colour_by", "",
                                  "failure (blue intact, red open, green closed) or a field; left "
                                  "out: failure if springs can break, "
                                  "else displacement")
        .choices(colourings())
        .plugin_fields()
        .add<&Options::range>(
            "range", "",
            "least and greatest value of the colours, SI; left out: those of each frame")
        .add<&Options::view>("view", "", "direction from the body to the eye; z is up")
        .fallback("[1, -1.4, 0.9]")
        .add<&Options::camera>("camera", "", "whether far things look smaller")
        .choices(projector_names)
        .fallback("\"orthographic\"")
        .add<&Options::fit>(
            "fit", "",
            "what fills the picture: rest: the body at rest, seen from one place in all frames, so "
            "that motion is seen as such; "
            "frame: the body as it is drawn in each frame, however far it has moved")
        .choices(fit_names)
        .fallback("\"rest\"")
        .add<&Options::particles>("particles", "", "how a particle is drawn")
        .choices(forms)
        .fallback("\"cubes\"")
        .add<&Options::scale>("scale", "", "displacements are drawn this many times as large")
        .fallback("1")
        .at_least(0)
        .add<&Options::width>("width", "", "pixels")
        .fallback("1000")
        .at_least(64)
        .at_most(8192)
        .add<&Options::height>("height", "", "pixels")
        .fallback("1000")
        .at_least(64)
        .at_most(8192)
        .check([](const Options& options, const FaultSink& faults) {
          check_file_name(options.file, faults);
          if (options.view == Vec3{}) faults.fault("view", "a direction that is not zero");
          check_range(options.range, faults);
        });
  }

  explicit Picture(const Options& options) : options_(options) {}

  void begin(const OutputContext& context) {
    title_ = context.title;
    files_ = FrameFiles(context, options_.file, ".png");
    drawn_ = Selection(drawn_particles(context, options_.region, options_.cut));
    whole_ = Selection(context.particles(options_.region));
    if (!options_.colour_by && !context.fields.empty())
      options_.colour_by = usual_colouring(context.fields);
    if (!options_.colour_by) return;
    if (options_.scale != 0) require_field(context, "displacement");
    if (*options_.colour_by != failure)
      return require_field(context, quantity_of(*options_.colour_by).field);
    require_field(context, "broken_open");
    require_field(context, "broken_closed");
  }

  void frame(const Snapshot& snapshot) {
    if (Field field; !options_.colour_by)
      options_.colour_by = snapshot.field("broken_open", field) ? failure : "displacement";
    Image image(options_.width, options_.height);
    std::vector<double> buffer;
    if (!camera_ || options_.fit == Fit::frame) {
      const auto shown = options_.fit == Fit::frame
                             ? whole_.positions(snapshot, options_.scale, buffer)
                             : whole_.of(snapshot.positions, 3, buffer);
      const double border = 0.04 * image.width, foot = legend_height(image.width);
      camera_ =
          make_camera(shown, snapshot.spacing, options_.view, options_.camera,
                      {border, border, image.width - 2 * border, image.height - border - foot});
    }
    const Colouring colouring =
        *options_.colour_by == failure ? colour_by_failure(snapshot) : colour_by_field(snapshot);
    render({drawn_.positions(snapshot, options_.scale, buffer), colouring.colours, snapshot.spacing,
            options_.particles},
           *camera_, image);
    colouring.draw_legend(image);
    const int border = image.width / 40;
    write_text(image, border, border, time_text(snapshot.time));
    std::string exact_time;
    append_number(exact_time, snapshot.time);
    const Notes notes{{"Title", title_},
                      {"Software", "Hyperlattice"},
                      {"Step", std::to_string(snapshot.step)},
                      {"Time", exact_time + " s"},
                      {"Colours", colouring.meaning}};
    write_file(files_.path(), encode_png(image, notes));
    files_.next();
  }

  void end() {}

  /// Returns the bytes of the image and of its drawing, and of the particles' places and colours.
  double memory_bytes() const noexcept {
    const double pixels = static_cast<double>(options_.width) * options_.height,
                 particles = static_cast<double>(drawn_.size());
    return pixels * sizeof(Colour) + particles * (3 * sizeof(double) + sizeof(Colour)) +
           render_bytes(pixels, particles);
  }

 private:
  struct Colouring {
    std::vector<Colour> colours;  ///< one for each particle in the picture
    std::string meaning;
    std::function<void(Image&)> draw_legend;
  };

  Colouring colour_by_failure(const Snapshot& snapshot) const {
    const auto open = require_field(snapshot, "broken_open").values,
               closed = require_field(snapshot, "broken_closed").values;
    Colouring colouring;
    for (std::size_t n = 0; n < drawn_.size(); ++n) {
      const Particle particle = drawn_[n];
      colouring.colours.push_back(open[particle] > 0     ? open_failure
                                  : closed[particle] > 0 ? closed_failure
                                                         : intact);
    }
    colouring.meaning = "blue intact, red open failure, green closed failure";
    colouring.draw_legend = [](Image& image) {
      draw_keys(
          image,
          {{intact, "intact"}, {open_failure, "open failure"}, {closed_failure, "closed failure"}});
    };
    return colouring;
  }

  Colouring colour_by_field(const Snapshot& snapshot) const {
    const Quantity quantity(quantity_of(*options_.colour_by));
    const Field field = require_field(snapshot, quantity.field());
    std::vector<double> values(drawn_.size());
    for (std::size_t n = 0; n < drawn_.size(); ++n)
      quantity.evaluate(snapshot, field, drawn_[n], &values[n]);
    const NumberRange range = options_.range
                                  ? NumberRange{options_.range->front(), options_.range->back()}
                                  : range_of(values);
    Colouring colouring;
    for (const double value : values)
      colouring.colours.push_back(std::isfinite(value) ? viridis(share_of(value, range))
                                                       : no_value);
    std::string name = quantity.names().front();
    std::replace(name.begin(), name.end(), '_', ' ');
    const FieldInfo* field_info = find_field(quantity.field());
    if (field_info != nullptr && !field_info->unit.empty())
      name += " (" + std::string(field_info->unit) + ")";
    colouring.meaning =
        name + " from " + short_number(range.low) + " to " + short_number(range.high);
    if (!std::all_of(values.begin(), values.end(),
                     [](double value) { return std::isfinite(value); }))
      colouring.meaning += ", grey without a value";
    colouring.draw_legend = [range, name](Image& image) {
      draw_scale(image, short_number(range.low, 4), short_number(range.high, 4), name);
    };
    return colouring;
  }

  Options options_;
  std::string title_;
  FrameFiles files_;
  Selection whole_, drawn_;
  std::optional<Camera> camera_;
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::Picture>(); }
