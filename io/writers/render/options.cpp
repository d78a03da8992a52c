#include "options.hpp"

#include <cmath>

namespace hyperlattice::render {

namespace {

constexpr std::size_t numbers_per_plane = 6;

void check_options(const Options& options, const FaultSink& faults) {
  check_file_name(options.file, faults);
  picture::check_range(options.range, faults);
  bool is_flat = options.clip.size() % numbers_per_plane == 0;
  for (std::size_t n = 3; is_flat && n < options.clip.size(); n += numbers_per_plane)
    is_flat = Vec3{options.clip[n], options.clip[n + 1], options.clip[n + 2]} != Vec3{};
  if (!is_flat)
    faults.fault("clip", "six numbers for each plane: a point, m, and a normal that is not zero");
  if (options.azimuth.has_value() != options.elevation.has_value())
    faults.fault(options.azimuth ? "elevation" : "azimuth",
                 "both azimuth and elevation, or neither");
  if (options.azimuth && options.view)
    faults.fault("view", "either a view or azimuth and elevation");
  if (options.movie != MovieKind::none && options.format != Format::png)
    faults.fault("format", "\"png\", of which films are made");
}

}  // namespace

Schema<Options> options_schema() {
  return Schema<Options>(
             "writers.render",
             "Pictures of the deformed body for papers and talks, with legend, scale bar and axes, "
             "as PNG, SVG or PDF, and films of them")
      .add<&Options::file>("file", "", "base name of the files")
      .fallback("\"render\"")
      .add<&Options::region>("region", "", "particles to draw")
      .fallback("\"all\"")
      .add<&Options::cut>("cut", "",
                          "particles to take away, so that the inside is seen; left out: none")
      .add<&Options::clip>("clip", "m",
                           "planes that cut the drawn body flat, six numbers each: x y z of a "
                           "point, m, and a normal; the side to which it points is not drawn")
      .fallback("[]")
      .example("[0, 0, 0, 0, -1, 0]")
      .add<&Options::colour_by>("colour_by", "",
                                "failure (intact, open, closed) or a field; left out: failure if "
                                "springs can break, else displacement")
      .choices(picture::colourings())
      .plugin_fields()
      .add<&Options::colour_map>("colour_map", "",
                                 "colours of numbers; blue_red is for numbers of both signs")
      .choices(picture::colour_map_names)
      .fallback("\"viridis\"")
      .add<&Options::failure_colours>(
          "failure_colours", "",
          "safe: readable for the colour-blind; paper: blue intact, red open, green closed, as in "
          "figure 8 of Zhao (2017)")
      .choices(failure_colour_names)
      .fallback("\"safe\"")
      .add<&Options::range>(
          "range", "", "least and greatest value of the colours, SI; left out: those of each frame")
      .add<&Options::standpoint>("from", "",
                                 "where the eye is: on an axis through the body, or isometric")
      .choices(standpoint_names)
      .fallback("\"isometric\"")
      .add<&Options::view>("view", "", "direction from the body to the eye, in place of from")
      .nonzero()
      .add<&Options::up>("up", "", "direction that points up in the picture")
      .fallback("[0, 0, 1]")
      .nonzero()
      .add<&Options::azimuth>("azimuth", "rad",
                              "angle of the eye around z from x towards y, in place of from")
      .example("0.5")
      .add<&Options::elevation>("elevation", "rad", "angle of the eye above the plane x y")
      .at_least(-1.5707963267948966)
      .at_most(1.5707963267948966)
      .example("0.5")
      .add<&Options::camera>("camera", "", "whether far things look smaller")
      .choices(picture::projector_names)
      .fallback("\"orthographic\"")
      .add<&Options::fit>("fit", "",
                          "what fills the picture: frame: the body as it is drawn in each frame; "
                          "rest: the body at rest, seen from one place in all frames, so that "
                          "motion is seen as such")
      .choices(picture::fit_names)
      .fallback("\"frame\"")
      .add<&Options::scale>("scale", "", "displacements are drawn this many times as large")
      .fallback("1")
      .at_least(0)
      .add<&Options::opacity>("opacity", "", "of the body; below 1 its inside shines through")
      .fallback("1")
      .above(0)
      .at_most(1)
      .add<&Options::smooth>("smooth", "", "steps of smoothing of the surface; 0: none")
      .fallback("0")
      .at_least(0)
      .at_most(1000)
      .add<&Options::cracks>("cracks", "",
                             "faces between particles that do not hold together get a colour of "
                             "their own and stay opaque")
      .fallback("false")
      .add<&Options::springs>("springs", "",
                              "broken springs as lines between their particles; with opacity below "
                              "1 those inside are seen")
      .fallback("false")
      .add<&Options::damage>("damage", "",
                             "damage, 1 - integrity, from which on a spring does not hold its "
                             "particles together")
      .above(0)
      .at_most(1)
      .fallback("1")
      .add<&Options::title>("title", "",
                            "at the top, with the time; left out: the scene's title; \"\": neither")
      .add<&Options::legend>("legend", "", "what the colours mean, to the right of the body")
      .fallback("true")
      .add<&Options::scale_bar>("scale_bar", "", "a bar of a round length, below the body")
      .fallback("true")
      .add<&Options::axes>("axes", "", "directions of x, y and z, below the body")
      .fallback("true")
      .add<&Options::light>("light", "",
                            "how much light and shade darken colours; 0: exactly the legend's")
      .fallback("0.8")
      .at_least(0)
      .at_most(1)
      .add<&Options::outline>("outline", "", "a dark line where the body ends")
      .fallback("true")
      .add<&Options::background>("background", "", "behind the body")
      .choices(background_names)
      .fallback("\"white\"")
      .add<&Options::width>("width", "", "pixels")
      .fallback("1600")
      .example("320")
      .at_least(64)
      .at_most(16384)
      .add<&Options::height>("height", "", "pixels")
      .fallback("1200")
      .example("240")
      .at_least(64)
      .at_most(16384)
      .add<&Options::samples>("samples", "",
                              "rays along each side of a pixel where it shows an edge")
      .fallback("4")
      .at_least(1)
      .at_most(16)
      .add<&Options::format>("format", "",
                             "of the files; in svg and pdf texts stay texts, and the body is a "
                             "picture")
      .choices(format_names)
      .fallback("\"png\"")
      .add<&Options::movie>(
          "movie", "",
          "a film of all frames, when the run ends or is interrupted, if ffmpeg or, for gif "
          "and webp, ImageMagick is installed; give a range and \"fit\": "
          "\"rest\" with it")
      .choices(movie_names)
      .fallback("\"none\"")
      .add<&Options::frame_rate>("frame_rate", "1/s", "frames of the film per second")
      .fallback("10")
      .at_least(0.1)
      .at_most(100)
      .restrictions(
          "Each particle is drawn as its cell, turned and deformed with its neighbours; cells "
          "meet without gaps and open where springs are broken. With partial cells, cells that "
          "are at least half full are drawn whole. The particles of lattices that are not cubic "
          "are drawn as small cubes that fill the shape. Planes cut the deformed body. A "
          "transparent body has no shade between its parts. The run waits for these files.")
      .source(
          "colours: viridis, cividis, ColorBrewer RdBu; Okabe and Ito (2008) for failure; rays by "
          "Embree (Apache 2.0), texts by Cairo (LGPL 2.1 or MPL 1.1); smoothing by Taubin (1995)")
      .check(check_options);
}

Vec3 view_of(const Options& options) {
  if (options.view) return *options.view;
  if (options.azimuth) {
    const double across = std::cos(*options.elevation);
    return {across * std::cos(*options.azimuth), across * std::sin(*options.azimuth),
            std::sin(*options.elevation)};
  }
  switch (options.standpoint) {
    case Standpoint::x:
      return {1, 0, 0};
    case Standpoint::minus_x:
      return {-1, 0, 0};
    case Standpoint::y:
      return {0, 1, 0};
    case Standpoint::minus_y:
      return {0, -1, 0};
    case Standpoint::z:
      return {0, 0, 1};
    case Standpoint::minus_z:
      return {0, 0, -1};
    default:
      return {1, -1, 1};
  }
}

std::vector<ClipPlane> planes_of(const std::vector<double>& clip) {
  std::vector<ClipPlane> planes;
  for (std::size_t n = 0; n < clip.size(); n += numbers_per_plane)
    planes.push_back({{clip[n], clip[n + 1], clip[n + 2]},
                      direction_of({clip[n + 3], clip[n + 4], clip[n + 5]})});
  return planes;
}

}  // namespace hyperlattice::render
