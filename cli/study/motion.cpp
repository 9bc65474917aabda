#include <fmt/core.h>

#include "cli/run_folder.h"
#include "cli/shared_files.h"
#include "cli/study/study.h"
#include "study/motion/motion_study.h"

namespace cuticle::cli {
namespace {

struct MotionOptions {
  std::string out;
  bool quick = false;
};

Result<study::MotionStudy> run_motion(const MotionOptions& options, Progress& progress) {
  const study::MotionRequest request = options.quick ? study::quick_motion_request() : study::MotionRequest{};
  CUTICLE_ASSIGN(const study::MotionStudy motion, study::run_motion_study(request, progress));
  CUTICLE_TRY(study::write_motion_study(motion, options.out));
  return motion;
}

int study_motion(const MotionOptions& options, Context& context) {
  const auto motion = run_motion(options, *context.progress);
  if (!motion) return report(motion.error());
  print_rows(study::motion_csv(*motion), options.out + "/study.csv");
  return make_page("", options.out, *context.progress);
}

}  // namespace

void add_study_motion(CLI::App& study, Context& context) {
  auto* command = study.add_subcommand("motion", "strand solvers: error against time by substeps and iterations");
  auto options = std::make_shared<MotionOptions>();
  command->add_option("--out", options->out, "folder to write")->required();
  command->add_flag("--quick", options->quick, "fewer settings and timings");
  command->callback([&context, options] {
    context.action = [&context, options] {
      return in_folder(options->out, [&] { return study_motion(*options, context); });
    };
  });
}

}  // namespace cuticle::cli
