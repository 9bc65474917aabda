#pragma once
// The scene file (JSON, docs/scene.schema.json) as data. Knows no effect by name: blocks are tables checked against a
// Catalogue.
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/keyed_motion.h"
#include "core/registry/entry.h"
#include "core/rounded_box.h"
#include "core/view.h"
#include "scene/environment.h"
#include "strands/character/convention.h"
#include "strands/formats/format.h"
#include "strands/growing/specification.h"

namespace cuticle::scene {

/// The registered entries that a scene may name. The caller gathers them (plan::catalogue()).
struct Catalogue {
  std::vector<const registry::Entry*> models, layouts, methods, effects, passes;
  std::vector<const registry::Entry*>
      solvers;  ///< those of sim::effects() that are solvers; `effects` holds the others
};

/// A registered thing with its validated parameters.
struct Block {
  std::string name;
  registry::ParameterValues values;
  bool operator==(const Block&) const = default;
};

struct GroomSource {
  std::string file;                                  ///< absolute path; empty: grown on the head by `grow`
  double metres_per_unit = 0;                        ///< 0 = guess, and say so
  double radius = 0;                                 ///< metres; 0 = the file's own, or strands::k_default_radius
  bool interpolate = false;                          ///< a file's strands are control hairs; false: drawn as they are
  std::optional<strands::FollowHairs> follow_hairs;  ///< beside each strand of a file or a specification; absent: as
                                                     ///< the file asks
  int segment_parts = 0;        ///< of segments of strands that are drawn as they are, at whose ends light is found; 0:
                                ///< as many as plan chooses
  double thickness_spread = 0;  ///< of strands that are drawn as they are, by chance
  std::optional<double> taper;  ///< share of a root's radius that is gone at the tip; absent: taper_of in plan
  strands::Style grow;          ///< where neither file nor specification gives hair
  std::optional<strands::GroomingSpecification> specification;  ///< present: its strands are the hair, all of them
};
struct HeadSource {
  bool present = true;  ///< false: bare strands
  std::string mesh;     ///< OBJ file; empty: the procedural head
  bool bust = false;    ///< shoulders are drawn below the procedural head
  bool fit = false;     ///< the procedural head is scaled and moved to the roots of a groom file
  double metres_per_unit = 1;
};
struct MotionSource {
  std::string bvh;  ///< absolute path
  std::string joint = "Head";
  double start_time = 0;       ///< seconds into the clip
  double amplitude = 1;        ///< rotation scaled about the first frame
  double metres_per_unit = 0;  ///< of the joint's travel away from the first frame; 0: the head turns where it is
};
struct CharacterSource {
  std::string file;                ///< glTF 2.0, absolute path
  std::string clip;                ///< repeats; empty: the character rests
  bool dual_quaternions = false;   ///< false: linear blending, as glTF prescribes
  double start_time = 0;           ///< seconds into the clip
  strands::Convention convention;  ///< of the file
};
struct MaterialSource {
  Block model;                      ///< bsdf model with its parameters
  std::string evaluate = "tables";  ///< or "direct": by the model's formulas
  std::string layout = "auto";
  int lut_size = 128;
  bool operator==(const MaterialSource&) const = default;
};
struct SimulationSource {
  std::optional<Block> solver;  ///< absent: nothing moves but what the head moves rigidly
  std::map<std::string, registry::ParameterValues, std::less<>> effects;
  double settle_time = 0;         ///< seconds simulated before frame 0, the head at rest
  std::string solve_on = "auto";  ///< or "cpu", "device"
  bool operator==(const SimulationSource&) const = default;
};
/// Sheets that hang on the head.
struct FinSource {
  std::string mesh;            ///< OBJ with texture coordinates, absolute path; the head's rest space
  std::string weights;         ///< picture, absolute path: 0 rigid .. 1 simulated, over the texture coordinates
  double metres_per_unit = 1;  ///< of the mesh
};
/// A closed mesh that hair may not enter, as a distance field.
struct MeshCollider {
  std::string file;            ///< .obj, .glb or .gltf; absolute path; the head's rest space
  double spacing = 0;          ///< of the grid's nodes, metres
  double metres_per_unit = 1;  ///< of an OBJ
};
/// A collider that moves by itself: its shape is given in a frame that the keys place in the world, or on the head.
struct MovingShape {
  std::variant<Sphere, RoundedBox, MeshCollider> shape;
  KeyedMotion motion;    ///< times in seconds from frame 0
  bool on_head = false;  ///< keys are in the head's rest space, and the head moves the whole
};
/// Where a moving camera is at a time, smoothly between; two at one time: a cut.
struct CameraKey {
  double time = 0;  ///< seconds from frame 0
  glm::dvec3 position{0}, target{0};
  double vertical_field_of_view = 0.5;  ///< radians
};
struct CameraPath {
  Camera camera;
  std::vector<CameraKey> keys = {};        ///< times never fall; held before the first and after the last
  bool follows_head = false;               ///< travels, but does not turn, with the head
  double turntable_degrees_per_frame = 0;  ///< about the target's vertical axis
  bool automatic = false;                  ///< framed on the hair: position and target are not used
};
/// The picture that the last `lights` of the scene's lights were made of.
struct EnvironmentSource {
  std::string file;  ///< absolute path
  Environment settings;
  std::size_t lights = 0;
};
struct Outputs {
  bool color = true, aovs = false;
  bool deep = false, cryptomatte = false;  ///< samples in depth; mattes by strand, groom and material
  double exposure_stops = 0;
  /// What each pixel sees of each strand is wanted.
  bool tells_strands() const { return deep || cryptomatte; }
};

/// What a frame may take and how far off it may be; 0: not asked for.
struct Budgets {
  double frame_ms = 0, memory_mb = 0;
  double shadow = 0, shading = 0, coverage = 0, motion = 0;  ///< errors, as the study's tables have them
  bool operator==(const Budgets&) const = default;
};

/// The ways in which strands become pixels.
inline constexpr std::string_view k_render_methods[] = {"lines", "quads", "tiles", "cards", "supersampled", "reference"};

struct Scene {
  int schema_version = 1;
  std::string name;
  GroomSource groom;
  HeadSource head;
  std::optional<MotionSource> motion;
  std::optional<CharacterSource> character;  ///< what hair grows on instead of a head; moves by itself
  MaterialSource material;
  SimulationSource simulation;
  std::vector<Sphere> colliders;  ///< in the head's rest space; "head": true in the file adds the head's own spheres
  bool head_colliders = false;
  std::vector<RoundedBox> boxes;  ///< colliders as well: the file's capsules, then its boxes
  std::vector<MeshCollider> mesh_colliders;
  std::vector<MovingShape> moving_colliders;  ///< of all kinds, those that have a motion of their own
  std::optional<FinSource> fins;
  std::optional<Floor> floor;
  std::vector<Light> lights;
  std::optional<EnvironmentSource> environment;
  std::optional<Block> shadow;  ///< shadow method with its parameters
  /// Opacity of one crossing, of red, green and blue light; none: of opaque fibres, by width and number
  /// (plan/file_strands.h).
  std::optional<glm::dvec3> fibre_alpha;
  double caster_share = 1;  ///< of the drawn strands that cast shadows, wider by as much
  CameraPath camera;
  double frames_per_second = 30;
  int strand_vertices = 30;  ///< per drawn strand, 2 .. strands::k_max_vertices
  int strand_count = 4095;   ///< drawn strands
  double fibre_count = 0;    ///< fibres that the drawn strands stand for; they are as wide as these together; 0: not
                             ///< given, k_usual_fibre_count, or of a file that carries radii its strands
  Outputs outputs;
  std::string render_method = "lines";  ///< of k_render_methods
  std::optional<Budgets> budgets;
  std::map<std::string, registry::ParameterValues, std::less<>>
      passes;                      ///< of render passes, by name; absent: defaults
  std::vector<std::string> notes;  ///< what of the file is not used, one sentence each
};

inline constexpr double k_usual_fibre_count = 100000;

/// Whether strands are drawn with their own vertices: a file's, and a specification's with follow hairs; hair cards are
/// made of resampled ones.
inline bool draws_as_given(const Scene& scene) {
  const bool of_file = !scene.groom.file.empty() && !scene.groom.interpolate,
             followed = scene.groom.specification && scene.groom.follow_hairs;
  return (of_file || followed) && scene.render_method != "cards";
}

/// Loads and validates. Errors name file and key, the allowed range, and for an unknown key the nearest known one.
Result<Scene> load_scene(const std::string& path, const Catalogue& catalogue);
/// All that is wrong with a scene file, the first 50 at most; empty: load_scene loads it.
std::vector<Error> check_scene(const std::string& path, const Catalogue& catalogue);
/// From text; `folder` resolves relative paths, `where` names the source in errors.
Result<Scene> parse_scene(std::string_view json, const std::string& folder, const std::string& where,
                          const Catalogue& catalogue);
/// The JSON Schema (draft 7), generated from the catalogue.
std::string scene_schema(const Catalogue& catalogue);

}  // namespace cuticle::scene
