#include <algorithm>
#include <cstdlib>

#include <fmt/core.h>

#include "cli/groom_options.h"
#include "cli/run_folder.h"
#include "cli/shared_files.h"
#include "cli/study/study.h"
#include "core/file.h"
#include "study/shadows/marks.h"
#include "study/shadows/slices_study.h"

namespace cuticle::cli {
namespace {

struct ShadowsStudyOptions {
  std::string groom, marks, out;
  strands::ReadOptions read;
  bool quick = false;
};

Result<strands::Groom> groom_of(const ShadowsStudyOptions& options, Progress& progress) {
  if (options.groom.empty()) return study::study_coat(options.quick ? 5000 : 20000);
  return load_groom(options.groom, options.read, progress);
}

Result<study::Comparison> run_shadows(const ShadowsStudyOptions& options, Progress& progress) {
  CUTICLE_ASSIGN(const strands::Groom groom, groom_of(options, progress));
  study::SlicesStudy slices = options.quick ? study::quick_slices_study() : study::SlicesStudy{};
  slices.request.groom = &groom;
  slices.request.groom_name = options.groom.empty() ? "coat" : options.groom;
  CUTICLE_ASSIGN(auto comparison, study::run_slices_study(slices, progress));
  CUTICLE_TRY(study::write_comparison(comparison, options.out));
  return comparison;
}

/// The folder of the grooms that files of marks name.
std::string data_folder() {
  const char* folder = std::getenv("CUTICLE_TEST_DATA");
  return folder == nullptr ? "." : folder;
}

Result<int> measure(const ShadowsStudyOptions& options, Context& context) {
  CUTICLE_ASSIGN(const std::vector<study::MarksFile> files, study::read_marks(options.marks, data_folder()));
  CUTICLE_TRY(make_folder(options.out));
  bool all = true;
  std::string json;
  for (const study::MarksFile& file : files) {
    CUTICLE_ASSIGN(const study::MarksReport report, study::measure_marks(file, *context.progress));
    json += (json.empty() ? "" : ",") + study::to_json(file, report);
    if (!context.json) fmt::print("{}\n", study::to_text(file, report));
    for (const study::MarkResult& result : report.results) all = all && result.met();
  }
  if (files.size() > 1) json = "[" + json + "]\n";
  CUTICLE_TRY(write_text_file(options.out + "/marks.json", json));
  if (context.json) fmt::print("{}", json);
  return int(all ? Exit::ok : Exit::check_failed);
}

int study_shadows(const ShadowsStudyOptions& options, Context& context) {
  if (!options.marks.empty()) {
    const auto code = measure(options, context);
    return code ? *code : report(code.error());
  }
  const auto comparison = run_shadows(options, *context.progress);
  if (!comparison) return report(comparison.error());
  fmt::print("{}", context.json ? study::to_json(*comparison) : study::to_csv(*comparison));
  return make_page("", options.out, *context.progress);
}

}  // namespace

void add_study_shadows(CLI::App& study, Context& context) {
  auto* command = study.add_subcommand(
      "shadows", "opacity maps and deep opacity maps, layers and resolution, against ray-traced truth");
  auto options = std::make_shared<ShadowsStudyOptions>();
  command->add_option("--out", options->out, "folder to write")->required();
  command->add_option("--groom", options->groom, "groom: .hair or .tfx; without it a coat of strands on a half sphere");
  command->add_option(
      "--marks", options->marks,
      "measure the marks of a file instead (scenes/shadow_marks); grooms are found below CUTICLE_TEST_DATA");
  add_groom_options(*command, options->read.metres_per_unit, options->read.radius);
  command->add_flag("--quick", options->quick, "fewer settings, receivers and rays");
  command->callback([&context, options] {
    context.action = [&context, options] {
      return in_folder(options->out, [&] { return study_shadows(*options, context); });
    };
  });
}

}  // namespace cuticle::cli
