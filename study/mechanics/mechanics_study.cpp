#include "study/mechanics/mechanics_study.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "study/mechanics/experiment.h"

namespace cuticle::study {
namespace {

struct Named {
  std::string_view name;
  mechanics::Experiment (*make)(bool quick);
};
constexpr Named k_experiments[] = {{"cantilever", mechanics::cantilever},
                                   {"bend_twist", mechanics::hanging_arc},
                                   {"lateral_buckling", mechanics::standing_arc},
                                   {"stick_slip", mechanics::stick_slip},
                                   {"capstan", mechanics::capstan_over_a_cylinder},
                                   {"capstan_edges", mechanics::capstan_over_edges},
                                   {"catenary", mechanics::catenary},
                                   {"clamped_beam", mechanics::clamped_beam},
                                   {"hanging_chain", mechanics::hanging_chain},
                                   {"falling_chain", mechanics::falling_chain},
                                   {"drape", mechanics::drape}};

const Named* find(std::string_view name) {
  const auto found = std::ranges::find(k_experiments, name, &Named::name);
  return found == std::end(k_experiments) ? nullptr : found;
}

/// The names asked for; none: all.
Result<std::vector<std::string>> chosen(const std::vector<std::string>& asked) {
  std::vector<std::string> names = asked;
  for (const std::string& name : names)
    if (!find(name))
      return usage_error(fmt::format("study mechanics: no experiment '{}'", name),
                         fmt::format("known: {}", fmt::join(mechanics_experiments(), ", ")));
  return names.empty() ? mechanics_experiments() : names;
}

}  // namespace

std::vector<std::string> mechanics_experiments() {
  std::vector<std::string> names;
  for (const Named& experiment : k_experiments) names.emplace_back(experiment.name);
  return names;
}

Result<Study> mechanics_study(const MechanicsRequest& request, Progress& progress) {
  Study study{.name = "mechanics",
              .title = "Mechanics: experiments with known results",
              .question = "Does each solver give what a laboratory would measure, and what does a run cost?",
              .cost_label = "one run, mean over the parameter"};
  CUTICLE_ASSIGN(const std::vector<std::string> names, chosen(request.experiments));
  std::vector<mechanics::Experiment> experiments;
  for (const std::string& name : names) experiments.push_back(find(name)->make(request.quick));
  CUTICLE_TRY(mechanics::add_experiments(study, experiments, progress));
  study.notes = {
      "classic and exact have no bending: they take part where limp hair does. classic has no friction.",
      "Rod with no steps through time is the equilibrium of `simulate --rest`: its residual is the largest moment "
      "that is not balanced, over weight times length."};
  return study;
}

}  // namespace cuticle::study
