#include "viz/strands/strands_view.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <vtkCamera.h>
#include <vtkNew.h>
#include <vtkProperty.h>

#include "viz/draw/ticks.h"

namespace cuticle::viz {
namespace {

/// Colours that files and the toolkit can give to this state.
std::vector<std::string> names_for(const strands::Groom& groom) {
  std::vector<std::string> names;
  for (const auto& [name, attribute] : groom.attributes)
    if (name != "strand_id") names.push_back(name);
  for (const char* name : {"arc_length", "curvature", "twist", "level", "transmittance"})
    if (std::find(names.begin(), names.end(), name) == names.end()) names.emplace_back(name);
  return names;
}

/// A bar of a round length at the foot of all that is drawn.
void add_length_bar(vtkRenderer& renderer, const strands::Bounds& box, double scale) {
  double all[6];
  renderer.ComputeVisiblePropBounds(all);
  const double width = double(box.upper.x - box.lower.x);
  const std::vector<double> lengths = ticks(0, std::max(width, 1e-6), 4);
  const double length = lengths.size() > 1 ? lengths[1] : width;
  const glm::dvec3 from(double(box.lower.x), all[2] - 0.03 * (all[3] - all[2]), double(box.upper.z));
  renderer.AddActor(make_polyline({from, from + glm::dvec3(length, 0, 0)}, {.2, .2, .2}, 3 * scale));
  const std::string text =
      length >= 0.01 ? fmt::format("{:.3g} cm", 100 * length) : fmt::format("{:.3g} mm", 1000 * length);
  add_label(renderer, text, from + glm::dvec3(length * 1.05, 0, 0), 15 * scale);
}

}  // namespace

int StrandsPicture::frame_count() const { return int(view_.runs.front().frames.size()); }

int StrandsPicture::shown_frame(const Part& part) const {
  return std::min(view_.frame, int(part.run.frames.size()) - 1);
}

Result<void> StrandsPicture::load(Part& part) {
  const int frame = shown_frame(part);
  CUTICLE_ASSIGN(part.groom, read_frame(part.run, frame, view_.metres_per_unit));
  std::optional<strands::Groom> before;
  if (view_.coloring.name == "asleep" && frame > 0) {
    CUTICLE_ASSIGN(before, read_frame(part.run, frame - 1, view_.metres_per_unit));
  }
  CUTICLE_ASSIGN(part.colored, color_strands(part.groom, view_.coloring, before ? &*before : nullptr));
  const RunFrame& shown = part.run.frames[std::size_t(frame)];
  const std::string at = part.run.frames.size() > 1 ? fmt::format(", frame {}, {:.3f} s", frame, shown.time) : "";
  part.title->SetInput(fmt::format("{}{}: {} strands, {} vertices", part.run.name, at, part.groom.strand_count(),
                                   part.groom.vertex_count())
                           .c_str());
  return {};
}

/// One scale for all frames of a run, from the shown, the middle and the last.
Result<void> StrandsPicture::fit_scale() {
  ColoredStrands all = parts_.front().colored;
  for (const Part& part : parts_) {
    all.values.insert(all.values.end(), part.colored.values.begin(), part.colored.values.end());
    const int count = int(part.run.frames.size());
    for (const int frame : {count / 2, count - 1}) {
      if (count < 2 || view_.coloring.name.starts_with("error:")) continue;
      CUTICLE_ASSIGN(const strands::Groom groom, read_frame(part.run, frame, view_.metres_per_unit));
      CUTICLE_ASSIGN(const ColoredStrands colored, color_strands(groom, view_.coloring));
      all.values.insert(all.values.end(), colored.values.begin(), colored.values.end());
    }
  }
  scale_ = scale_of(all);
  bar_->set(density_scale_.value_or(scale_));
  return {};
}

Result<void> StrandsPicture::fill(const WindowArea& area) {
  size_ = area.scale;
  const bool two = view_.runs.size() == 2;
  const double width = two ? 0.38 : 0.66;
  for (std::size_t k = 0; k < view_.runs.size(); ++k) {
    Part part;
    part.run = view_.runs[k];
    part.renderer = area.add_renderer(width * double(k), 0, width * double(k + 1), 1);
    part.title = add_text(*part.renderer, "", 0.025, 0.975, 17 * size_, true);
    parts_.push_back(std::move(part));
    CUTICLE_TRY(load(parts_.back()));
  }
  bar_.emplace(*parts_.front().renderer, size_);
  color_names_ = names_for(parts_.front().groom);
  CUTICLE_TRY(fit_scale());
  for (Part& part : parts_) {
    draw(part);
    CUTICLE_TRY(draw_surroundings(part));
  }
  const double x0 = width * double(parts_.size());
  const auto is_series = [](const Part& part) { return part.run.frames.size() > 1; };
  const bool has_time = std::any_of(parts_.begin(), parts_.end(), is_series);
  along_.emplace(*area.add_renderer(x0, has_time ? 0.5 : 0.25, 1, 1), size_);
  if (has_time) {
    over_time_.emplace(*area.add_renderer(x0, 0, 1, 0.5), size_);
  } else {
    area.add_renderer(x0, 0, 1, 0.25);  // what no renderer clears is black
  }
  std::tie(strand_, vertex_) = largest();
  if (view_.strand)
    strand_ = std::min(*view_.strand, parts_[0].groom.strand_count() - 1),
    vertex_ = parts_[0].groom.offsets[strand_ + 1] - 1;
  look();
  return update_curves();
}

void StrandsPicture::look() {
  vtkRenderer& first = *parts_.front().renderer;
  vtkCamera& camera = *first.GetActiveCamera();
  add_length_bar(first, strands::bounds(parts_.front().groom), size_);
  camera.SetViewUp(0, 1, 0);
  camera.SetFocalPoint(0, 0, 0);
  camera.SetPosition(0.45, 0.25, 1);
  first.ResetCamera();
  camera.SetWindowCenter(0, -0.06);
  camera.Zoom(0.98);
  for (Part& part : parts_) part.renderer->SetActiveCamera(&camera);
}

std::pair<std::size_t, std::size_t> StrandsPicture::largest() const {
  const Part& part = parts_.front();
  std::size_t best = 0;
  const auto away = [&](std::size_t v) { return std::abs(double(part.colored.values[v]) - part.colored.neutral); };
  for (std::size_t v = 1; v < part.colored.values.size(); ++v)
    if (away(v) > away(best)) best = v;
  const auto after = std::upper_bound(part.groom.offsets.begin(), part.groom.offsets.end(), std::uint32_t(best));
  return {std::size_t(after - part.groom.offsets.begin()) - 1, best};
}

/// Value of the picked vertex in up to 120 frames of the run, evenly spread.
Result<std::vector<glm::dvec2>> StrandsPicture::over_time(const Part& part, std::size_t strand,
                                                          std::size_t vertex) const {
  std::vector<glm::dvec2> points;
  const std::size_t count = part.run.frames.size(), step = std::max<std::size_t>(1, (count + 119) / 120);
  const std::size_t index = vertex - part.groom.offsets[strand];
  for (std::size_t frame = 0; frame < count; frame += step) {
    CUTICLE_ASSIGN(const strands::Groom groom, read_frame(part.run, int(frame), view_.metres_per_unit));
    if (strand >= groom.strand_count() || index >= groom.strand_size(strand)) continue;
    StrandColoring coloring = view_.coloring;
    CUTICLE_ASSIGN(const ColoredStrands colored, color_strands(groom, coloring));
    points.emplace_back(part.run.frames[frame].time, double(colored.values[groom.offsets[strand] + index]));
  }
  return points;
}

Result<void> StrandsPicture::update_curves() {
  PlotContent along{fmt::format("strand {} along its length", strand_), {"arc length [mm]"}, {parts_[0].colored.title}};
  PlotContent time{"its marked vertex over time", {"time [s]"}, {parts_[0].colored.title}};
  const glm::dvec3 colors[] = {{.16, .42, .68}, {.80, .40, .10}};
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    Part& part = parts_[k];
    show_strand(part);
    if (strand_ >= part.groom.strand_count()) continue;
    const std::vector<float> lengths = arc_lengths(part.groom);
    Curve curve{parts_.size() == 2 ? part.run.name : "", {}, colors[k]};
    for (std::size_t v = part.groom.offsets[strand_]; v < part.groom.offsets[strand_ + 1]; ++v)
      curve.points.emplace_back(1e3 * double(lengths[v]), double(part.colored.values[v]));
    along.x.upper = std::max(k == 0 ? 1e-6 : along.x.upper, curve.points.back().x);
    if (k == 0)
      along.marks = {{{1e3 * double(lengths[vertex_]), double(part.colored.values[vertex_])}, "", {.75, .1, .1}}};
    along.curves.push_back(std::move(curve));
    if (part.run.frames.size() < 2 || view_.coloring.name.starts_with("error:")) continue;
    CUTICLE_ASSIGN(auto points, over_time(part, strand_, vertex_));
    time.x.upper = std::max(k == 0 ? 1e-6 : time.x.upper, points.back().x);
    time.curves.push_back({parts_.size() == 2 ? part.run.name : "", std::move(points), colors[k]});
  }
  if (time.curves.empty()) time.title = "not over time: each frame's truth is traced anew";
  fit_y(along);
  fit_y(time);
  along_->set(std::move(along));
  if (over_time_) over_time_->set(std::move(time));
  return {};
}

