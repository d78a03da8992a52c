// Pictures of the deformed body for papers and talks: the cells of the particles as one surface,
// drawn by rays without a screen, with title, legend, scale bar and axes around it.
#include "appearance.hpp"
#include "body_surface.hpp"
#include "layout.hpp"
#include "movie.hpp"
#include "options.hpp"
#include "prefixes.hpp"
#include "trace.hpp"

#include <picture/drawn_particles.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

namespace hyperlattice {
namespace {

using namespace render;

class Render {
 public:
  using Options = render::Options;

  static Schema<Options> schema() { return options_schema(); }

  explicit Render(const Options& options) : options_(options), planes_(planes_of(options.clip)) {}

  /// Names no field to the run, so that frames may ask for the faces of cracks.
  void begin(const OutputContext& context) {
    directory_ = context.directory;
    title_ = options_.title ? *options_.title : std::string(context.title);
    const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' '; };
    std::replace_if(title_.begin(), title_.end(), is_control, ' ');
    files_ = FrameFiles(context, options_.file,
                        "." + std::string(format_names[static_cast<std::size_t>(options_.format)]));
    frames_ = context.earlier.size();
    drawn_ = picture::drawn_particles(context, options_.region, options_.cut);
    const auto cuts = context.cut_faces();
    cuts_.assign(cuts.begin(), cuts.end());
    check_fields(context);
    if (options_.movie == MovieKind::none) return;
    warn_ = [receive = context.receive_warning, run = context.self](std::string_view sentence) {
      if (receive != nullptr) receive(run, sentence);
    };
    maker_ = find_movie_maker(options_.movie);
    if (!maker_)
      warn_(options_.movie == MovieKind::mp4
                ? "no film is made, because ffmpeg is not installed; the frames are written"
                : "no film is made, because neither ffmpeg nor ImageMagick is installed; the "
                  "frames are written");
  }

  void frame(const Snapshot& snapshot) {
    if (grid_.empty()) {
      grid_ = BodyGrid(snapshot.cubes());
      corners_ = RestCorners(grid_, options_.smooth);
    }
    std::vector<bool> is_drawn(snapshot.particles, false);
    for (const Particle particle : drawn_) is_drawn[particle] = true;
    const auto faces = snapshot.crack_faces(options_.damage);
    BrokenPairs broken(snapshot.particles, faces.empty() && cuts_.empty()
                                               ? std::span<const double>()
                                               : snapshot.fragments(options_.damage));
    broken.add(cuts_);
    broken.add(faces);
    broken.sort();
    const std::vector<double> positions = positions_of(snapshot);
    DrawnBody body{snapshot, grid_, corners_, broken, is_drawn, positions, planes_};
    body.has_cracks = options_.opacity == 1 || options_.cracks;
    const Mesh mesh = surface_of(body);
    const std::vector<Line> lines =
        options_.springs ? lines_of(snapshot, faces, is_drawn, positions) : std::vector<Line>();
    draw(snapshot, mesh, lines, is_drawn);
    files_.next();
    ++frames_;
  }

  void end() {
    if (!maker_ || frames_ == 0) return;
    const std::string kind(movie_names[static_cast<std::size_t>(options_.movie)]);
    MovieFrames frames{directory_, options_.file + "_%06d.png", {}, options_.frame_rate};
    for (std::uint64_t n = 0; n < frames_; ++n) frames.names.push_back(files_.name(n));
    const std::string file = files_.path_of_series("." + kind);
    // The run is as good without its film.
    try {
      make_movie(*maker_, options_.movie, frames, file);
    } catch (const std::runtime_error& error) {
      warn_(error.what());
    }
  }

  /// Returns the bytes of the pixels and of a body whose surface is a tenth of its particles. The
  /// surface of a body with many cracks is larger; its size is not known before the run.
  double memory_bytes() const noexcept {
    constexpr double grid = 8 * 2 * 4;  // eight cubes a particle, in a grid half of which is empty
    constexpr double colours = 3, positions = 24, surface = 0.1 * 12 * 150;
    const double pixels = static_cast<double>(options_.width) * options_.height;
    return (16 + 4 * 2) * pixels +
           static_cast<double>(drawn_.size()) * (grid + colours + positions + surface);
  }

 private:
  void check_fields(const OutputContext& context) {
    if (context.fields.empty()) return;
    const auto check = [&](std::string_view name) {
      if (!is_one_of(context.fields, name)) refuse_field(name, context.fields);
    };
    if (!options_.colour_by) options_.colour_by = picture::usual_colouring(context.fields);
    check("displacement");
    if (*options_.colour_by != picture::failure)
      return check(picture::quantity_of(*options_.colour_by).field);
    check("broken_open");
    check("broken_closed");
  }

  std::vector<double> positions_of(const Snapshot& snapshot) const {
    std::vector<double> positions(snapshot.positions.begin(), snapshot.positions.end());
    if (options_.scale == 0) return positions;
    const auto displacement = require_field(snapshot, "displacement").values;
    for (std::size_t n = 0; n < positions.size(); ++n)
      positions[n] += options_.scale * displacement[n];
    return positions;
  }

