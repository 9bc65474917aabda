#include "cli/study/study.h"

namespace cuticle::cli {

void add_study(CLI::App& app, Context& context) {
  auto* study = app.add_subcommand("study", "measure what accuracy costs in time: CSV, JSON, plots, one page");
  study->require_subcommand(1);
  study->fallthrough();
  add_registered_studies(*study, context);
  add_shadow_marks(*study, context);
  add_study_all(*study, context);
  add_study_compare(*study, context);
}

}  // namespace cuticle::cli