Result<void> StrandsPicture::show_frame(int frame) {
  view_.frame = frame;
  for (Part& part : parts_) {
    CUTICLE_TRY(load(part));
    draw(part);
    CUTICLE_TRY(draw_surroundings(part));
    show_strand(part);
  }
  return {};
}

void StrandsPicture::turn(double degrees) {
  parts_.front().renderer->GetActiveCamera()->Azimuth(degrees);
  for (Part& part : parts_) part.renderer->ResetCameraClippingRange();
}

void StrandsPicture::set_moving(bool moving) {
  for (Part& part : parts_) {
    if (!part.some) continue;
    part.all->SetVisibility(!moving);
    part.some->SetVisibility(moving);
  }
}

Result<void> StrandsPicture::set_color(std::size_t choice) {
  view_.coloring.name = color_names_[choice];
  CUTICLE_TRY(show_frame(view_.frame));
  CUTICLE_TRY(fit_scale());
  for (Part& part : parts_) draw(part);
  return update_curves();
}

std::vector<Control> StrandsPicture::controls() {
  std::vector<Control> list;
  if (frame_count() > 1)
    list.push_back(
        {"frame", "", 0, double(frame_count() - 1), double(view_.frame), {}, true, [this](double value, bool) {
           return show_frame(int(value));
         }});
  Control color{"color", "", 0, double(color_names_.size() - 1)};
  color.choices = color_names_;
  const auto shown = std::find(color_names_.begin(), color_names_.end(), view_.coloring.name);
  color.value = shown == color_names_.end() ? 0 : double(shown - color_names_.begin());
  color.set = [this](double value, bool resting) { return resting ? Result<void>() : set_color(std::size_t(value)); };
  list.push_back(std::move(color));
  return list;
}

Result<void> StrandsPicture::write_files(const std::string& folder) { return write_strands(view_, folder); }

}  // namespace cuticle::viz
