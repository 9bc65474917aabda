#include "study/picture/pose.h"

#include <algorithm>
#include <filesystem>

#include <fmt/core.h>

#include "bsdf/model.h"
#include "strands/formats/formats.h"

#ifndef _WIN32
#include <unistd.h>
#endif

namespace cuticle::study {
namespace {

namespace fs = std::filesystem;

constexpr float k_widest = 0.4999e-3f;  // metres: files of wider strands are read as of hair without a radius

/// A name that no other pose of this process or of another has.
std::string temporary_file() {
  static int count = 0;
  return (fs::temp_directory_path() / fmt::format("cuticle_pose_{}_{}.hair", ::getpid(), count++)).string();
}

}  // namespace

Pose::~Pose() {
  std::error_code ignored;
  if (!file_.empty()) fs::remove(file_, ignored);
}

Result<std::shared_ptr<Pose>> Pose::make(const std::shared_ptr<gpu::Device>& device, const scene::Scene& scene,
                                         int frame, Progress& progress) {
  const std::shared_ptr<Pose> pose(new Pose);
  if (is_simulated(scene)) {
    CUTICLE_ASSIGN(pose->moving_, plan::TracedSceneRunner::create(scene, progress));
    CUTICLE_TRY(pose->moving_->advance_to(frame, progress));
    CUTICLE_ASSIGN(strands::Groom moved, pose->moving_->drawn_strands());
    for (float& radius : moved.radii) radius = std::min(radius, k_widest);
    pose->frame_ = frame;
    pose->file_ = temporary_file();
    pose->opacity_ = pose->moving_->set().opacity;
    CUTICLE_TRY(strands::write_groom(pose->file_, moved));
  }
  scene::Scene plain = pose->at_rest(scene);
  plain.render_method = "lines";
  plain.passes.erase("dual_scattering");
  plain.shadow.reset();
  // Of the picture only the strands are used: the quickest tables, whatever the model.
  CUTICLE_ASSIGN(const bsdf::Model* quick, bsdf::find_model("marschner"));
  plain.material = {
      .model = {"marschner", registry::default_values(quick->entry.parameters)}, .layout = "nalu", .lut_size = 16};
  CUTICLE_ASSIGN(const auto runner, plan::FrameRunner::create(device, plain, progress));
  CUTICLE_TRY(runner->run(0));
  CUTICLE_ASSIGN(pose->drawn_, runner->drawn_strands());
  pose->camera_ = runner->camera(0);
  return pose;
}

scene::Scene Pose::at_rest(const scene::Scene& scene) const {
  scene::Scene still = scene;
  still.motion.reset();
  still.simulation = {};
  if (file_.empty()) return still;
  still.groom = {};
  still.groom.file = file_;
  still.groom.metres_per_unit = 1;
  still.groom.taper = 0;
  still.fibre_count = 0;  // the file's strands are as wide as they are drawn
  if (!still.fibre_alpha) still.fibre_alpha = glm::dvec3(opacity_);
  return still;
}

Result<void> Pose::simulate_further() {
  if (!moving_) return {};
  return moving_->advance_to(++frame_, silent_progress());
}

}  // namespace cuticle::study
