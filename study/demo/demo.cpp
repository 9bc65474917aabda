#include "study/demo/demo.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include <fmt/core.h>

#include "core/file.h"
#include "core/image/image.h"
#include "lut/format.h"
#include "plan/frame_runner_gpu.h"
#include "plan/plan_report.h"
#include "render/passes/reference/reference_entry.h"
#include "strands/formats/formats.h"
#include "strands/formats/tfxproj/project.h"
#include "study/demo/demo_page.h"
#include "study/demo/demo_study.h"
#include "study/demo/frame_numbers.h"

namespace cuticle::study {

namespace {

constexpr int k_traced_samples = 192;
constexpr double k_brightest_path = 4;  // of the path tracer, times white

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Sums of a pass over all frames.
struct PassTotal {
  double gpu_ms = 0;
  std::uint64_t dispatches = 0, draws = 0;
};

/// The job's state, one step a method; each step adds its section to the page.
class DemoJob {
 public:
  DemoJob(std::shared_ptr<gpu::Device> device, const DemoOptions& options, Progress& progress, Trace* trace)
      : device_(std::move(device)), options_(options), progress_(progress), trace_(trace) {}

  Result<void> run() {
    CUTICLE_TRY(make_folder(options_.out + "/frames"));
    CUTICLE_TRY(load());
    CUTICLE_TRY(write_tables());
    CUTICLE_TRY(run_frames());
    CUTICLE_TRY(write_pictures());
    add_frame_numbers();
    CUTICLE_TRY(add_traced_frame());
    add_notes();
    CUTICLE_TRY(write_costs());
    if (options_.study) CUTICLE_TRY(run_study());
    page_.title =
        fmt::format("Cuticle: {}", options_.groom_file.empty() ? "hair grown on the head" : options_.groom_file);
    return write_page(page_, options_.out);
  }

 private:
  Result<void> load() {
    CUTICLE_ASSIGN(scene_, scene::load_scene(options_.scene_file, plan::catalogue()));
    if (!options_.groom_file.empty()) {
      scene_.groom.file = groom_or_project();
      scene_.groom.metres_per_unit = options_.metres_per_unit;
      scene_.groom.radius = options_.radius;
    }
    CUTICLE_ASSIGN(runner_, plan::FrameRunner::create(device_, scene_, progress_, trace_));
    notes_.insert(notes_.end(), runner_->notes().begin(), runner_->notes().end());
    return write_text_file(options_.out + "/plan.json", plan::to_json(runner_->plan()));
  }

  /// A part of a hairdo is rarely what one wants to see: the project that names the file, where there is one.
  std::string groom_or_project() {
    const std::string project = options_.whole_project ? strands::project_of(options_.groom_file) : "";
    if (project.empty()) return options_.groom_file;
    notes_.push_back(fmt::format("{} is a part of {}: the whole of it is drawn (--part-only draws the part)",
                                 options_.groom_file, project));
    progress_.message(notes_.back());
    return project;
  }

  Result<void> write_tables() {
    const lut::TableSet& set = runner_->tables();
    CUTICLE_TRY(make_folder(options_.out + "/lut"));
    lut::TableSet certified = set;
    CUTICLE_TRY(lut::certify(certified, lut::half_exr(), progress_));
    CUTICLE_TRY(lut::write(certified, lut::half_exr(), options_.out + "/lut"));
    certified_ = certified;
    DemoSection section{
        "Lookup textures",
        fmt::format("Layout {}, {}x{}, model {}, baked on {} in {:.0f} ms. Errors after the engine's bilinear filter, "
                    "in half floats.",
                    set.layout->entry.name, set.size, set.size, set.model->entry.name, set.baked_on, set.bake_ms),
        {{"lut/preview.png", "the tables, tone mapped"}},
        {{"channel", "rms error / rms signal", "worst error / peak"}, {}}};
    for (const lut::Table& table : certified.tables)
      for (const lut::ChannelError& error : table.errors)
        section.table.rows.push_back({error.channel,
                                      fmt::format("{:.2e}", error.signal_rms > 0 ? error.rms / error.signal_rms : 0.0),
                                      fmt::format("{:.2e}", error.peak > 0 ? error.maximum / error.peak : 0.0)});
    page_.sections.push_back(std::move(section));
    return {};
  }

