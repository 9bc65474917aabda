// `cuticle study shadows --marks FILE`: the marks of a file in the place of the study.
#include <cstdlib>

#include <fmt/core.h>

#include "cli/run_folder.h"
#include "cli/study/study.h"
#include "core/file.h"
#include "study/shadows/marks.h"

namespace cuticle::cli {
namespace {

/// The folder of the grooms that files of marks name.
std::string data_folder() {
  const char* folder = std::getenv("CUTICLE_TEST_DATA");
  return folder == nullptr ? "." : folder;
}

Result<int> measure(const std::string& marks, const std::string& out, Context& context) {
  CUTICLE_ASSIGN(const std::vector<study::MarksFile> files, study::read_marks(marks, data_folder()));
  CUTICLE_TRY(make_folder(out));
  bool all = true;
  std::string json;
  for (const study::MarksFile& file : files) {
    CUTICLE_ASSIGN(const study::MarksReport report, study::measure_marks(file, *context.progress));
    json += (json.empty() ? "" : ",") + study::to_json(file, report);
    if (!context.json) fmt::print("{}\n", study::to_text(file, report));
    for (const study::MarkResult& result : report.results) all = all && result.met();
  }
  if (files.size() > 1) json = "[" + json + "]\n";
  CUTICLE_TRY(write_text_file(out + "/marks.json", json));
  if (context.json) fmt::print("{}", json);
  return int(all ? Exit::ok : Exit::check_failed);
}

}  // namespace

void add_shadow_marks(CLI::App& study, Context& context) {
  auto* command = study.get_subcommand("shadows");
  auto marks = std::make_shared<std::string>();
  command->add_option("--marks", *marks,
                      "measure the marks of a file instead (scenes/shadow_marks); grooms are found below CUTICLE_TEST_DATA");
  // Before the study's own callback, which leaves an action that is there.
  command->parse_complete_callback([&context, command, marks] {
    if (marks->empty()) return;
    context.action = [&context, command, marks] {
      const auto out = command->get_option("--out")->as<std::string>();
      return in_folder(out, [&] {
        const auto code = measure(*marks, out, context);
        return code ? *code : report(code.error());
      });
    };
  });
}

}  // namespace cuticle::cli
