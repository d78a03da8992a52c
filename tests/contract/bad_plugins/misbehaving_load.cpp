// A load that commits the fault named in the environment; see fault.hpp.
#include "fault.hpp"

#include <hyperlattice/load.hpp>

#include <chrono>
#include <new>
#include <stdexcept>
#include <thread>

namespace {
using namespace hyperlattice;

/// Its constructor runs when the library is loaded.
struct AtLoad {
  AtLoad() {
    if (asked_for("exit at load")) std::exit(0);
    if (asked_for("hang at load")) std::this_thread::sleep_for(std::chrono::hours(1));
    if (asked_for("throw at load")) throw std::runtime_error("boom");
  }
} at_load;

class Misbehaves {
 public:
  struct Options {
    RegionId on;
  };
  static Schema<Options> schema() {
    const bool wild = asked_for("wild help");
    Schema<Options> schema("loads.misbehaving", wild ? "Mis\x1b[31mbehaves\nforged" : "Misbehaves");
    schema.add<&Options::on>("on", "", wild ? "where\x1b[31m\r\nforged" : "where")
        .example("\"z_max\"");
    return schema;
  }
  explicit Misbehaves(const Options& options) : options_(options) {
    if (asked_for("throw an int")) throw 1;
    if (asked_for("no memory in constructor")) throw std::bad_alloc();
    if (asked_for("wild refusal")) throw std::runtime_error("\x1b[31mred\r\nforged\n");
  }
  Misbehaves(const Misbehaves&) = delete;
  Misbehaves& operator=(const Misbehaves&) = delete;
  ~Misbehaves() {
    if (asked_for("no memory in destructor")) give_up();
  }

  void declare(const LoadBody& body, const LoadSink& sink) {
    RegionId region = options_.on;
    if (asked_for("region")) region.index = 1234567;
    for (const Particle particle : body.particles(region)) sink.force(particle, {0, 0, 1});
    if (asked_for("particle")) body.position(~Particle{0});
    if (asked_for("axes")) sink.displacement(0, 0, {});
    if (asked_for("amplitude")) sink.force(0, {0, infinity, 0});
    if (asked_for("acceleration")) sink.acceleration({0, infinity - infinity, 0});
    if (asked_for("exit in declare")) std::exit(0);
    if (asked_for("no memory in declare")) throw std::bad_alloc();
  }

  double factor(double time) const {
    // The plan evaluates the factor only at the start, the middle and the end of the run.
    if (time < 1e-6 || time > 2e-6) return 1;
    if (asked_for("throw")) throw std::runtime_error("boom");
    if (asked_for("no memory in factor")) throw std::bad_alloc();
    if (asked_for("wild error")) throw std::runtime_error("\x1b[31mred\r\nforged\n");
    if (asked_for("nan")) return infinity - infinity;
    if (asked_for("null pointer")) return *static_cast<const volatile double*>(nullptr);
    if (asked_for("abort")) std::abort();
    if (asked_for("exit")) std::exit(0);
    return 1;
  }

 private:
  static void give_up() { throw std::bad_alloc(); }
  Options options_;
};
}  // namespace

HYPERLATTICE_PLUGIN("1.0") { plugin.add<Misbehaves>(); }
