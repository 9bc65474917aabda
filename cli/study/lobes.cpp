#include <fmt/core.h>

#include "bsdf/fibre/fibres.h"
#include "cli/run_folder.h"
#include "cli/shared_files.h"
#include "cli/study/study.h"
#include "study/lobes/lobes_study.h"

namespace cuticle::cli {
namespace {

struct LobesOptions {
  std::string models = "all", hair = "blond", out;
  bool quick = false;
};

Result<study::LobesRequest> request_of(const LobesOptions& options) {
  study::LobesRequest request;
  CUTICLE_ASSIGN(const bsdf::NamedFibre hair, bsdf::find_fibre(options.hair));
  request.fibre = hair.fibre;
  request.fibre_name = options.hair;
  if (options.models != "all") request.models = split_list(options.models);
  if (!options.quick) return request;
  request.points = 256;
  request.reference_seconds = 1;
  request.seconds = 0.03;
  request.samples = 91;
  return request;
}

Result<study::LobesStudy> run_lobes(const LobesOptions& options, Progress& progress) {
  CUTICLE_ASSIGN(const study::LobesRequest request, request_of(options));
  CUTICLE_ASSIGN(const study::LobesStudy lobes, study::run_lobes_study(request, progress));
  CUTICLE_TRY(study::write_lobes_study(lobes, options.out));
  return lobes;
}

int study_lobes(const LobesOptions& options, Context& context) {
  const auto lobes = run_lobes(options, *context.progress);
  if (!lobes) return report(lobes.error());
  if (context.json)
    fmt::print("{}", study::to_json(*lobes));
  else
    print_rows(study::to_csv(*lobes), options.out + "/study.csv");
  return make_page("", options.out, *context.progress);
}

}  // namespace

void add_study_lobes(CLI::App& study, Context& context) {
  auto* command = study.add_subcommand("lobes", "every fibre model: error against time of its tiers, and its lobes");
  auto options = std::make_shared<LobesOptions>();
  command->add_option("--out", options->out, "folder to write")->required();
  command->add_option("--models", options->models, "models, a,b,c, or all")->capture_default_str();
  command->add_option("--hair", options->hair, "physical fibre that every model is mapped to")->capture_default_str();
  command->add_flag("--quick", options->quick, "fewer points and timings");
  command->callback([&context, options] {
    context.action = [&context, options] {
      return in_folder(options->out, [&] { return study_lobes(*options, context); });
    };
  });
}

}  // namespace cuticle::cli
