#pragma once
// `cuticle study`: one file here for each study, each defining a function below.
#include "cli/command.h"

namespace cuticle::cli {

void add_study_lobes(CLI::App& study, Context& context);
void add_study_luts(CLI::App& study, Context& context);
void add_study_motion(CLI::App& study, Context& context);
void add_study_skinning(CLI::App& study, Context& context);
void add_study_render(CLI::App& study, Context& context);
void add_study_shadows(CLI::App& study, Context& context);

}  // namespace cuticle::cli
