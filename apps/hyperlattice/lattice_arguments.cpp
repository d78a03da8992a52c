// The arguments for the lattice and its membrane, shared by `analyze` and `calibrate`.
#include "commands.hpp"

namespace hyperlattice {

void LatticeArguments::declare(CLI::App& command) {
  command
      .add_option("--lattice", lattice,
                  std::string("a lattice component (default: ") + bundled::cubic + ")")
      ->type_name("LATTICE");
  command
      .add_option("--option", options,
                  "an option of the lattice component as name=value, such as coordination=13.2; "
                  "may be repeated")
      ->type_name("NAME=VALUE");
  command
      .add_option("--membrane", membrane.membrane,
                  "none, I, II, III, IV, I-m, or free with the ratios below")
      ->type_name("none|I|II|III|IV|I-m|free");
  command.add_option("--poisson", membrane.poisson,
                     "Poisson ratio along [100]; gives lambda, or without a membrane K_v of the "
                     "volumetric energy");
  command.add_option("--lambda", membrane.lambda, "4D stiffness ratio, in place of --poisson");
  command.add_option("--k_alpha", membrane.k_alpha, "membrane free: k_alpha / k, or infinite");
  command.add_option("--k_beta", membrane.k_beta,
                     "membrane free: k_beta / k, beside springs of the lattice's first class");
  command.add_option("--k_gamma", membrane.k_gamma,
                     "membrane free: k_gamma / k, beside springs of the second class");
}

std::vector<std::filesystem::path> LatticeArguments::files() const {
  std::vector<std::filesystem::path> files;
  for (const std::string& option : options)
    if (const auto equals = option.find('='); equals != std::string::npos)
      files.emplace_back(option.substr(equals + 1));
  return files;
}

}  // namespace hyperlattice
