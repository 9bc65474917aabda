#pragma once
// From control hairs to a picture: drawn strands, shadows, the render passes, in the plan's order.
#include <memory>
#include <optional>
#include <vector>

#include "core/image/deep.h"
#include "core/progress.h"
#include "lut/table_set.h"
#include "plan/character_motion_gpu.h"
#include "plan/fin_motion_gpu.h"
#include "plan/frame_plan.h"
#include "plan/memory_meter_gpu.h"
#include "plan/plan.h"
#include "plan/strand_set.h"
#include "render/pass_gpu.h"
#include "strands/spline/drawn_gpu.h"

namespace cuticle::plan {

/// What changes from frame to frame.
struct PictureInput {
  const gpu::Buffer* control_positions = nullptr;
  strands::ControlMotion control_motion;  ///< without values where no pass asks
  strands::Bounds bounds;
  glm::dmat4 head{1};
  CharacterMotion* character = nullptr;  ///< moved to the frame; null: the scene has none
  bool records_character = false;        ///< its skin and hair are moved in the picture's submission
  const FinMotion* fins = nullptr;       ///< null: the scene has none
  Camera camera, camera_before;
  bool follows = false;                   ///< the picture painted before, a frame ago, by the same camera path
  const FramePlan* frame_plan = nullptr;  ///< which passes run; the others' results are those of an earlier picture
};

/// A picture, and what each pixel sees of each strand (objects from 1), with object 0 for what stands beside them.
struct ToldPicture {
  Image color;
  std::vector<SeenShare> shares;
};

class Picture {
 public:
  /// Errors: bad_input, of a pass, and of a picture so large that it is drawn in chunks where a pass or an output wants
  /// all of it at once.
  static Result<std::unique_ptr<Picture>> create(std::shared_ptr<gpu::Device> device, const scene::Scene& scene,
                                                 const StrandSet& set, const Plan& plan, const Camera& first_camera,
                                                 Progress& progress);
  /// The scene's model has other parameters: makes anew only what they touch. False: the whole picture must be made
  /// anew, as after an error.
  Result<bool> take_parameters(Progress& progress);
  /// Device memory by pass, with "drawn strands" and "targets".
  const MemoryMeter& memory() const { return memory_; }
  /// Runs the frame's passes after the simulation, in one submission, a large picture chunk by chunk. Where a pass's
  /// buffers were too small it runs again, with what comes after it; the cost is that of all submissions.
  Result<gpu::SubmitCost> paint(const PictureInput& input, Trace* trace);
  /// How often passes ran again in the picture last painted.
  std::uint32_t repeats() const { return repeats_; }
  /// Strands that cast shadows in a view of this camera.
  std::uint32_t casting_strands(const Camera& camera);
  /// What the passes left out of the picture last painted, one sentence each.
  const std::vector<std::string>& notes() const { return notes_; }
  Result<Image> read_color() const;
  /// The channels of the color with those of the passes 'aovs' and 'velocity'; empty where the first is not planned.
  Result<Image> read_aovs(const Image& color) const;
  /// The color, and what each pixel sees of each strand, of a scene that check_told_strands allows.
  Result<ToldPicture> read_told() const;
  Result<strands::Groom> read_strands() const;
  /// Null: none are baked.
  const lut::TableSet* tables() const;

 private:
  struct DrawnPass {
    std::string_view name;
    registry::Stage stage;
    bool draws;  ///< into the targets
    std::span<const render::Use> uses;
    std::unique_ptr<render::GpuPass> pass;
  };

  Picture(std::shared_ptr<gpu::Device> device, const scene::Scene& scene, const StrandSet& set, const Plan& plan)
      : device_(std::move(device)), scene_(scene), set_(set), plan_(plan), memory_(*device_) {}
  Result<void> make_generator();
  Result<void> make_strands();
  Result<void> make_material();
  Result<void> make_rest();
  Result<void> choose_chunks();
  Result<void> make_targets();
  Result<std::unique_ptr<render::GpuPass>> make_pass(const registry::Entry& entry);
  Result<void> make_passes();
  Result<void> check_uses() const;
  template <class Property>
  Property planned(Property render::Pass::*property) const;
  bool in_chunks() const { return resources_.get<render::FrameView>().part_size != glm::ivec2(0); }
  bool begins_frame() const { return !in_chunks() || resources_.get<render::FrameView>().part_corner == glm::ivec2(0); }
  void use_frame(const PictureInput& input);
  Result<gpu::SubmitCost> paint_part(Trace* trace);
  std::span<DrawnPass> passes_of_shadows();
  Result<void> paint_passes(Trace* trace, std::span<DrawnPass> passes, gpu::SubmitCost& spent);
  bool runs(std::string_view pass) const { return !frame_plan_ || frame_plan_->runs(pass); }
  Result<void> keep_part();
  Result<std::optional<registry::Stage>> settle(std::span<DrawnPass> passes);
  std::uint32_t strands_of_level() const;
  shadows::GpuStrands casters() const;
  Result<void> record_passes(gpu::Commands& commands, std::span<DrawnPass> passes, registry::Stage from);
  void clear_targets(gpu::Commands& commands);

  std::shared_ptr<gpu::Device> device_;
  const scene::Scene& scene_;
  const StrandSet& set_;
  const Plan& plan_;
  std::unique_ptr<strands::DrawnStrands> generator_;  ///< of the drawn strands
  strands::Groom rest_;                               ///< empty where no pass asks for it
  gpu::Texture color_, depth_, resolved_, output_;
  Image chunks_;  ///< the picture, of one that is drawn in chunks
  render::Resources resources_;
  std::vector<DrawnPass> passes_;
  std::vector<std::string> notes_;
  MemoryMeter memory_;
  const FramePlan* frame_plan_ = nullptr;  ///< of the picture being painted
  std::uint32_t repeats_ = 0;
  bool shadows_settled_ = false;  ///< a picture has been painted
};

}  // namespace cuticle::plan