  Result<void> run_frames() {
    const auto start = std::chrono::steady_clock::now();
    for (int frame = 0; frame < options_.frames; ++frame) {
      CUTICLE_ASSIGN(plan::FrameResult result, runner_->run(frame, {.render = true, .read_state = true}));
      CUTICLE_TRY(keep_frame(frame, result));
      progress_.update("frames", std::size_t(frame) + 1, std::size_t(options_.frames));
    }
    frames_seconds_ = seconds_since(start);
    return {};
  }

  Result<void> keep_frame(int frame, const plan::FrameResult& result) {
    for (const std::string& note : result.notes)
      if (std::ranges::find(notes_, note) == notes_.end()) notes_.push_back(note);
    wall_ms_ += result.cost.wall_ms;
    for (const gpu::PassCost& pass : result.cost.passes) {
      PassTotal& total = totals_[pass.name];
      total.gpu_ms += pass.gpu_ms;
      total.dispatches += pass.dispatches;
      total.draws += pass.draws;
    }
    const std::vector<float> stretch = sim::stretch(runner_->control_groom(), result.state.positions);
    if (!stretch.empty())
      largest_stretch_ = std::max(largest_stretch_, *std::max_element(stretch.begin(), stretch.end()));
    const Image picture = tone_map(result.color, scene_.outputs.exposure_stops);
    if (on_sheet(frame)) sheet_.push_back(picture);
    return write_png(fmt::format("{}/frames/frame_{:04d}.png", options_.out, frame), picture);
  }

  bool on_sheet(int frame) const {
    const int count = std::clamp(options_.sheet_frames, 1, options_.frames);
    for (int k = 0; k < count; ++k)
      if (frame == (count == 1 ? 0 : k * (options_.frames - 1) / (count - 1))) return true;
    return false;
  }

  Result<void> write_pictures() {
    CUTICLE_TRY(write_png(options_.out + "/contact_sheet.png", contact_sheet(sheet_, 4)));
    CUTICLE_ASSIGN(drawn_, runner_->drawn_strands());
    CUTICLE_ASSIGN(auto notes, strands::write_groom(options_.out + "/state.hair", drawn_));
    for (const std::string& note : notes) progress_.message(note);
    page_.sections.insert(page_.sections.begin(),
                          {"Frames",
                           fmt::format("{} strands, {} vertices drawn; {} control hairs simulated over {} frames; "
                                       "longest segment {:.3f} of its rest length.",
                                       drawn_.strand_count(), drawn_.vertex_count(),
                                       runner_->control_groom().strand_count(), options_.frames, largest_stretch_),
                           {{"contact_sheet.png", "the head turn, camera turning"}},
                           {}});
    return {};
  }

  void add_frame_numbers() {
    if (!options_.study) return;
    page_.sections.insert(page_.sections.begin() + 1, frame_numbers(device_, scene_, certified_, drawn_, progress_));
  }

  /// The first frame by the path tracer, a third as wide and high.
  Result<void> add_traced_frame() {
    if (!options_.study) return {};
    scene::Scene traced = scene_;
    traced.render_method = "reference";
    traced.camera.camera.resolution /= 3;
    auto values = registry::default_values(render::reference::entry().entry.parameters);
    values.set("samples", std::int64_t(k_traced_samples));
    values.set("clamp_indirect", k_brightest_path * std::exp2(-scene_.outputs.exposure_stops));
    traced.passes["reference"] = values;
    CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device_, traced, progress_));
    CUTICLE_ASSIGN(const plan::FrameResult result, runner->run(0));
    CUTICLE_TRY(write_png(options_.out + "/traced.png", tone_map(result.color, scene_.outputs.exposure_stops)));
    page_.sections.insert(
        page_.sections.begin() + 2,
        {"The same frame by the path tracer",
         fmt::format("Frame 0 as it was drawn, beside the same frame with every scattering between fibres followed: {} "
                     "paths a pixel, at a third of the width and height. Against noise, light that scattered more than "
                     "once brings at most {:g} times white by one path, which darkens the picture slightly.",
                     k_traced_samples, k_brightest_path),
         {{"frames/frame_0000.png", scene_.render_method}, {"traced.png", "reference"}},
         {}});
    return {};
  }

