#include "study/luts/luts_study.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "lut/fit/texel_fit.h"
#include "lut/format.h"
#include "lut/max_error.h"

namespace cuticle::study {
namespace {

/// Sets that are made, of those to make.
struct Steps {
  Progress& progress;
  std::size_t total, done = 0;
  void next() { progress.update("sets of tables", ++done, total); }
};

/// A model in a layout, and where its sets go.
struct Task {
  const bsdf::Model* model;
  registry::ParameterValues values;
  const lut::Layout* layout;
  std::shared_ptr<const LutDirections> on;
};
/// Channel, curve, bytes: relative error.
using ChannelErrors = std::map<std::string, std::map<std::string, std::map<double, double>>>;
struct Made {
  std::vector<Point> points;
  ChannelErrors errors;
};

Result<lut::TableSet> stored(const lut::TableSet& baked, const lut::Format& format, std::string_view fit) {
  if (fit == "texels") {
    CUTICLE_ASSIGN(lut::TexelFit fitted, lut::fit_texels(baked, format, silent_progress()));
    return std::move(fitted.set);
  }
  lut::TableSet set = baked;
  CUTICLE_TRY(lut::certify(set, format, silent_progress()));
  return set;
}

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

void add_errors(ChannelErrors& errors, const lut::TableSet& set, const std::string& curve, double bytes) {
  for (const lut::Table& table : set.tables)
    for (const lut::ChannelError& error : table.errors)
      if (error.signal_rms > 0) errors[error.channel][curve][bytes] = std::max(1e-9, error.rms / error.signal_rms);
}

Result<void> add_sets(Made& made, const Task& task, int size, const LutsRequest& request, Steps& steps) {
  CUTICLE_ASSIGN(const lut::TableSet baked, lut::bake(*task.model, task.values, *task.layout, size, silent_progress()));
  for (const std::string& fit : request.fits) {
    if (!is_fitted(request, fit, size)) continue;
    for (const std::string& format : request.formats) {
      CUTICLE_ASSIGN(const lut::Format* as, lut::find_format(format));
      CUTICLE_ASSIGN(const lut::TableSet set, stored(baked, *as, fit));
      const std::string method =
          fmt::format("{} {}{}", task.layout->entry.name, format, fit == "none" ? "" : " fitted");
      const std::size_t bytes = lut::texture_bytes(*task.layout, size, *as);
      CUTICLE_ASSIGN(Point point, table_point(set, method, bytes, task.on));
      made.points.push_back(std::move(point));
      add_errors(made.errors, set, method, double(bytes));
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
Result<void> add_layout(Study& study, Made& made, const Task& task, const LutsRequest& request, Steps& steps) {
  for (const int size : request.sizes) {
    const Result<void> added = add_sets(made, task, size, request, steps);
    if (added) continue;
    if (added.error().kind != ErrorKind::usage) return added;
    study.notes.push_back(
        fmt::format("Left out: {} in {}: {}", task.model->entry.name, task.layout->entry.name, added.error().message));
    return {};
  }
  return {};
}

/// Error of each channel against bytes.
void add_plots(Study& study, const std::string& model, const ChannelErrors& errors) {
  for (const auto& [channel, curves] : errors) {
    Plot plot{fmt::format("bytes_{}_{}", model, channel), fmt::format("{}: error of {} against bytes of the set", model, channel),
              "bytes", "rms error / rms of the signal", false, true, {}};
    for (const auto& [name, points] : curves) {
      Curve& curve = plot.curves.emplace_back(Curve{name, {}, {}});
      for (const auto& [bytes, error] : points) {
        curve.x.push_back(bytes);
        curve.y.push_back(error);
      }
    }
    study.plots.push_back(std::move(plot));
  }
}

Result<Group> group_of(const bsdf::Model& model, const registry::ParameterValues& values,
                       const std::shared_ptr<const LutDirections>& on) {
  const std::string name(model.entry.name);
  Group group{.name = name,
              .title = fmt::format("{}: tables beside the model", name),
              .truth = fmt::format("the model in double at {} random directions", on->points.size()),
              .metrics = {{"S", "rms error of S / rms of S", "1", Mean::root_mean_square}},
              .item = "direction"};
  CUTICLE_ASSIGN(group.points, direct_points(model, values, on));
  return group;
}

}  // namespace

Result<Study> luts_study(const LutsRequest& request, Progress& progress) {
  Study study{.name = "luts",
              .title = "Lookup tables beside the model they stand for",
              .question = "Where do tables pay: which layout, size and format, and where is the model itself better?",
              .cost_label = "one evaluation of S, one thread"};
  study.notes = {"Errors and times are those of a bilinear filter in the stored format, as float code on one CPU thread with "
                 "the tables in cache; texture units of a GPU are not what is measured."};
  CUTICLE_ASSIGN(const std::vector<const lut::Layout*> layouts, chosen_layouts(request));
  std::size_t finished = 0;
  Steps steps{progress, request.models.size() * layouts.size() * count_sets(request)};
  for (const std::string& name : request.models) {
    CUTICLE_ASSIGN(const bsdf::Model* model, bsdf::find_model(name));
    CUTICLE_ASSIGN(const registry::ParameterValues values, bsdf::parse_settings(*model, "", request.settings));
    const auto on = lut_directions(*model, values, request.points);
    CUTICLE_ASSIGN(Group group, group_of(*model, values, on));
    Made made;
    for (const lut::Layout* layout : layouts) {
      CUTICLE_TRY(add_layout(study, made, {model, values, layout, on}, request, steps));
      steps.done = count_sets(request) * ++finished;  // a layout that does not fit is passed over
    }
    std::ranges::move(made.points, std::back_inserter(group.points));
    add_plots(study, name, made.errors);
    study.groups.push_back(std::move(group));
  }
  return study;
}

}  // namespace cuticle::study
