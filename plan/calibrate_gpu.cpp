#include "plan/calibrate_gpu.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <map>

#include <fmt/chrono.h>
#include <fmt/core.h>

namespace cuticle::plan {

namespace {

struct Size {
  int strands, pixels_each_way;
};
constexpr Size k_sizes[] = {{1000, 128}, {4000, 128}, {1000, 256}};
/// Of scenes that are asked afterwards whether their frames take what was expected.
constexpr Size k_unseen = {2500, 192};
constexpr double k_seconds_of_unseen = 6;
constexpr double k_seconds_of_frames = 0.4;

constexpr std::string_view k_lights = R"("lights": [{"to_light": [0.3, 0.6, 1], "irradiance": [3, 3, 3]}])";

/// What is timed together: a scene's keys.
std::vector<std::string> features() {
  const auto solved = [](std::string_view solver, std::string_view more) {
    return fmt::format(
        R"("simulation": {{"solver": {{"{}": {{}}}}, "effects": {{"gravity": {{}}, "colliders": {{}}, "wind": {{}}{}}}}},
      "colliders": {{"head": true}})",
        solver, more);
  };
  return {
      R"("render": {"method": "tiles"}, "shadow": {"method": {"deep_opacity": {}}}, )" + solved("exact", ""),
      R"("render": {"method": "lines"}, "shadow": {"method": {"opacity_map": {}}}, "floor": {"height_m": -0.2},
         "passes": {"surface_shadow": {}}, )" +
          solved("classic", ""),
      R"("render": {"method": "quads"}, "outputs": {"aovs": true}, "passes": {"velocity": {}, "temporal_antialiasing": {},
         "ambient_occlusion": {}, "depth_of_field": {}, "motion_blur": {}}, )" +
          solved("rod", R"(, "strand_interaction": {}, "clumping": {})"),
      R"("render": {"method": "cards"})",
      R"("render": {"method": "tiles"}, "passes": {"dual_scattering": {}})",
      R"("render": {"method": "tiles"}, "groom": {"follow_hairs": {"per_guide": 3, "reach_m": 0.003}}, "passes": {"velocity": {}})"};
}

Result<scene::Scene> scene_of(const std::string& feature, const Size& size) {
  return scene::parse_scene(
      fmt::format(
          R"({{"schema_version": 1, {}, {}, "strand_count": {}, "strand_vertices": 16, "material": {{"lut_size": 32, "layout": "nalu"}},
        "camera": {{"position_m": [0.2, 0.15, 1.1], "target_m": [0, 0.05, 0], "fov_deg": 24, "resolution_px": [{}, {}]}}}})",
          k_lights, feature, size.strands, size.pixels_each_way, size.pixels_each_way),
      "/", "calibration", catalogue());
}

class Calibration {
 public:
  Calibration(std::shared_ptr<gpu::Device> device, std::span<const AccuracyRow> settings, double seconds,
              Progress& progress)
      : device_(std::move(device)), settings_(settings), seconds_(seconds), progress_(progress) {}

  Result<void> run() {
    const std::vector<std::string> all = features();
    const std::vector<AccuracyRow> rows = rows_of_methods();
    const std::size_t steps = all.size() * (std::size(k_sizes) + 1) + rows.size();
    std::size_t done = 0;
    for (const std::string& feature : all)
      for (const Size& size : k_sizes) {
        if (late()) return {};
        CUTICLE_ASSIGN(const scene::Scene scene, scene_of(feature, size));
        CUTICLE_ASSIGN(const auto runner, FrameRunner::create(device_, scene, silent_progress()));
        CUTICLE_TRY(time(*runner, size));
        progress_.update("scenes timed", ++done, steps);
      }
    CUTICLE_TRY(time_methods(rows, done, steps));
    for (const std::string& feature : all) {
      CUTICLE_TRY(ask_unseen(feature));
      progress_.update("scenes timed", ++done, steps);
    }
    return {};
  }

  CostTable table() const {
    CostTable table{device_->info().name, device_->info().driver, {}, {}, most_of(ratios_)};
    table.made = fmt::format("{:%Y-%m-%d}, {:.0f} s", fmt::gmtime(std::time(nullptr)), spent());
    for (const auto& [name, measured] : measured_) table.passes[name] = fit_time(measured);
    return table;
  }

 private:
  /// Seconds; of the processor where that is the device, so that other programs do not cut the calibration short.
  double spent() const {
    const double clock = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    const double processor = double(std::clock() - processor_begin_) / CLOCKS_PER_SEC;
    return device_->info().is_software ? std::min(clock, processor) : clock;
  }
  bool late() const { return spent() > seconds_ - k_seconds_of_unseen; }

