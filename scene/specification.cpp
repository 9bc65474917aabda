#include "scene/specification.h"

#include <iterator>

#include "strands/spline/smooth.h"

namespace cuticle::scene {

namespace {

constexpr double k_metres = 1000;  // scenes live within a kilometre of their origin

Spec real(std::string key, double minimum, double maximum, std::string summary) {
  return {.key = std::move(key),
          .kind = SpecKind::real,
          .summary = std::move(summary),
          .minimum = minimum,
          .maximum = maximum};
}
Spec integer(std::string key, double minimum, double maximum, std::string summary) {
  return {.key = std::move(key),
          .kind = SpecKind::integer,
          .summary = std::move(summary),
          .minimum = minimum,
          .maximum = maximum};
}
Spec boolean(std::string key, std::string summary) {
  return {.key = std::move(key), .kind = SpecKind::boolean, .summary = std::move(summary)};
}
Spec text(std::string key, std::string summary) {
  return {.key = std::move(key), .kind = SpecKind::text, .summary = std::move(summary)};
}
Spec file(std::string key, std::string summary) {
  return {.key = std::move(key), .kind = SpecKind::file, .summary = std::move(summary)};
}
Spec numbers(std::string key, int count, double minimum, double maximum, std::string summary) {
  return {.key = std::move(key),
          .kind = SpecKind::numbers,
          .summary = std::move(summary),
          .minimum = minimum,
          .maximum = maximum,
          .count = count};
}
Spec rgb(std::string key, double minimum, double maximum, std::string summary) {
  Spec spec = numbers(std::move(key), 3, minimum, maximum, std::move(summary));
  spec.kind = SpecKind::rgb;
  return spec;
}
Spec object(std::string key, std::string summary, std::vector<Spec> children) {
  return {
      .key = std::move(key), .kind = SpecKind::object, .summary = std::move(summary), .children = std::move(children)};
}
Spec array(std::string key, int most, std::string summary, Spec item) {
  return {.key = std::move(key),
          .kind = SpecKind::array,
          .summary = std::move(summary),
          .maximum = double(most),
          .children = {std::move(item)}};
}
Spec block(std::string key, std::string summary, std::vector<const registry::Entry*> entries) {
  return {.key = std::move(key), .kind = SpecKind::block, .summary = std::move(summary), .entries = std::move(entries)};
}
Spec blocks(std::string key, std::string summary, std::vector<const registry::Entry*> entries) {
  return {
      .key = std::move(key), .kind = SpecKind::blocks, .summary = std::move(summary), .entries = std::move(entries)};
}
Spec required(Spec spec) {
  spec.required = true;
  return spec;
}

Spec follow_hairs() {
  return object("follow_hairs",
                "hairs drawn beside each strand of a file or a specification; of a TressFX project in place of its own",
                {required(integer("per_guide", 0, double(strands::k_max_follow_hairs), "beside each strand")),
                 required(real("reach_m", 0, 1, "how far a root may lie from its guide's along each of two axes")),
                 real("tip_separation", -1, 1000,
                      "at the tip a hair is 1 + this times as far from its guide as at the root; below 0 they clump")});
}

Spec groom() {
  Spec grow{.key = "grow",
            .kind = SpecKind::parameters,
            .summary = "how hair grows on the head's scalp",
            .table = registry::table_of<strands::Style>()};
  return object(
      "groom", "the hair: a file, or grown on the head",
      {file("file", "strands: a groom file, of any format of strands/formats"),
       real("metres_per_unit", 0, 1000, "scale of the file; 0 = guess"),
       real("radius_m", 0, 1e-3, "fibre radius; 0 = the file's own, or 35 micrometres"),
       boolean("interpolate",
               "the file's strands are control hairs: smoothed, strand_count strands between them; false unless given: "
               "they are drawn as they are, with follow hairs where a TressFX project asks for them"),
       follow_hairs(),
       integer("segment_parts", 0, 64,
               "parts of each segment, where strands are drawn as given, between which light is interpolated: long "
               "segments show it; 0: segments above 10 mm in the mean have parts of 4 mm, at most 8, unless drawn as 'lines'"),
       real("thickness_spread", 0, 1,
            "share by which chance makes strands thicker and thinner that are drawn as given"),
       real("taper", 0, 1,
            "share of a strand's radius that is gone at its tip; absent: 0 for a file that carries radii, else 0.5"),
       std::move(grow),
       file("specification", "grooming specification (docs/grooming.schema.json) whose strands are the hair")});
}

Spec head() {
  return object(
      "head", "what the hair grows on; with a groom file there is no head unless this is given",
      {boolean("present", "false: bare strands"),
       file("mesh",
            "OBJ, y up, facing +z; where hair is grown on it, it is scaled and moved until its skull lies on the "
            "procedural head's; absent: the procedural head"),
       boolean("or_procedural", "the procedural head where the file of the mesh is not there; false unless given"),
       boolean("bust", "shoulders are drawn below the procedural head"),
       boolean("fit", "the procedural head is scaled and moved to the roots of a groom file"),
       real("metres_per_unit", 1e-6, 1000, "scale of the mesh")});
}

Spec motion() {
  return object("motion", "how the head moves",
                {required(file("bvh", "BVH clip")), text("joint", "joint that the head follows"),
                 real("start_time_s", 0, 1e6, "time in the clip of frame 0"),
                 real("amplitude", 0, 10, "factor on the rotation away from frame 0"),
                 real("metres_per_unit", 0, 1000, "scale of the joint's travel; 0 unless given: the head only turns")});
}

Spec character() {
  Spec skinning = text("skinning", "how joints move the mesh; linear_blend, which glTF prescribes, unless given");
  skinning.choices = {"linear_blend", "dual_quaternion"};
  return object(
      "character", "a skinned growth mesh instead of a head; hair grows on all of it, or a groom file is bound to it",
      {required(file("file", "glTF 2.0: .glb or .gltf")), text("clip", "animation that repeats; absent: at rest"),
       std::move(skinning), real("start_time_s", 0, 1e6, "time in the clip of frame 0"),
       file("convention", "JSON: metres_per_unit, up, forward; absent: guessed unit, +y up, facing +z")});
}

Spec material(const Catalogue& catalogue) {
  Spec layout = text("layout", "layout of the lookup tables; auto: the one that loses least of the model's light");
  layout.choices = {"auto"};
  for (const registry::Entry* entry : catalogue.layouts) layout.choices.emplace_back(entry->name);
  Spec evaluate = text("evaluate",
                       "tables: lookups in tables of the model, unless given; direct: its formulas at every "
                       "vertex of strands");
  evaluate.choices = {"tables", "direct"};
  return object("material", "how a fibre scatters light",
                {block("model", "scattering model and its parameters", catalogue.models), std::move(evaluate),
                 std::move(layout), integer("lut_size", 16, 1024, "texels along each side of a table")});
}

Spec simulation(const Catalogue& catalogue) {
  Spec solve_on = text("solve_on",
                       "cpu: the CPU's code; device: kernels; auto, unless given: kernels, but on a device "
                       "without a GPU the CPU's code, which is quicker there");
  solve_on.choices = {"auto", "cpu", "device"};
  return object("simulation", "what moves the hair; absent: it follows the head rigidly",
                {required(block("solver", "solver and its parameters", catalogue.solvers)),
                 blocks("effects", "effects that act, each with its parameters", catalogue.effects),
                 real("settle_time_s", 0, 60, "simulated before frame 0, the head at rest"), std::move(solve_on)});
}

Spec collider_motion() {
  Spec key = object("", "where the frame in which the collider is given stands at a time",
                    {required(real("time_s", -1e6, 1e6, "from frame 0; not before that of the key above")),
                     numbers("position_m", 3, -k_metres, k_metres, "of its origin; 0 unless given"),
                     numbers("turn_axis", 3, -1e6, 1e6, "axis through the origin about which it is turned"),
                     real("turn_degrees", -360, 360, "by so much; needs turn_axis")});
  return object(
      "motion", "moves by itself; straight, and turning the short way, between keys; two at one time: a jump",
      {required(array("keys", 4096, "held before the first and after the last", std::move(key))),
       boolean("on_head", "keys are in the head's rest space and the head moves the whole; else in the world")});
}

Spec colliders() {
  Spec sphere = object("", "one sphere, in the head's rest space; with a character in the world",
                       {required(numbers("center_m", 3, -k_metres, k_metres, "centre")),
                        required(real("radius_m", 1e-6, k_metres, "radius")), collider_motion()});
  Spec capsule = object("",
                        "all that is no farther than a radius from a straight line, in the head's rest space; with a "
                        "character in the world",
                        {required(numbers("from_m", 3, -k_metres, k_metres, "one end of the line")),
                         required(numbers("to_m", 3, -k_metres, k_metres, "its other end")),
                         required(real("radius_m", 1e-6, k_metres, "radius")), collider_motion()});
  Spec box = object("", "one box, in the head's rest space; with a character in the world",
                    {required(numbers("center_m", 3, -k_metres, k_metres, "centre")),
                     required(numbers("size_m", 3, 0, k_metres, "whole edges, without the rounding")),
                     real("rounding_m", 0, k_metres, "what the rounded box is larger by on every side"),
                     numbers("turn_axis", 3, -1e6, 1e6, "axis through the centre about which the box is turned"),
                     real("turn_degrees", -360, 360, "by so much; needs turn_axis"), collider_motion()});
  Spec mesh = object("", "a closed mesh, in the head's rest space; with a character in the world",
                     {required(file("file", "OBJ, or the mesh of a glTF character at rest")),
                      required(real("spacing_m", 1e-6, k_metres, "of the grid on which its distance is stored")),
                      real("metres_per_unit", 1e-6, 1000, "scale of an OBJ"), collider_motion()});
  return object("colliders", "what the hair may not enter (capsules, boxes and meshes: the solvers exact and rod)",
                {boolean("head", "the head's own spheres"),
                 array("spheres", 256, "spheres that move with the head, or by themselves", std::move(sphere)),
                 array("capsules", 256, "capsules that move with the head, or by themselves", std::move(capsule)),
                 array("boxes", 256, "boxes that move with the head, or by themselves", std::move(box)),
                 array("meshes", 16, "meshes that move with the head, or by themselves", std::move(mesh))});
}

Spec lights() {
  Spec light = object("", "a distant light",
                      {text("name", "for messages"),
                       required(numbers("to_light", 3, -1e6, 1e6, "direction from the scene to the light")),
                       required(numbers("irradiance", 3, 0, 1e6, "on a plane facing the light, linear Rec.709"))});
  return array("lights", k_max_lights, "lights; none: no shading by light and no shadow", std::move(light));
}

Spec point_lights() {
  Spec spot = object("spot", "shines to one side; absent: all around",
                     {required(numbers("to_m", 3, -k_metres, k_metres, "what the middle of its cone points at")),
                      required(real("outer_deg", 0.1, 179, "from its middle to where it ends")),
                      real("inner_deg", 0, 179, "up to here in full, below outer_deg; 0 unless given")});
  Spec point_light =
      object("", "a light with a place",
             {text("name", "for messages"), required(numbers("position_m", 3, -k_metres, k_metres, "where it stands")),
              required(numbers("intensity", 3, 0, 1e6,
                               "irradiance at 1 m, linear Rec.709; falls as 1 / distance^2, within 1 mm as at 1 mm")),
              std::move(spot)});
  return array("point_lights", k_max_lights, "lights with a place, eight with `lights` and `environment`",
               std::move(point_light));
}

Spec environment() {
  return object(
      "environment", "light from all around, as distant lights beside `lights` and `point_lights`, eight in all",
      {file("file",
            "picture in latitude and longitude, linear radiance: top row up, middle at +z; absent: a built-in sky"),
       boolean("or_sky", "the built-in sky where the file is not there; false unless given"),
       integer("lights", 1, 8, "at most, of like luminance; 6 unless given"),
       real("turn_deg", -360, 360, "about the vertical, +z towards +x"), real("scale", 0, 1e6, "of the radiance")});
}

Spec shadow(const Catalogue& catalogue) {
  return object(
      "shadow", "self-shadowing; absent: none",
      {required(block("method", "shadow method and its parameters", catalogue.methods)),
       rgb("fibre_alpha", 0, 1,
           "opacity of one fibre crossing; as [r, g, b], hair casts coloured shadows; absent: of opaque fibres, 1 "
           "unless "
           "strands are wider than the fibres that they stand for"),
       real("caster_share", 1e-3, 1, "of the drawn strands, that cast shadows, wider by as much; absent: all. Of a level of detail that draws a share of the strands more cast: the root of that share")});
}

Spec camera_keys() {
  Spec key = object(
      "", "what is absent is as in the key above, or as the camera has it",
      {required(real("time_s", -1e6, 1e6, "from frame 0; not before that of the key above")),
       numbers("position_m", 3, -k_metres, k_metres, "eye"), numbers("target_m", 3, -k_metres, k_metres, "looked at"),
       real("fov_deg", 0.6, 170, "vertical field of view")});
  return array("keys", 4096, "where a moving camera is, smoothly between; two at one time: a cut", std::move(key));
}

Spec camera() {
  return object("camera", "absent position: framed on the hair",
                {numbers("position_m", 3, -k_metres, k_metres, "eye"),
                 numbers("target_m", 3, -k_metres, k_metres, "looked at"), numbers("up", 3, -1, 1, "up"),
                 real("fov_deg", 0.6, 170, "vertical field of view"), real("near_m", 1e-5, k_metres, "near plane"),
                 real("far_m", 1e-4, 1e6, "far plane"), numbers("resolution_px", 2, 1, 16384, "width, height"),
                 real("turntable_deg_per_frame", -360, 360, "turn about the target's vertical axis"), camera_keys(),
                 boolean("follows_head", "travels with the head, but does not turn with it")});
}

Spec fins() {
  return object(
      "fins", "sheets that hang on the head: rigid where the painted weight is 0, simulated where it is 1",
      {required(file("mesh", "OBJ file with texture coordinates, in the head's rest space")),
       required(file("weights", "picture: the weight over the mesh's texture coordinates, its first channel")),
       real("metres_per_unit", 1e-9, 1e6, "scale of the mesh")});
}

Spec floor() {
  return object("floor", "a level square about the vertical axis, seen and lit from above; casts no shadow itself",
                {required(real("height_m", -k_metres, k_metres, "above the origin")),
                 real("size_m", 1e-3, k_metres, "of a side; 2 unless given"),
                 numbers("albedo", 3, 0, 1, "diffuse, linear Rec.709; .4 unless given")});
}

Spec outputs() {
  return object("outputs", "pictures wanted",
                {boolean("color", "radiance"),
                 boolean("aovs", "what each pixel sees of the hair, as layers (lines, quads, tiles)"),
                 boolean("deep", "each pixel's strands as samples in depth, a deep EXR (tiles, supersampled, reference)"),
                 boolean("cryptomatte", "mattes by strand, groom and material, in the EXR (tiles, supersampled, reference)"),
                 real("exposure_stops", -20, 20, "for the tone-mapped picture")});
}

Spec budgets() {
  Spec error = object("error", "the most that each part of a frame may be off, on hair like that of the study",
                      {real("shadow", 1e-6, 1, "mean error of the light's transmittance"),
                       real("shading", 1e-6, 1, "of scattering, root mean square over its own"),
                       real("coverage", 1e-6, 1, "mean error of a pixel's coverage"),
                       real("motion", 1e-6, 1, "mean distance of the hair from where it should be, over its length")});
  return object("budgets", "the plan chooses methods and settings that keep these, or refuses",
                {real("frame_ms", 1e-3, 1e6, "time of a frame on this device"),
                 real("memory_mb", 1e-3, 1e6, "device memory, 10^6 bytes"), std::move(error)});
}

Spec render() {
  Spec method = text("method", "how strands become pixels; 'lines' unless given");
  method.choices.assign(std::begin(k_render_methods), std::end(k_render_methods));
  return object("render", "how the picture is made", {required(std::move(method))});
}

}  // namespace

Spec specification(const Catalogue& catalogue) {
  return object(
      "", "A scene of Cuticle.",
      {required(integer("schema_version", 1, 1, "version of this format")),
       text("name", "for people"),
       groom(),
       head(),
       motion(),
       character(),
       material(catalogue),
       simulation(catalogue),
       colliders(),
       fins(),
       floor(),
       lights(),
       point_lights(),
       environment(),
       shadow(catalogue),
       camera(),
       integer("strand_count", 1, 10000000,
               "drawn strands of grown hair, and of groom.interpolate; those of a file or a grooming specification are "
               "all drawn"),
       integer(
           "strand_vertices", 2, strands::k_max_vertices,
           "vertices of each drawn strand, as strand_count; of a grooming specification's strands, absent: their own"),
       real("fibre_count", 1, 1e9,
            "fibres that the drawn strands stand for; they are as wide as these together, up to 1 mm, and shadows fall on "
            "them as on one of these; absent: 100000, of a file that carries radii as many as strands"),
       real("frames_per_second", 1, 1000, "frame rate"),
       outputs(),
       render(),
       budgets(),
       blocks("passes", "parameters of render passes", catalogue.passes)});
}

}  // namespace cuticle::scene