  std::vector<Line> lines_of(const Snapshot& snapshot, std::span<const CrackFace> faces,
                             const std::vector<bool>& is_drawn,
                             std::span<const double> positions) const {
    const auto at = [&](Particle particle) {
      const double* x = &positions[3 * particle];
      return Vec3{x[0], x[1], x[2]};
    };
    std::vector<Line> lines;
    for (const CrackFace& face : faces) {
      if (!is_drawn[face.a] || !is_drawn[face.b]) continue;
      const Vec3 rest = position_of(snapshot, face.b) - position_of(snapshot, face.a),
                 from = at(face.a), to = at(face.b), middle = 0.5 * (from + to);
      const auto hides = [&](const ClipPlane& plane) { return plane.beyond(middle) > 0; };
      if (std::any_of(planes_.begin(), planes_.end(), hides)) continue;
      lines.push_back({from, to, norm(to - from) > norm(rest)});
    }
    return lines;
  }

  /// Returns the camera for the points of the surface, or for the body at rest.
  picture::Camera camera_for(const Snapshot& snapshot, const Mesh& mesh,
                             const picture::Frame& frame) const {
    std::vector<double> points;
    const auto is_finite = [&](const Triangle& triangle) {
      const Vec3 point = mesh.points[triangle.points[0]];
      return std::isfinite(point.x + point.y + point.z);
    };
    // A plane may have taken everything away.
    const bool rest = options_.fit == Fit::rest ||
                      std::none_of(mesh.triangles.begin(), mesh.triangles.end(), is_finite);
    if (rest)
      for (const Particle particle : drawn_) {
        const Vec3 point = position_of(snapshot, particle);
        points.insert(points.end(), {point.x, point.y, point.z});
      }
    else
      for (const Triangle& triangle : mesh.triangles)
        for (const std::uint32_t corner : triangle.points) {
          const Vec3 point = mesh.points[corner];
          points.insert(points.end(), {point.x, point.y, point.z});
        }
    constexpr double least = 1e-3;  // of a spacing, for a body that has collapsed to a point
    return picture::make_camera(points, (rest ? 1 : least) * snapshot.spacing, view_of(options_),
                                options_.camera, frame, direction_of(options_.up));
  }

  void draw(const Snapshot& snapshot, const Mesh& mesh, const std::vector<Line>& lines,
            const std::vector<bool>& is_drawn) {
    const std::string_view colour_by =
        options_.colour_by ? std::string_view(*options_.colour_by) : "displacement";
    Appearance appearance = appearance_of(snapshot, options_, colour_by, is_drawn);
    Notes notes;
    notes.title = title_;
    if (!title_.empty()) notes.time = "t = " + number_text(snapshot.time, "s");
    if (options_.scale != 1)
      notes.remark = "displacements \u00d7 " + short_number(options_.scale, 4);
    if (options_.legend) {
      notes.scale = appearance.scale;
      notes.keys = appearance.keys;
    }
    notes.has_scale_bar = options_.scale_bar;
    notes.has_axes = options_.axes;
    const Layout layout(options_.width, options_.height, notes);
    if (!camera_ || options_.fit == Fit::frame)
      camera_ = camera_for(snapshot, mesh, layout.frame());
    const RayScene scene(mesh, lines, 0.05 * snapshot.spacing, *camera_, options_.smooth > 0);
    const Look look{.particles = appearance.particles,
                    .triangles = mesh.triangles,
                    .lines = lines,
                    .has_crack_colour = options_.cracks,
                    .crack = crack_colour,
                    .open_line = open_colour(options_),
                    .closed_line = closed_colour(options_),
                    .opacity = options_.opacity,
                    .light = options_.light,
                    .shade_reach = 5 * snapshot.spacing * camera_->scale,
                    .samples = options_.samples,
                    .is_transparent = options_.background == Background::transparent,
                    .has_outline = options_.outline};
    const Raster raster =
        trace(snapshot, scene, look, *camera_, options_.width, options_.height, layout.body_area());
    Page page;
    page.raster = &raster;
    page.is_transparent = options_.background == Background::transparent;
    layout.add_to(page, *camera_);
    write_file(files_.path(), encode(page, options_.format));
  }

  Options options_;
  std::vector<ClipPlane> planes_;
  std::string directory_, title_;
  FrameFiles files_;
  std::uint64_t frames_ = 0;
  std::vector<Particle> drawn_;  ///< ascending
  std::vector<CrackFace> cuts_;  ///< of the lattice's cuts
  BodyGrid grid_;                ///< from the first frame on
  RestCorners corners_;          ///< likewise
  std::optional<picture::Camera> camera_;
  std::optional<MovieMaker> maker_;
  std::function<void(std::string_view)> warn_;  ///< tells the user; set if a film is asked for
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::Render>(); }
