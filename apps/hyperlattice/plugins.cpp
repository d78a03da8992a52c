// hyperlattice plugins: lists the components and the searched folders, shows a component's page,
// tests components.
#include "commands.hpp"

#include <scene/json.hpp>

#include <spdlog/fmt/fmt.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <iostream>

namespace hyperlattice {
namespace {

struct Arguments {
  std::vector<std::string> names;
  PluginPathArgument plugin_paths;
  bool why = false, json = false, test = false, only_names = false;
  std::filesystem::path pictures;
  std::string new_type;
  std::filesystem::path out;
};

[[noreturn]] void say_why_not(const Host& host, const std::string& name) {
  if (host.refused(name)) throw OutsideError(host.why_not(name));
  const std::string near = nearest(name, host.known_types());
  throw InputError({{"NAME", name,
                     "a type that can be found; " + host.why_not(name) +
                         (near.empty() ? "" : "; did you mean '" + near + "'?")}});
}

void print_list(const std::vector<const Component*>& components) {
  std::size_t width = 0;
  for (const Component* component : components)
    width = std::max(width, component->info.name.size());
  for (const std::string_view family : family_names) {
    std::vector<const Component*> members;
    for (const Component* component : components)
      if (family_names[static_cast<std::size_t>(component->info.family)] == family)
        members.push_back(component);
    if (members.empty()) continue;
    std::sort(members.begin(), members.end(),
              [](const Component* a, const Component* b) { return a->info.name < b->info.name; });
    std::cout << family << '\n';
    for (const Component* member : members)
      std::cout << "  " << member->type() << std::string(width + 2 - member->type().size(), ' ')
                << member->info.summary << '\n';
  }
}

const char* verdict(const SearchOutcome& outcome) {
  return outcome.accepted ? "accepted" : outcome.absent ? "absent" : "refused";
}

void print_searched(const Host& host) {
  std::cout << "\nsearched\n";
  for (const SearchOutcome& outcome : host.searched())
    std::cout << "  " << verdict(outcome) << "  " << outcome.path.string() << "\n            "
              << outcome.reason << '\n';
}

nlohmann::json searched_json(const Host& host) {
  auto places = nlohmann::json::array();
  for (const SearchOutcome& outcome : host.searched())
    places.push_back({{"path", outcome.path.string()},
                      {"outcome", verdict(outcome)},
                      {"reason", outcome.reason}});
  return places;
}

/// Returns the named components, or all if none is named.
std::vector<const Component*> named(Host& host, const Arguments& arguments) {
  if (arguments.names.empty()) return host.load_all();
  std::vector<const Component*> components;
  for (const std::string& name : arguments.names) {
    components.push_back(host.find(name));
    if (components.back() != nullptr) continue;
    if (arguments.why && arguments.json)
      std::cout << json_text(nlohmann::json{{"searched", searched_json(host)}});
    else if (arguments.why)
      print_searched(host);
    say_why_not(host, name);
  }
  return components;
}

/// Creates the folder of the pictures before the tests, so that a failure is not blamed on a
/// component.
void make_folder(const std::filesystem::path& pictures) {
  std::error_code error, unseen;
  std::filesystem::create_directories(pictures, error);
  if (std::filesystem::is_directory(pictures, unseen)) return;
  if (std::filesystem::exists(std::filesystem::symlink_status(pictures, unseen)))
    throw InputError({{"--pictures", pictures.string(), "a folder, or a name that is free"}});
  throw OutsideError(
      fmt::format("cannot create the folder {}: {}", pictures.string(), error.message()));
}

int show(const Arguments& arguments) {
  Host host(arguments.plugin_paths.libraries());
  if (!arguments.new_type.empty()) {
    if (const Component* taken = host.find(arguments.new_type))
      throw InputError({{"--new", arguments.new_type,
                         fmt::format("a name that no component has yet; this one is in {}",
                                     taken->path.string())}});
    return write_new_plugin(arguments.new_type, arguments.out);
  }
  if (arguments.only_names) {
    for (const std::string& type : host.known_types()) std::cout << type << '\n';
    return exit_done;
  }
  const auto components = named(host, arguments);
  if (arguments.test && !arguments.pictures.empty()) make_folder(arguments.pictures);
  if (arguments.test) return test_plugins(host, components, arguments.pictures, arguments.json);
  if (arguments.json) {
    nlohmann::json document;
    for (const Component* component : components)
      document["components"].push_back(nlohmann::json::parse(component_json(*component)));
    if (arguments.why) document["searched"] = searched_json(host);
    std::cout << json_text(document);
    return exit_done;
  }
  if (arguments.names.empty()) print_list(components);
  for (std::size_t n = 0; n < arguments.names.size(); ++n)
    std::cout << (n > 0 ? "\n" : "") << component_page(*components[n]);
  if (arguments.why) print_searched(host);
  return exit_done;
}

}  // namespace

Command plugins_command(CLI::App& program) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand(
      "plugins",
      "list what a scene can name, document or test components, or begin one of your own");
  command->add_option("NAME", arguments->names, "components, e.g. loads.blast; all if left out")
      ->type_name("COMPONENT");
  arguments->plugin_paths.declare(*command);
  command->add_flag("--why", arguments->why,
                    "also every place searched, and why a library was refused");
  command->add_flag("--json", arguments->json, "print it for machines");
  command->add_flag("--names", arguments->only_names,
                    "only the names of all components, from the names of their files");
  command->add_flag(
      "--test", arguments->test,
      "run components through the contract of their family; exit code 3 if a check failed");
  command
      ->add_option("--pictures", arguments->pictures,
                   "with --test: folder for a picture of each law, force against elongation")
      ->type_name("DIR");
  command
      ->add_option("--new", arguments->new_type,
                   "write a project of your own for a plugin of this type, e.g. failures.my_law")
      ->type_name("FAMILY.NAME");
  command
      ->add_option(
          "--out", arguments->out,
          "with --new: the folder to write, ./<name> if left out; or one source file, such as "
          "my_law.cpp")
      ->type_name("PATH");
  return {command, [arguments] { return show(*arguments); }};
}

}  // namespace hyperlattice
