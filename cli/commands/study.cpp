#include "cli/study/study.h"

namespace cuticle::cli {

void add_study(CLI::App& app, Context& context) {
  auto* study = app.add_subcommand("study", "measure what accuracy costs in time: CSV, JSON, plots, one page");
  study->require_subcommand(1);
  study->fallthrough();
  add_study_lobes(*study, context);
  add_study_luts(*study, context);
  add_study_motion(*study, context);
  add_study_skinning(*study, context);
  add_study_render(*study, context);
  add_study_shadows(*study, context);
}

}  // namespace cuticle::cli