  Result<void> write_costs() {
    const double frames = options_.frames;
    DemoSection section{"Plan and cost",
                        fmt::format("Only these passes ran, each for the reason given; {:.0f} ms a frame by wall clock "
                                    "on {}. Times are the device's timestamps, of a solver on the CPU the clock's.",
                                    wall_ms_ / frames, device_->info().name),
                        {},
                        {{"pass", "reason", "dispatches a frame", "draws a frame", "ms a frame"}, {}}};
    for (const plan::PlannedPass& pass : runner_->plan().passes) {
      const PassTotal total = totals_[std::string(pass.entry->name)];
      section.table.rows.push_back(
          {std::string(pass.entry->name), pass.reason, fmt::format("{:g}", double(total.dispatches) / frames),
           fmt::format("{:g}", double(total.draws) / frames), fmt::format("{:.2f}", total.gpu_ms / frames)});
    }
    CUTICLE_TRY(write_text_file(options_.out + "/costs.csv", csv_of(section.table)));
    page_.sections.push_back(std::move(section));
    page_.sections.push_back(left_out_section());
    progress_.message(fmt::format("{} frames in {:.1f} s, {:.0f} ms of device work a frame", options_.frames,
                                  frames_seconds_, wall_ms_ / frames));
    return {};
  }

  /// What did not run, by group, with what it would take.
  DemoSection left_out_section() const {
    const gpu::DeviceInfo& info = device_->info();
    plan::PlanCosts costs;
    costs.device = {info.name, info.is_software};
    if (auto table = plan::read_cost_table(plan::cost_table_path(info.name, info.driver)))
      costs.table = std::move(*table);
    const std::vector<plan::LeftOutEntry> entries = plan::explain_left_out(scene_, runner_->plan(), costs);
    DemoSection section{"What was left out",
                        costs.table ? "Times are expected from this device's calibration."
                                    : "Times are not measured on this device: cuticle plan --calibrate does so.",
                        {},
                        {{"group", "pass", "why", "to bring it in"}, {}}};
    if (costs.table) section.table.columns.emplace_back("would take");
    for (const plan::LeftOutEntry& entry : entries) {
      section.table.rows.push_back({std::string(plan::group_of(*entry.left->entry)), std::string(entry.left->entry->name),
                                    entry.left->reason, plan::words_of_way(entry)});
      if (costs.table) section.table.rows.back().push_back(plan::words_of_cost(entry));
    }
    for (const plan::GroupSaving& group : plan::savings(entries))
      if (group.entries > 0) section.text += " " + plan::words_of_saving(group) + ".";
    return section;
  }

  /// What was guessed or left out, as the terminal says it.
  void add_notes() {
    if (notes_.empty()) return;
    DemoSection section{
        "Notes on this hair", "What was guessed, left out or added when the hair was read.", {}, {{"note"}, {}}};
    for (const std::string& note : notes_) section.table.rows.push_back({note});
    page_.sections.push_back(std::move(section));
  }

  static std::string csv_of(const DemoTable& table) {
    std::string text;
    auto add = [&](const std::vector<std::string>& row) {
      for (std::size_t i = 0; i < row.size(); ++i) text += fmt::format("{}\"{}\"", i ? "," : "", row[i]);
      text += "\n";
    };
    add(table.columns);
    for (const auto& row : table.rows) add(row);
    return text;
  }

  Result<void> run_study() {
    CUTICLE_ASSIGN(DemoSection section, run_demo_study(drawn_, scene_, options_.out + "/study", progress_));
    page_.sections.push_back(std::move(section));
    return {};
  }

  std::shared_ptr<gpu::Device> device_;
  DemoOptions options_;
  Progress& progress_;
  Trace* trace_;
  scene::Scene scene_;
  lut::TableSet certified_;
  std::unique_ptr<plan::FrameRunner> runner_;
  strands::Groom drawn_;
  std::vector<Image> sheet_;
  std::vector<std::string> notes_;
  std::map<std::string, PassTotal> totals_;
  double wall_ms_ = 0, frames_seconds_ = 0;
  float largest_stretch_ = 1;
  DemoPage page_;
};

}  // namespace

Result<void> run_demo(std::shared_ptr<gpu::Device> device, const DemoOptions& options, Progress& progress,
                      Trace* trace) {
  if (options.frames < 2 || options.frames > 2000)
    return usage_error(fmt::format("--frames: {} is outside 2 .. 2000", options.frames));
  return DemoJob(std::move(device), options, progress, trace).run();
}

}  // namespace cuticle::study
