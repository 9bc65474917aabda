#pragma once
// What a scene and its motion give to the passes of a frame: resources that no pass writes.
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>

#include "bsdf/model.h"
#include "core/view.h"
#include "render/resource.h"
#include "strands/groom.h"
#include "strands/mesh.h"

namespace cuticle::render {

struct FrameView {
  Camera camera;
  Camera camera_before;                ///< of the frame before; the frame's own in the first
  std::uint32_t frames_since_cut = 1;  ///< frames that follow each other, this one with them
  double frame_duration = 0;           ///< seconds
  double strand_widening = 1;          ///< of the strands drawn, which stand for those that found no room (tile_lists)
  /// Of a picture that is drawn in chunks, the one that the targets hold: pixels; no size: all of the picture.
  glm::ivec2 part_corner{0}, part_size{0};
};
constexpr std::string_view resource_name(const FrameView*) { return "view"; }

struct Lights {
  std::vector<Light> all;
};
constexpr std::string_view resource_name(const Lights*) { return "lights"; }

struct FibreMaterial {
  const bsdf::Model* model = nullptr;
  const registry::ParameterValues* values = nullptr;  ///< of the model
  std::string layout;                                 ///< of its tables
  int lut_size = 128;
  bool evaluates_directly = false;  ///< strands are shaded by the model's formulas, not by tables
};
constexpr std::string_view resource_name(const FibreMaterial*) { return "material"; }

struct FibreOpacity {
  glm::dvec3 alpha{0.4};  ///< of one crossing per channel, as shadows have it
};
constexpr std::string_view resource_name(const FibreOpacity*) { return "opacity"; }

struct Surfaces {
  const strands::Mesh* head = nullptr;   ///< rest pose; null: none
  const strands::Mesh* scalp = nullptr;  ///< the part of the head where hair grows, rest pose; may be null
  glm::dmat4 head_transform{1};
  std::optional<Floor> floor;
  const strands::Mesh* fins = nullptr;  ///< at rest; null: none
};
constexpr std::string_view resource_name(const Surfaces*) { return "surfaces"; }

/// The strands that will be drawn, as the control hairs rest.
struct RestStrands {
  const strands::Groom* groom = nullptr;
};
constexpr std::string_view resource_name(const RestStrands*) { return "rest_strands"; }

}  // namespace cuticle::render
