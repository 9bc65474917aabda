#pragma once
// The main job on one small scene: bake, grow or load, simulate a head turn, shadow, render, study; pictures, data and demo.json.
#include <memory>
#include <string>

#include "core/progress.h"
#include "core/result.h"
#include "core/trace.h"
#include "gpu/device.h"

namespace cuticle::study {

struct DemoOptions {
  std::string scene_file;          ///< scenes/demo.json or scenes/demo_groom.json
  std::string groom_file;          ///< a real groom in place of the grown hair; empty: grow
  bool whole_project = true;       ///< a groom file that a .tfxproj beside it names: load the whole project
  double metres_per_unit = 0;      ///< of the groom file; 0 = guess and say so
  double radius = 0;               ///< metres; 0 = the file's own or the default
  std::string out;                 ///< folder to write
  int frames = 48;                 ///< simulated and rendered, 2 .. 2000
  bool study = true;               ///< false: leave the shadow study out
  int sheet_frames = 8;            ///< of them on the contact sheet, spread evenly
};

/// Runs the job and writes into `out`: lut/ (EXR, manifest, preview), frames/*.png, contact_sheet.png, state.hair, study/,
/// plan.json, costs.csv, and demo.json, which the report page is made from. Errors are those of the steps; files are whole.
Result<void> run_demo(std::shared_ptr<gpu::Device> device, const DemoOptions& options, Progress& progress, Trace* trace);

}  // namespace cuticle::study
