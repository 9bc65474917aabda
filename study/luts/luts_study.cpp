#include "study/luts/luts_study.h"

#include <algorithm>

#include <fmt/format.h>

#include "lut/fit/texel_fit.h"
#include "lut/format.h"
#include "lut/max_error.h"

namespace cuticle::study {
namespace {

/// One set to be made.
struct Task {
  const bsdf::Model* model;
  registry::ParameterValues values;
  const lut::Layout* layout;
  int size;
};

double ratio(double part, double whole) { return whole > 0 ? part / whole : 0; }

void add_rows(LutsStudy& study, const LutRow& common, const lut::TableSet& set) {
  const auto add = [&](std::string channel, const lut::ChannelError& error) {
    LutRow& row = study.rows.emplace_back(common);
    row.channel = std::move(channel);
    row.rms_error = ratio(error.rms, error.signal_rms);
    row.p99_error = ratio(error.percentile_99, error.peak);
    row.max_error = ratio(error.maximum, error.peak);
  };
  for (const lut::Table& table : set.tables)
    for (const lut::ChannelError& error : table.errors) add(error.channel, error);
  if (set.scattering.size() > 1) add("S", set.scattering[1]);
}

Result<lut::TableSet> stored(const lut::TableSet& baked, const lut::Format& format, std::string_view fit,
                             Progress& progress) {
  if (fit == "texels") {
    CUTICLE_ASSIGN(lut::TexelFit fitted, lut::fit_texels(baked, format, progress));
    return std::move(fitted.set);
  }
  lut::TableSet set = baked;
  CUTICLE_TRY(lut::certify(set, format, progress));
  return set;
}

/// Sets made, of those to make.
struct Steps {
  Progress& progress;
  std::size_t total, done = 0;
  void next() { progress.update("sets of tables", ++done, total); }
};

bool is_fitted(const LutsRequest& request, const std::string& fit, int size) {
  return fit == "none" || size <= request.largest_fitted;
}

/// Of one model and layout.
std::size_t count_sets(const LutsRequest& request) {
  std::size_t count = 0;
  for (const int size : request.sizes)
    for (const std::string& fit : request.fits) count += is_fitted(request, fit, size) ? request.formats.size() : 0;
  return count;
}

Result<void> add_set(LutsStudy& study, const Task& task, const LutsRequest& request, Steps& steps) {
  CUTICLE_ASSIGN(const lut::TableSet baked,
                 lut::bake(*task.model, task.values, *task.layout, task.size, silent_progress()));
  for (const std::string& fit : request.fits) {
    if (!is_fitted(request, fit, task.size)) continue;
    for (const std::string& format : request.formats) {
      CUTICLE_ASSIGN(const lut::Format* as, lut::find_format(format));
      CUTICLE_ASSIGN(const lut::TableSet set, stored(baked, *as, fit, silent_progress()));
      LutRow common{std::string(task.model->entry.name), std::string(task.layout->entry.name), format, fit, ""};
      common.size = task.size;
      common.bytes = lut::texture_bytes(*task.layout, task.size, *as);
      common.bake_ms = baked.bake_ms;
      CUTICLE_ASSIGN(common.ns, sampling_ns(set, request.points, request.repeats));
      add_rows(study, common, set);
      steps.next();
    }
  }
  return {};
}

Result<std::vector<const lut::Layout*>> chosen_layouts(const LutsRequest& request) {
  std::vector<const lut::Layout*> chosen;
  for (const std::string& name : request.layouts) {
    CUTICLE_ASSIGN(chosen.emplace_back(), lut::find_layout(name));
  }
  if (!chosen.empty()) return chosen;
  for (const lut::Layout* layout : lut::layouts())
    if (!layout->terms.empty()) chosen.push_back(layout);
  return chosen;
}

/// A layout that does not fit the model (lobes that it lacks, a near field) is noted and left out.
Result<void> add_layout(LutsStudy& study, Task task, const LutsRequest& request, Steps& steps) {
  for (const int size : request.sizes) {
    task.size = size;
    const Result<void> added = add_set(study, task, request, steps);
    if (added) continue;
    if (added.error().kind != ErrorKind::usage) return added;
    study.skipped.push_back(
        fmt::format("{} in {}: {}", task.model->entry.name, task.layout->entry.name, added.error().message));
    return {};
  }
  return {};
}

}  // namespace

Result<LutsStudy> run_luts_study(const LutsRequest& request, Progress& progress) {
  LutsStudy study;
  CUTICLE_ASSIGN(const std::vector<const lut::Layout*> layouts, chosen_layouts(request));
  int finished = 0;
  Steps steps{progress, request.models.size() * layouts.size() * count_sets(request)};
  for (const std::string& name : request.models) {
    CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(name));
    CUTICLE_ASSIGN(const registry::ParameterValues values, bsdf::parse_settings(*model, "", request.settings));
    CUTICLE_ASSIGN(const std::vector<DirectRow> direct,
                   measure_direct(*model, values, request.points, request.repeats));
    study.direct.insert(study.direct.end(), direct.begin(), direct.end());
    for (const lut::Layout* layout : layouts) {
      CUTICLE_TRY(add_layout(study, {model, values, layout, 0}, request, steps));
      steps.done = count_sets(request) * std::size_t(++finished);  // a layout that does not fit is passed over
    }
  }
  study.verdicts = verdicts_of(study);
  return study;
}

}  // namespace cuticle::study
