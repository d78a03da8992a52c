// The options of writers.render.
#pragma once

#include "mesh.hpp"
#include "movie.hpp"
#include "page.hpp"

#include <picture/camera.hpp>
#include <picture/colourings.hpp>

#include <hyperlattice/frames.hpp>

namespace hyperlattice::render {

using picture::ColourMap;
using picture::Fit;
using picture::Projector;

constexpr std::string_view standpoint_names[] = {"isometric", "x", "-x", "y", "-y", "z", "-z"};
enum class Standpoint : std::uint32_t { isometric, x, minus_x, y, minus_y, z, minus_z };
constexpr std::string_view failure_colour_names[] = {"safe", "paper"};
enum class FailureColours : std::uint32_t { safe, paper };
constexpr std::string_view background_names[] = {"white", "transparent"};
enum class Background : std::uint32_t { white, transparent };

struct Options {
  std::string file;
  RegionId region;
  std::optional<RegionId> cut;
  std::vector<double> clip;
  std::optional<std::string> colour_by;
  ColourMap colour_map = ColourMap::viridis;
  FailureColours failure_colours = FailureColours::safe;
  std::optional<std::vector<double>> range;
  Standpoint standpoint = Standpoint::isometric;
  std::optional<Vec3> view;
  Vec3 up;
  std::optional<double> azimuth, elevation;
  Projector camera = Projector::orthographic;
  Fit fit = Fit::frame;
  double scale = 1, opacity = 1, light = 0, damage = 1;
  int smooth = 0;
  bool cracks = false, springs = false, outline = true, legend = true, scale_bar = true,
       axes = true;
  std::optional<std::string> title;
  Background background = Background::white;
  int width = 0, height = 0, samples = 0;
  Format format = Format::png;
  MovieKind movie = MovieKind::none;
  double frame_rate = 0;
};

Schema<Options> options_schema();

/// Returns the direction from the body to the eye that the options name.
Vec3 view_of(const Options& options);

/// Returns the planes of the option "clip".
std::vector<ClipPlane> planes_of(const std::vector<double>& clip);

}  // namespace hyperlattice::render
