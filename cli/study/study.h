#pragma once
// `cuticle study`: a subcommand for every registered study, and those below.
#include "cli/command.h"

namespace cuticle::cli {

void add_registered_studies(CLI::App& study, Context& context);
void add_study_all(CLI::App& study, Context& context);
void add_study_compare(CLI::App& study, Context& context);
/// --marks, on the subcommand `shadows`, which must be there.
void add_shadow_marks(CLI::App& study, Context& context);

}  // namespace cuticle::cli
