#include <fmt/core.h>

#include <cuticle/cli/command.h>
#include <cuticle/cli/shared_files.h>
#if defined(CUTICLE_HAS_GPU) || defined(CUTICLE_HAS_EMBREE)
#define CUTICLE_HAS_SHADOWS
#include <cuticle/strands/formats/formats.h>
#include <cuticle/study/shadows/slices_study.h>
#endif

namespace cuticle::cli {

#ifdef CUTICLE_HAS_SHADOWS
namespace {

struct Options {
  std::string groom, out;
  strands::ReadOptions read;
  bool quick = false;
};

Result<strands::Groom> load(const Options& options, Progress& progress) {
  if (options.groom.empty()) return study::study_coat(options.quick ? 5000 : 20000);
  CUTICLE_ASSIGN(auto file, strands::read_groom(options.groom, options.read));
  for (const std::string& note : file.notes) progress.message(note);
  return std::move(file.groom);
}

Result<study::Comparison> run_shadows(const Options& options, Progress& progress) {
  CUTICLE_ASSIGN(const strands::Groom groom, load(options, progress));
  study::SlicesStudy slices = options.quick ? study::quick_slices_study() : study::SlicesStudy{};
  slices.request.groom = &groom;
  slices.request.groom_name = options.groom.empty() ? "coat" : options.groom;
  CUTICLE_ASSIGN(auto comparison, study::run_slices_study(slices, progress));
  CUTICLE_TRY(study::write_comparison(comparison, options.out));
  return comparison;
}

int study_shadows(const Options& options, Context& context) {
  const auto comparison = run_shadows(options, *context.progress);
  if (!comparison) return report(comparison.error());
  fmt::print("{}", context.json ? study::to_json(*comparison) : study::to_csv(*comparison));
  return make_page("", options.out, *context.progress);
}

}  // namespace

void add_study(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand("study", "what accuracy costs in time: CSV, JSON, plots, one page");
  command->require_subcommand(1);
  auto* shadows = command->add_subcommand("shadows", "opacity-map slices and resolution against ray-traced truth");
  auto options = std::make_shared<Options>();
  shadows->add_option("--out", options->out, "folder to write")->required();
  shadows->add_option("--groom", options->groom, "groom: .hair or .tfx; without it a coat of strands on a half sphere");
  shadows->add_option("--metres-per-unit", options->read.metres_per_unit, "unit of the groom file; 0 = guess and say so")->check(CLI::Range(0.0, 1000.0));
  shadows->add_option("--radius", options->read.radius, "fibre radius in metres; 0 = the file's own or 35e-6")->check(CLI::Range(0.0, 0.01));
  shadows->add_flag("--quick", options->quick, "fewer settings, receivers and rays");
  shadows->callback([&context, options] { context.action = [&context, options] { return study_shadows(*options, context); }; });
}
#else
void add_study(CLI::App&, Context&) {}
#endif

}  // namespace cuticle::cli
