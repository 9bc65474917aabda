#include "study/model_check/model_check.h"

#include <array>

#include "study/model_check/checks/checks.h"

namespace cuticle::study::model_check {
namespace {

constexpr std::array<Check, 9> table = {{
    {"white_furnace", "a fibre without absorption scatters no more than it receives, and all of it where it says so",
     white_furnace},
    {"absorbing_furnace", "the energy scattered is the albedo, and that of a dielectric cylinder", absorbing_furnace},
    {"reciprocity", "an untilted fibre scatters as much from a to b as from b to a", reciprocity},
    {"pdf_normalised", "the density of the samples integrates to 1, tilted or not", pdf_normalised},
    {"chi_square", "the samples follow their density", chi_square},
    {"sample_weights", "weights are S / pdf and their mean is the albedo", sample_weights},
    {"lobe_tails", "lobes fall to nothing without ripples or cuts", lobe_tails},
    {"caustic_continuity", "energy changes continuously with inclination, across caustics too", caustic_continuity},
    {"finite", "no value is infinite, NaN or negative anywhere in the domain", finite},
}};

}  // namespace

std::span<const Check> checks() { return table; }

std::vector<Verdict> run_checks(const Subject& subject, const Options& options, Progress& progress) {
  std::vector<Verdict> verdicts;
  for (const Check& check : table) {
    progress.update(subject.name, verdicts.size(), table.size());
    verdicts.push_back(check.run(subject, options));
    verdicts.back().check = check.name;
  }
  progress.update(subject.name, table.size(), table.size());
  return verdicts;
}

}  // namespace cuticle::study::model_check
