// What the table of errors promises of hair that it was not measured on holds there.
#include "study/plan/accuracy_gpu.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "gpu/tests/test_device.h"
#include "plan/plan.h"

namespace cuticle::study::accuracy_gpu_test {
namespace {

/// Grown hair, lit from the side, that no scene of the table has.
constexpr std::string_view k_scene = R"({"schema_version": 1, "strand_count": 4000, "strand_vertices": 16,
  "head": {"present": false}, "material": {"lut_size": 16, "layout": "nalu"},
  "lights": [{"to_light": [0.8, 0.4, 0.5], "irradiance": [3, 3, 3]}],
  "shadow": {"method": {"opacity_map": {}}}, "render": {"method": "tiles"},
  "camera": {"position_m": [0.2, 0.15, 1.1], "target_m": [0, 0.05, 0], "fov_deg": 24, "resolution_px": [128, 128]}})";

/// The error of one part of the scene with a row's setting.
double measured(const std::shared_ptr<gpu::Device>& device, const plan::AccuracyRow& row) {
  const scene::Scene scene = scene::parse_scene(k_scene, "/", "unseen", plan::catalogue()).value();
  const scene::Scene changed = plan::with_setting(scene, row).value();
  const std::vector<plan::AccuracyRow> errors = measure_scene(device, changed, silent_progress()).value();
  for (const plan::AccuracyRow& error : errors)
    if (error.part == row.part) return error.error;
  ADD_FAILURE() << "nothing measured of " << row.part;
  return 0;
}

TEST(AccuracyTable, ErrorsOnHairThatItWasNotMeasuredOn_StayBelowItsBounds) {
  const plan::AccuracyTable table = plan::read_accuracy_table(CUTICLE_SOURCE_DIR "/scenes/accuracy.json").value();
  int compared = 0;
  for (const plan::AccuracyRow& row : table.rows) {
    const bool chosen = row.method == "tiles" || row.settings == "layers=8,resolution=256" ||
                        row.settings == "slices=32,resolution=256";
    if (!chosen) continue;
    const double error = measured(tests::device(), row);
    std::printf("%s %s: %.4f, below %.4f with 95 %%\n", row.method.c_str(), row.settings.c_str(), error, row.at_most);
    EXPECT_LE(error, row.at_most) << row.method << " " << row.settings;
    EXPECT_GT(error, 0.02 * row.error) << row.method << " " << row.settings;
    ++compared;
  }
  EXPECT_EQ(compared, 3);
}

}  // namespace
}  // namespace cuticle::study::accuracy_gpu_test
