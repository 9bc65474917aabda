#pragma once
// Scenes without numpy: hair at rest, plans and frames. (Headers of strand motion and of nanobind each define
// NAMESPACE_BEGIN, so that no source may include both.)
#include <memory>

#include "core/image/deep.h"
#include "core/progress.h"
#include "scene/scene.h"
#include "strands/groom.h"
#include "strands/mesh.h"

namespace cuticle::python {

/// Error: those of scene::parse_scene.
Result<scene::Scene> parse_scene(const std::string& json, const std::string& folder);
/// Error: those of plan::build_strand_set.
Result<std::string> plan_of(const scene::Scene& scene);

struct HairAtRest {
  strands::Groom control, drawn;
  strands::Mesh head;           ///< empty where the scene has none
  std::vector<Sphere> spheres;  ///< colliders in the head's rest space
  std::vector<std::string> notes;
};
Result<HairAtRest> hair_at_rest(const scene::Scene& scene);

struct PaintedFrame {
  Image color, layers;
  std::vector<SeenShare> shares;
  std::vector<std::string> notes;
};
/// What may change in a scene that is ready to be drawn.
inline constexpr std::string_view k_changed_blocks[] = {"camera", "material", "passes",
                                                        "render", "shadow",   "simulation"};
/// A scene that is ready to be drawn.
class Frames {
 public:
  virtual ~Frames() = default;
  virtual Result<PaintedFrame> run(int frame, Progress& progress) = 0;
  /// `given`'s blocks of these names (k_changed_blocks), as a scene file has them, in place of the scene's own; where
  /// they are refused, the scene stands. Errors: those of FrameRunner::change; usage, on the CPU.
  virtual Result<void> change(const scene::Scene& given, const std::vector<std::string>& blocks,
                              Progress& progress) = 0;
  virtual glm::ivec2 resolution() const = 0;
  virtual Result<strands::Groom> strands() = 0;
  virtual std::string plan() const = 0;  ///< JSON
  virtual std::string device() const = 0;
};
/// 'reference' on the CPU where `device` names none and nothing needs one; else Vulkan. Error: no_device, where there
/// is no Vulkan; those of the runners.
Result<std::unique_ptr<Frames>> open_frames(const scene::Scene& scene, const std::string& device, Progress& progress);

}  // namespace cuticle::python