  /// The least of three frames, pass by pass; of fewer where they take long, beside which what a first frame has to
  /// prepare is little.
  Result<std::map<std::string, double>> least_times(FrameRunner& runner) {
    std::map<std::string, double> least;
    const double begin = spent();
    for (int frame = 0; frame < 3 && spent() - begin < k_seconds_of_frames; ++frame) {
      CUTICLE_ASSIGN(const FrameResult result, timed_frame(runner, *device_, frame, true));
      for (const gpu::PassCost& pass : result.cost.passes) {
        const auto [at, is_new] = least.emplace(pass.name, pass.gpu_ms);
        if (!is_new) at->second = std::min(at->second, pass.gpu_ms);
      }
    }
    return least;
  }

  Result<void> time(FrameRunner& runner, const Size& size, const AccuracyRow* setting = nullptr) {
    CUTICLE_ASSIGN(const auto least, least_times(runner));
    const double pixels = double(size.pixels_each_way) * size.pixels_each_way;
    for (const auto& [name, ms] : least)
      if (const PlannedPass* pass = find_pass(runner.plan(), name); pass && (!setting || name == setting->method))
        measured_[setting ? cost_name(*setting) : name].push_back(
            {pixels, units_of(*pass->entry, runner.plan().shape), ms});
    return {};
  }

  /// Each shadow method with its defaults, and with the settings that budgets choose from.
  std::vector<AccuracyRow> rows_of_methods() const {
    std::vector<AccuracyRow> rows;
    for (const registry::Entry* method : catalogue().methods) rows.push_back({"shadow", std::string(method->name), ""});
    for (const AccuracyRow& row : settings_)
      if (row.part == "shadow" && !row.settings.empty()) rows.push_back(row);
    return rows;
  }

  /// Over hair of two sizes.
  Result<void> time_methods(const std::vector<AccuracyRow>& rows, std::size_t& done, std::size_t steps) {
    constexpr Size k_both[] = {k_sizes[0], k_sizes[1]};
    std::vector<std::pair<scene::Scene, std::unique_ptr<FrameRunner>>> running;
    for (const Size& size : k_both) {
      CUTICLE_ASSIGN(const scene::Scene scene, scene_of(R"("render": {"method": "lines"})", size));
      CUTICLE_ASSIGN(auto runner, FrameRunner::create(device_, scene, silent_progress()));
      running.emplace_back(scene, std::move(runner));
    }
    for (const AccuracyRow& row : rows) {
      if (late()) return {};
      for (std::size_t k = 0; k < std::size(k_both); ++k) {
        const auto changed = with_setting(running[k].first, row);
        if (!changed || !running[k].second->change(*changed, silent_progress())) continue;  // supersampled has no kernel
        CUTICLE_TRY(time(*running[k].second, k_both[k], &row));
      }
      progress_.update("scenes timed", ++done, steps);
    }
    return {};
  }

  /// How much longer a frame of a size between those that were timed takes than the table expects.
  Result<void> ask_unseen(const std::string& feature) {
    if (spent() > seconds_) return {};
    CUTICLE_ASSIGN(const scene::Scene scene, scene_of(feature, k_unseen));
    CUTICLE_ASSIGN(const auto runner, FrameRunner::create(device_, scene, silent_progress()));
    CUTICLE_ASSIGN(const auto least, least_times(*runner));
    const CostTable known = table();
    double measured = 0, expected = 0;
    for (const auto& [name, ms] : least)
      if (const PlannedPass* pass = find_pass(runner->plan(), name))
        if (const auto ms_expected = predicted_ms(known, *pass->entry, runner->plan().shape, pixels_of(scene))) {
          measured += ms;
          expected += *ms_expected;
        }
    if (expected > 0 && measured > 0) ratios_.push_back(measured / expected);
    return {};
  }

  std::shared_ptr<gpu::Device> device_;
  std::span<const AccuracyRow> settings_;
  double seconds_;
  Progress& progress_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::clock_t processor_begin_ = std::clock();
  std::map<std::string, std::vector<TimedPass>> measured_;
  std::vector<double> ratios_;  ///< measured over expected, of frames that were not timed for the table
};

}  // namespace

Result<FrameResult> timed_frame(FrameRunner& runner, const gpu::Device& device, int frame, bool everything) {
  const std::clock_t begin = std::clock();
  CUTICLE_ASSIGN(FrameResult result, runner.run(frame, {.everything = everything}));
  if (!device.info().is_software || result.clock_ms <= 0) return result;
  const double processor_ms = 1000 * double(std::clock() - begin) / CLOCKS_PER_SEC;
  for (gpu::PassCost& pass : result.cost.passes) pass.gpu_ms *= processor_ms / result.clock_ms;
  return result;
}

Result<CostTable> calibrate(std::shared_ptr<gpu::Device> device, std::span<const AccuracyRow> settings, double seconds,
                            Progress& progress) {
  Calibration calibration(std::move(device), settings, seconds, progress);
  CUTICLE_TRY(calibration.run());
  return calibration.table();
}

}  // namespace cuticle::plan
