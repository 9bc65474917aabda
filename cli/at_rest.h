#pragma once
// `cuticle simulate --rest`: the hair's equilibrium instead of frames.
#include <string>

#include "cli/command.h"

namespace cuticle::cli {

struct AtRestRequest {
  std::string scene, out;
  bool vtp = true, hair = false;
};
/// Writes the state, rest.csv (a row per strand) and files.json, and prints a summary. Exit code 1 where a strand is
/// not balanced.
int simulate_at_rest(const AtRestRequest& request, Context& context);

}  // namespace cuticle::cli
