#include <base/content_hash.hpp>
#include <base/errors.hpp>
#include <host/compile_flags.hpp>
#include <host/source_plugin.hpp>
#include <process/child.hpp>

#include <spdlog/fmt/fmt.h>
#include <spdlog/spdlog.h>
#include <boost/dll/runtime_symbol_info.hpp>

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <thread>

namespace hyperlattice {

namespace {

namespace fs = std::filesystem;
using Problem = CompiledPlugin::Problem;

constexpr double no_limit = 1e9, default_seconds = 600;  // that a compilation may take
constexpr std::size_t longest_report = 1500;        // bytes of a compiler's output in a message
constexpr const char* own_headers = "own_headers";  // file of the cache: names of headers

std::string text_in(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

CompiledPlugin refused(Problem problem, std::string sentence) {
  return {{}, problem, std::move(sentence)};
}

/// Returns the folder of the cache; empty if the environment names none.
fs::path cache_folder() {
  const auto folder = [](const char* name) {
    const char* const value = std::getenv(name);
    return fs::path(value == nullptr ? "" : value);
  };
  if (const fs::path given = folder("XDG_CACHE_HOME"); given.is_absolute())
    return given / "hyperlattice" / "plugins";
  if (const fs::path home = folder("HOME"); home.is_absolute())
    return home / ".cache" / "hyperlattice" / "plugins";
  return {};
}

/// Returns the folder of the built-in plugins, beside this library.
fs::path plugin_folder() {
  return fs::weakly_canonical(boost::dll::this_line_location()).parent_path() / "hyperlattice";
}

double most_seconds() {
  const char* const given = std::getenv("HYPERLATTICE_COMPILE_SECONDS");
  if (given == nullptr || *given == '\0') return default_seconds;
  const double seconds = std::strtod(given, nullptr);
  return seconds > 0 ? seconds : no_limit;
}

/// Returns the words of $CXX, which may be "ccache g++", or "c++".
std::vector<std::string> compiler_words() {
  const char* const given = std::getenv("CXX");
  std::istringstream words(given == nullptr ? "" : given);
  std::vector<std::string> all{std::istream_iterator<std::string>(words), {}};
  if (all.empty()) all.emplace_back("c++");
  return all;
}

/// Returns a text that changes with a program's file.
std::string identity_of_program(const fs::path& program) {
  std::error_code error;
  const fs::path file = fs::canonical(program, error);
  return fmt::format("{} {} {}", file.string(), fs::file_size(file, error),
                     fs::last_write_time(file, error).time_since_epoch().count());
}

/// Returns the hash of all headers below a folder.
std::string hash_of_headers(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& file : fs::recursive_directory_iterator(folder / "hyperlattice", error))
    if (file.path().extension() == ".hpp") files.push_back(file.path());
  std::sort(files.begin(), files.end());
  ContentHash hash;
  for (const fs::path& file : files) hash.add(text_in(file));
  return hash.text();
}

/// A folder that is removed with what is in it.
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const fs::path& parent) {
    std::string name = (parent / "compiling_XXXXXX").string();
    if (::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code error;
    if (!path_.empty()) fs::remove_all(path_, error);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// One call of the compiler.
struct Command {
  std::vector<std::string> words;
  fs::path log;
  ChildEnd end;
};

class Compilation {
 public:
  explicit Compilation(fs::path source)
      : source_(std::move(source)),
        flags_(read_compile_flags(plugin_folder() / "compile_flags")),
        compiler_(compiler_words()) {}

  CompiledPlugin result() {
    const fs::path program = find_program(compiler_.front());
    if (program.empty())
      return refused(
          Problem::outside,
          fmt::format("{} is a source file, and there is no C++ compiler \"{}\": install "
                      "one (Debian: apt install g++), or name it in CXX",
                      source_.string(), compiler_.front()));
    if (flags_.include.empty() || !fs::exists(flags_.include.front() / "hyperlattice"))
      return refused(Problem::outside,
                     fmt::format("{} is a source file, and this installation has no headers for "
                                 "plugins",
                                 source_.string()));
    text_ = text_in(source_);
    law_ = law_in(text_);
    const fs::path cache = cache_folder();
    if (cache.empty())
      return refused(Problem::outside,
                     "neither XDG_CACHE_HOME nor HOME names a folder for compiled plugins");
    const fs::path entry = cache / key(program),
                   library =
                       entry / hash_of_own_headers(text_in(entry / own_headers)) / library_name();
    if (fs::exists(library)) return {library, Problem::none, ""};
    return compile(cache, entry);
  }

 private:
  /// Returns the name of the law that a material's source declares by HYPERLATTICE_LAW(name);
  /// empty if there is none.
  static std::string law_in(const std::string& text) {
    static const std::regex line(R"((?:^|\n)[ \t]*HYPERLATTICE_LAW\([ \t]*([\w:]+)[ \t]*\))");
    std::smatch found;
    return std::regex_search(text, found, line) ? found[1].str() : "";
  }

  std::string library_name() const { return source_.stem().string() + ".so"; }

  std::string key(const fs::path& program) const {
    ContentHash hash;
    hash.add(text_ + '\n' + library_name() + '\n' + identity_of_program(program) + '\n');
    for (const std::string& word : compiler_) hash.add(word + '\n');
    for (const fs::path& folder : flags_.include) hash.add(hash_of_headers(folder) + '\n');
    for (const auto* list : {&flags_.plugin, &flags_.kernels})
      for (const std::string& flag : *list) hash.add(flag + '\n');
    for (const auto& [name, list] : flags_.of)
      for (const std::string& flag : list) hash.add(name + ' ' + flag + '\n');
    return hash.text();
  }

  /// Returns the hash of the contents of headers beside the source. `names`: one in each line.
  std::string hash_of_own_headers(const std::string& names) const {
    ContentHash hash;
    std::istringstream lines(names);
    for (std::string name; std::getline(lines, name);)
      hash.add(name + '\n' + text_in(source_.parent_path() / name) + '\n');
    return hash.text();
  }

  CompiledPlugin compile(const fs::path& cache, const fs::path& entry) {
    std::error_code error;
    fs::create_directories(cache, error);
    const TemporaryFolder folder(cache);
    if (folder.path().empty())
      return refused(Problem::outside, fmt::format("{}: nothing can be written into {}",
                                                   source_.string(), cache.string()));
    spdlog::info("compiling {}", source_.string());
    std::vector<Command> commands = object_commands(folder.path());
    run(commands);
    if (CompiledPlugin problem = problem_of(commands); problem.problem != Problem::none)
      return problem;
    std::vector<Command> linking{link_command(folder.path(), commands.size())};
    run(linking);
    if (CompiledPlugin problem = problem_of(linking); problem.problem != Problem::none)
      return problem;
    return put_into_cache(folder.path(), entry);
  }

  static std::string object(std::size_t number) { return fmt::format("{}.o", number); }

  /// Returns the commands that compile the source and, if it has a law, its kernels.
  std::vector<Command> object_commands(const fs::path& folder) const {
    std::vector<Command> commands;
    const auto add = [&](const fs::path& file, const std::vector<std::string>& flags) {
      std::vector<std::string> words = compiler_;
      words.insert(words.end(), flags_.plugin.begin(), flags_.plugin.end());
      words.insert(words.end(), flags.begin(), flags.end());
      for (const fs::path& include : flags_.include) words.push_back("-I" + include.string());
      const std::string number = std::to_string(commands.size());
      for (const std::string& word :
           {std::string("-MD"), std::string("-MF"), (folder / (number + ".d")).string(),
            std::string("-c"), file.string(), std::string("-o"),
            (folder / object(commands.size())).string()})
        words.push_back(word);
      commands.push_back({std::move(words), folder / (number + ".log"), {}});
    };
    const bool several = !law_.empty() && flags_.of.size() > 1;
    add(source_, several ? std::vector<std::string>{"-DHYPERLATTICE_X86_KERNELS"}
                         : std::vector<std::string>{});
    if (law_.empty()) return commands;
    for (const auto& [instructions, own] : flags_.of) {
      const fs::path file = folder / fmt::format("kernels.{}.cpp", instructions);
      std::ofstream(file) << fmt::format(
          "#define HYPERLATTICE_INSTRUCTIONS {}\n"
          "#include <hyperlattice/kernels/law_kernels.hpp>\n"
          "#include <hyperlattice/boundary.hpp>\n"
          "#undef HYPERLATTICE_PLUGIN\n"
          "#define HYPERLATTICE_PLUGIN(version) \\\n"
          "  [[maybe_unused]] static void not_here(::hyperlattice::Registrar& plugin)\n"
          "#include \"{}\"\n"
          "HYPERLATTICE_KERNELS({})\n",
          instructions, source_.string(), law_);
      std::vector<std::string> flags = own;
      flags.insert(flags.end(), flags_.kernels.begin(), flags_.kernels.end());
      flags.push_back("-I" + source_.parent_path().string());
      add(file, flags);
    }
    return commands;
  }

  Command link_command(const fs::path& folder, std::size_t objects) const {
    std::vector<std::string> words = compiler_;
    words.emplace_back("-shared");
    for (std::size_t n = 0; n < objects; ++n) words.push_back((folder / object(n)).string());
    words.emplace_back("-o");
    words.push_back((folder / library_name()).string());
    return {std::move(words), folder / "link.log", {}};
  }

  /// Runs the commands at the same time.
  static void run(std::vector<Command>& commands) {
    const double seconds = most_seconds();
    std::vector<std::thread> threads;
    threads.reserve(commands.size());
    for (Command& one : commands)
      threads.emplace_back([&one, seconds] { one.end = run_child(one.words, one.log, seconds); });
    for (std::thread& thread : threads) thread.join();
  }

  CompiledPlugin problem_of(const std::vector<Command>& commands) const {
    for (const Command& one : commands) {
      if (!one.end.started)
        return refused(Problem::outside, fmt::format("{} cannot be started", one.words.front()));
      if (one.end.timed_out)
        return refused(Problem::outside,
                       fmt::format("{}: its compilation took more than {} s and was stopped "
                                   "(HYPERLATTICE_COMPILE_SECONDS sets the limit)",
                                   source_.string(), most_seconds()));
      if (one.end.exit_code < 0)
        return refused(Problem::outside,
                       fmt::format("{}: a signal ended its compilation", source_.string()));
      if (one.end.exit_code == 0) continue;
      std::string report = text_in(one.log);
      if (report.find("signal terminated program") != std::string::npos)
        return refused(Problem::outside,
                       fmt::format("{}: its compilation was killed, perhaps for lack of memory",
                                   source_.string()));
      if (report.size() > longest_report) report = report.substr(0, longest_report) + "...";
      while (report.ends_with('\n')) report.pop_back();
      return refused(Problem::source, fmt::format("{} says\n{}", one.words.front(), report));
    }
    return {};
  }

  /// Returns the headers that stand in the source's folder or below it, relative to it, one in each
  /// line. The compiler lists all files that it read.
  std::string names_of_own_headers(const fs::path& folder) const {
    std::istringstream words(text_in(folder / "0.d"));
    std::string lines;
    for (std::string word; words >> word;) {
      const fs::path relative = fs::path(word).lexically_relative(source_.parent_path());
      if (word == "\\" || word.ends_with(':') || relative.empty() ||
          relative == source_.filename() || relative.begin()->string() == "..")
        continue;
      lines += relative.string() + '\n';
    }
    return lines;
  }

  /// Moves the library into the cache. Another program may do the same at the same time.
  CompiledPlugin put_into_cache(const fs::path& folder, const fs::path& entry) const {
    const std::string names = names_of_own_headers(folder);
    const fs::path place = entry / hash_of_own_headers(names), library = place / library_name();
    std::error_code error;
    fs::create_directories(place, error);
    std::ofstream(folder / own_headers) << names;
    if (!error) fs::rename(folder / library_name(), library, error);
    if (!error) fs::rename(folder / own_headers, entry / own_headers, error);
    if (error)
      return refused(Problem::outside,
                     fmt::format("{} cannot be written: {}", library.string(), error.message()));
    return {library, Problem::none, ""};
  }

  fs::path source_;
  CompileFlags flags_;
  std::vector<std::string> compiler_;
  std::string text_, law_;
};

}  // namespace

bool is_plugin_source(const fs::path& file) {
  const fs::path suffix = file.extension();
  return suffix == ".cpp" || suffix == ".cc" || suffix == ".cxx";
}

CompiledPlugin compile_plugin(const fs::path& source) {
  return Compilation(fs::absolute(source).lexically_normal()).result();
}

}  // namespace hyperlattice
