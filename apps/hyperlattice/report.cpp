// hyperlattice report: one page of one or more runs.
#include "commands.hpp"

#include <base/errors.hpp>
#include <base/named_file.hpp>
#include <report/report.hpp>
#include <report/viewer.hpp>
#include <run/output_file.hpp>

#include <hyperlattice/files.hpp>

#include <spdlog/spdlog.h>

#include <iostream>

namespace hyperlattice {

Command report_command(CLI::App& program) {
  struct Arguments {
    std::vector<std::filesystem::path> folders;
    std::filesystem::path file;
    bool json = false, interactive = false;
  };
  const auto arguments = std::make_shared<Arguments>();
  CLI::App* command = program.add_subcommand(
      "report",
      "one page (HTML, with all that it needs) of one or more runs, also of runs that go on");
  command->add_option("DIR", arguments->folders, "folders that runs or studies left")
      ->required()
      ->type_name("FOLDER");
  command
      ->add_option("--out", arguments->file,
                   "the page (default: DIR/report.html of one folder, report.html here of several)")
      ->type_name("FILE");
  command->add_flag("--json", arguments->json, "print what the page says for machines");
  command->add_flag("--interactive", arguments->interactive,
                    "with the body in 3D, of one run that wrote frames (.vtu)");
  return {command, [arguments] {
            auto& [folders, file, json, interactive] = *arguments;
            const bool is_default = file.empty();
            if (is_default)
              file =
                  (folders.size() == 1 ? folders.front() : std::filesystem::path()) / "report.html";
            Faults faults;
            check_output_file({"--out", file, {".html", ".htm"}, is_default}, {}, faults);
            faults.throw_if_any();
            const report::Report report = report::read_report(folders);
            if (interactive && (report.runs.size() != 1 || !report.studies.empty()))
              throw InputError({{"--interactive", "", "the folder of one run"}});
            const std::string page = report::report_page(
                report, interactive ? report::viewer_section(report.runs.front()) : "");
            if (is_default)
              write_file(file.string(), page);  // does not follow a link that was created meanwhile
            else
              write_named_file(file, page);
            if (json) {
              Json found = report::report_json(report);
              found["file"] = file.string();
              std::cout << json_text(found) << std::flush;
            } else {
              std::cout << report::report_text(report) << std::flush;
            }
            spdlog::info("the page is {}", file.string());
            return exit_done;
          }};
}

}  // namespace hyperlattice
