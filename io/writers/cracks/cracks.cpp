// A series of files for ParaView: one VTK PolyData per frame with the faces between particles whose
// spring is broken or damaged, and a collection file (.pvd) that gives the times.
#include <vtk/xml_file.hpp>

#include <hyperlattice/frames.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace hyperlattice {
namespace {

using namespace vtk;

class Cracks {
 public:
  struct Options : PackingOptions {
    std::string file;
    RegionId region;
    double damage = 1;
    bool deformed = false, diagonals = false, cuts = false;
  };

  static Schema<Options> schema() {
    Schema<Options> schema("writers.cracks",
                           "Series of VTK surfaces of the cracks for ParaView, with a .pvd file "
                           "that gives the times");
    schema.add<&Options::file>("file", "", "base name of the files")
        .fallback("\"cracks\"")
        .add<&Options::region>("region", "", "particles whose springs are written, both ends")
        .fallback("\"all\"")
        .add<&Options::damage>("damage", "",
                               "damage, 1 - integrity, from which on a spring that exists has a "
                               "face; 1: it carries no tension any more")
        .above(0)
        .at_most(1)
        .fallback("1")
        .add<&Options::deformed>("deformed", "",
                                 "faces moved by the mean displacement of their two particles, not "
                                 "at rest")
        .fallback("false")
        .add<&Options::diagonals>("diagonals", "",
                                  "also springs of the other classes, as the diagonals of the "
                                  "cubic lattice: small squares of area 0")
        .fallback("false")
        .add<&Options::cuts>("cuts", "",
                             "also springs that the lattice's cuts took away, with the time 0 and "
                             "the damage 1")
        .fallback("false");
    add_codec_option(schema);
    add_precision_option(schema);
    return schema
        .equation(
            "One face for each failed spring of class 0, normal to it: area = share |R| / m, m = "
            "(1/3V) sum share R^2 over springs of class 0; in the cubic lattice the square of edge "
            "l between two sites. jump = u_b - u_a; opening = |R + jump| - |R|")
        .restrictions(
            "Class 0 has the orthogonal springs of lattices.cubic, the nearest neighbours of "
            "lattices.bcc and lattices.fcc, and all springs of lists. The faces of a straight "
            "crack, each projected on its plane, add up to the area of the cross-section; a crack "
            "oblique to the lattice has stairs. With cells a face at the surface has one "
            "quadrilateral for each of its cells. Numbers of each face: time of failure (nan: not "
            "failed yet), damage, opening (below 0: closed), jump, normal (at rest, from a to b), "
            "area, spring_class, particle_a, particle_b. With cuts those of the cuts come first. "
            "The run waits for these files.")
        .check([](const Options& options, const FaultSink& faults) {
          check_file_name(options.file, faults);
        });
  }

  explicit Cracks(const Options& options) : options_(options) {}

  void begin(const OutputContext& context) {
    files_ = FrameFiles(context, options_.file, ".vtp");
    const auto particles = context.particles(options_.region);
    if (particles.empty()) throw std::runtime_error("no particle lies in the region");
    particles_.assign(particles.begin(), particles.end());
    cuts_.clear();
    if (options_.cuts)
      for (const CrackFace& face : context.cut_faces())
        if (is_written(face)) cuts_.push_back(face);
    collection_ = {};
    for (std::size_t n = 0; n < context.earlier.size(); ++n)
      collection_.add(files_.name(n), context.earlier[n].time);
  }

  void frame(const Snapshot& snapshot) {
    for (Array* array : arrays()) array->values.clear();
    particle_a_.clear();
    particle_b_.clear();
    const std::span<const double> moved = require_field(snapshot, "displacement").values;
    for (const CrackFace& face : cuts_) add(snapshot, face, moved);
    for (const CrackFace& face : snapshot.crack_faces(options_.damage))
      if (is_written(face)) add(snapshot, face, moved);
    encode(snapshot);
    describe().write(files_.path());
    collection_.add(files_.name(), snapshot.time);
    collection_.write(files_.path_of_series(".pvd"));
    files_.next();
  }

  void end() {}

  /// Returns the bytes of the faces of cuts, of their numbers and of the encoded arrays. How many
  /// springs will fail nobody knows.
  double memory_bytes() const noexcept {
    constexpr double reals = 12 + 11, wholes = 2;  // of points and of all other arrays
    return static_cast<double>(cuts_.size()) *
           (sizeof(CrackFace) + 2 * (reals * sizeof(double) + wholes * sizeof(std::int64_t)));
  }

 private:
  /// Real numbers of each face, or of each point.
  struct Array {
    std::string_view name;
    std::uint32_t components = 1;
    std::vector<double> values;
    EncodedArray encoded;

