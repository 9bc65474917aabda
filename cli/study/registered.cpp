// A subcommand for every registered study.
#include <cstdio>
#include <filesystem>

#include <fmt/core.h>

#include "cli/run_folder.h"
#include "cli/shared_files.h"
#include "cli/study/run.h"
#include "cli/study/study.h"
#include "study/registry/entries.h"

namespace cuticle::cli {

namespace fs = std::filesystem;

namespace {

struct RegisteredOptions {
  const study::StudyEntry* entry = nullptr;
  study::StudyRequest request;
  std::string out;
};

std::string command_of(const study::StudyEntry& entry, const study::StudyRequest& request) {
  std::string text = "cuticle study " + entry.name;
  for (const study::StudyOption& option : entry.options)
    if (const std::string& value = request.options.at(option.name); value != option.value)
      text += option.positional ? " " + value : fmt::format(" --{} {}", option.name, value);
  return text + (request.quick ? " --quick" : "") + " --out DIR";
}

int study_registered(const RegisteredOptions& options, Context& context) {
  const auto csv = run_registered(*options.entry, options.request, options.out, *context.progress);
  if (!csv) return report(csv.error());
  print_rows(*csv, options.out + "/study.csv");
  std::fflush(stdout);  // before what the page's maker says
  return make_page("", options.out, *context.progress);
}

void add_registered(CLI::App& study, Context& context, const study::StudyEntry& entry) {
  auto* command = study.add_subcommand(entry.name, entry.summary);
  auto options = std::make_shared<RegisteredOptions>();
  options->entry = &entry;
  options->request = default_request(entry, false, "");
  command->add_option("--out", options->out, "folder to write")->required();
  for (const study::StudyOption& option : entry.options)
    command
        ->add_option(option.positional ? option.name : "--" + option.name, options->request.options.at(option.name),
                     option.help)
        ->capture_default_str();
  command->add_flag("--quick", options->request.quick, "a reduced form, for a first look");
  command->callback([&context, options] {
    if (context.action) return;
    context.action = [&context, options] {
      options->request.device = context.device;
      return in_folder(options->out, [&] { return study_registered(*options, context); });
    };
  });
}

}  // namespace

study::StudyRequest default_request(const study::StudyEntry& entry, bool quick, const std::string& device) {
  study::StudyRequest request{quick, {}, device, fs::path(share_file("scenes/demo.json")).parent_path().parent_path().string()};
  for (const study::StudyOption& option : entry.options) request.options[option.name] = option.value;
  return request;
}

Result<std::string> run_registered(const study::StudyEntry& entry, const study::StudyRequest& request,
                                   const std::string& folder, Progress& progress) {
  CUTICLE_ASSIGN(const study::Study study, study::declare(entry, request, progress));
  CUTICLE_ASSIGN(const study::StudyResult result, study::run_study(study, progress));
  CUTICLE_TRY(study::write_study(study, result, command_of(entry, request), folder));
  return study::result_csv(study, result);
}

void add_registered_studies(CLI::App& study, Context& context) {
  for (const study::StudyEntry* entry : study::studies()) add_registered(study, context, *entry);
}

}  // namespace cuticle::cli
