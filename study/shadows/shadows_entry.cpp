#include <limits>
#include <memory>

#include <fmt/core.h>

#include "strands/formats/formats.h"
#include "study/registry/entries.h"
#include "study/shadows/slices_study.h"

namespace cuticle::study {
namespace {

using SharedGroom = std::shared_ptr<const strands::Groom>;

Result<SharedGroom> groom_of(const StudyRequest& request, Progress& progress) {
  const std::string& file = request.options.at("groom");
  if (file.empty()) return SharedGroom(std::make_shared<const strands::Groom>(study_coat(request.quick ? 2500 : 20000)));
  const strands::ReadOptions options{.metres_per_unit = std::strtod(request.options.at("metres-per-unit").c_str(), nullptr),
                                     .radius = std::strtod(request.options.at("radius").c_str(), nullptr)};
  CUTICLE_ASSIGN(strands::GroomFile read, strands::read_groom(file, options));
  for (const std::string& note : read.notes) progress.message(note);
  return SharedGroom(std::make_shared<const strands::Groom>(std::move(read.groom)));
}

/// T less the truth, NaN where no error is counted.
std::vector<double> errors_of(std::span<const float> values, std::span<const float> truth) {
  std::vector<double> errors(values.size(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < values.size(); ++i)
    if (is_counted(truth[i], Counted::partly_lit)) errors[i] = double(values[i]) - double(truth[i]);
  return errors;
}

std::vector<Knob> knobs_of(const ComparisonRow& row) {
  std::vector<Knob> knobs;
  for (const auto& [name, value] : row.values.all())
    if (name == "slices" || name == "layers" || name == "resolution") knobs.push_back({name, registry::to_text(value)});
  return knobs;
}

/// Build, and lookup at every vertex of the groom.
Work work_of(const SharedGroom& groom, const Comparison& comparison, const Candidate& candidate) {
  return {{},
          [=, alpha = comparison.alpha, to_light = comparison.to_light]() -> Result<void> {
            const shadows::Casters casters{groom.get(), alpha, to_light};
            CUTICLE_TRY(candidate.method->evaluate(casters, {groom->positions}, candidate.values));
            return {};
          },
          1};
}

Point constant_point(const std::string& name, double value, const Comparison& comparison) {
  const std::vector<float> values(comparison.truth.size(), float(value));
  return {name, {}, [errors = errors_of(values, comparison.truth)]() -> Result<Measured> { return Measured{{errors}}; }};
}

Result<Group> group_of(const SharedGroom& groom, const Comparison& comparison) {
  Group group{.name = comparison.groom_name,
              .title = "Opacity maps and deep opacity maps",
              .truth = fmt::format("{} rays over a disc of {:.3g} mm at each of {} receivers; counted are the {} with "
                                   "0.05 < T < 0.95, where its standard error is {:.2g}",
                                   comparison.rays, 1e3 * comparison.footprint_radius, comparison.receivers, comparison.counted,
                                   comparison.truth_standard_error),
              .metrics = {{"T", "mean error of transmittance"}},
              .item = "receiver",
              .floor = comparison.truth_standard_error};
  for (const ComparisonRow& row : comparison.rows) {
    CUTICLE_ASSIGN(const shadows::Method* method, shadows::find_method(row.method));
    const Measured measured{{errors_of(row.transmittance, comparison.truth)}, double(row.cost.bytes)};
    group.points.push_back({row.method, knobs_of(row), [measured]() -> Result<Measured> { return measured; },
                            work_of(groom, comparison, {method, row.values})});
  }
  group.points.push_back(constant_point("none (T = 1)", 1, comparison));
  group.points.push_back(constant_point("the best constant", comparison.best_constant_value, comparison));
  return group;
}

Result<Study> declare_shadows(const StudyRequest& request, Progress& progress) {
  CUTICLE_ASSIGN(const SharedGroom groom, groom_of(request, progress));
  SlicesStudy slices = request.quick ? quick_slices_study() : SlicesStudy{};
  slices.request.groom = groom.get();
  slices.request.groom_name = request.options.at("groom").empty() ? "coat" : request.options.at("groom");
  CUTICLE_ASSIGN(const Comparison comparison, run_slices_study(slices, progress));
  Study study{.name = "shadows",
              .title = "Opacity maps and deep opacity maps against ray-traced truth",
              .question = "How many slices or layers, at which resolution, for which error of transmittance?",
              .cost_label = "build, and lookup at every vertex"};
  study.notes = {fmt::format("Hair: {}, {} strands, {} vertices, strand spacing {:.3g} mm. One crossing takes {:.3g} % of the light. "
                             "The best constant is {:.3g}. Filters are as wide as the truth's disc.",
                             comparison.groom_name, comparison.strands, comparison.vertices, 1e3 * comparison.spacing, 100 * comparison.alpha,
                             comparison.best_constant_value)};
  for (const Refusal& refusal : comparison.refused)
    study.notes.push_back(fmt::format("Refused: {} {}: {}", refusal.method, refusal.settings, refusal.why));
  CUTICLE_ASSIGN(Group group, group_of(groom, comparison));
  study.groups.push_back(std::move(group));
  return study;
}

}  // namespace

const StudyEntry& shadows_entry() {
  static const StudyEntry entry{
      .name = "shadows",
      .summary = "opacity maps and deep opacity maps, layers and resolution, against ray-traced truth",
      .options = {{"groom", "", "groom: " + strands::list_of_extensions(false) + "; without it a coat of strands on a half sphere"},
                  {"metres-per-unit", "0", "unit of the groom file; 0 = guess and say so"},
                  {"radius", "0", "fibre radius in metres; 0 = the file's own or 35e-6"}},
      .declare = declare_shadows,
      .quick_seconds = 8,
      .seconds = 90};
  return entry;
}

}  // namespace cuticle::study