    void add(Vec3 value) { values.insert(values.end(), {value.x, value.y, value.z}); }
  };

  bool is_written(const CrackFace& face) const {
    if (face.spring_class != 0 && !options_.diagonals) return false;
    const auto has = [&](Particle particle) {
      return std::binary_search(particles_.begin(), particles_.end(), particle);
    };
    return has(face.a) && has(face.b);
  }

  void add(const Snapshot& snapshot, const CrackFace& face, std::span<const double> moved) {
    const auto displacement = [&](Particle particle) {
      const double* u = &moved[3 * particle];
      return Vec3{u[0], u[1], u[2]};
    };
    const Vec3 u_a = displacement(face.a), u_b = displacement(face.b), jump = u_b - u_a,
               rest = position_of(snapshot, face.b) - position_of(snapshot, face.a),
               shift = options_.deformed ? 0.5 * (u_a + u_b) : Vec3{};
    for (const Vec3 corner : face.corners) points_.add(corner + shift);
    time_.values.push_back(face.time);
    damage_.values.push_back(face.damage);
    // |R + jump| - |R| without cancellation.
    opening_.values.push_back(dot(jump, 2 * rest + jump) / (norm(rest + jump) + norm(rest)));
    jump_.add(jump);
    normal_.add(direction_of(rest));
    area_.values.push_back(face.area);
    class_.values.push_back(face.spring_class);
    particle_a_.push_back(static_cast<std::int64_t>(face.a));
    particle_b_.push_back(static_cast<std::int64_t>(face.b));
  }

  void encode(const Snapshot& snapshot) {
    time_value_.encode<double>(snapshot, options_.codec, std::span(&snapshot.time, 1));
    for (Array* array : arrays()) vtk::encode(snapshot, options_, array->values, array->encoded);
    std::vector<std::int64_t> numbers(4 * particle_a_.size());
    std::iota(numbers.begin(), numbers.end(), 0);
    const auto encode_whole = [&](const std::vector<std::int64_t>& values, EncodedArray& to) {
      to.encode<std::int64_t>(snapshot, options_.codec, std::span(values));
    };
    encode_whole(numbers, connectivity_);
    numbers.resize(particle_a_.size());
    for (std::size_t n = 0; n < numbers.size(); ++n)
      numbers[n] = 4 * static_cast<std::int64_t>(n + 1);
    encode_whole(numbers, offsets_);
    encode_whole(particle_a_, encoded_a_);
    encode_whole(particle_b_, encoded_b_);
  }

  XmlFile describe() const {
    const std::string_view real = real_type(options_.precision);
    XmlFile file("PolyData", options_.codec);
    file << "<FieldData>\n";
    file.add("Float64", "TimeValue", " NumberOfTuples=\"1\"", time_value_);
    file << "</FieldData>\n<Piece NumberOfPoints=\"" << std::to_string(4 * particle_a_.size())
         << "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\""
         << std::to_string(particle_a_.size()) << "\">\n<CellData>\n";
    for (const Array* array : {&time_, &damage_, &opening_, &jump_, &normal_, &area_, &class_})
      file.add(real, array->name, components(array->components), array->encoded);
    file.add("Int64", "particle_a", components(1), encoded_a_);
    file.add("Int64", "particle_b", components(1), encoded_b_);
    file << "</CellData>\n<Points>\n";
    file.add(real, "Points", components(3), points_.encoded);
    file << "</Points>\n<Polys>\n";
    file.add("Int64", "connectivity", "", connectivity_);
    file.add("Int64", "offsets", "", offsets_);
    file << "</Polys>\n</Piece>\n";
    return file;
  }

  std::array<Array*, 8> arrays() {
    return {&points_, &time_, &damage_, &opening_, &jump_, &normal_, &area_, &class_};
  }

  Options options_;
  FrameFiles files_;
  Collection collection_;
  std::vector<Particle> particles_;  ///< of the region, ascending
  std::vector<CrackFace> cuts_;      ///< those that are written
  Array points_{"Points", 3, {}, {}}, time_{"time", 1, {}, {}}, damage_{"damage", 1, {}, {}},
      opening_{"opening", 1, {}, {}}, jump_{"jump", 3, {}, {}}, normal_{"normal", 3, {}, {}},
      area_{"area", 1, {}, {}}, class_{"spring_class", 1, {}, {}};
  std::vector<std::int64_t> particle_a_, particle_b_;
  EncodedArray time_value_, connectivity_, offsets_, encoded_a_, encoded_b_;
};

}  // namespace
}  // namespace hyperlattice

HYPERLATTICE_PLUGIN("1.0") { plugin.add<hyperlattice::Cracks>(); }
