// Settings by their documented names: Godot 4's ResourceImporterTexture and shading language.
#include <fmt/format.h>

#include "lut/target.h"

namespace cuticle::lut::godot {
namespace {

constexpr std::string_view k_readable[] = {"exr", "png8"};

// compress/mode 3: uncompressed; detect_3d/compress_to 0: left alone when used in 3D; roughness/mode 1: none.
constexpr const char* k_import = R"([remap]

importer="texture"
type="CompressedTexture2D"

[params]

compress/mode=3
compress/hdr_compression=0
compress/normal_map=2
compress/channel_pack=0
mipmaps/generate=false
mipmaps/limit=-1
roughness/mode=1
process/fix_alpha_border=false
process/premult_alpha=false
process/normal_map_invert_y=false
process/hdr_as_srgb=false
process/hdr_clamp_exposure=false
process/size_limit=0
detect_3d/compress_to=0
)";

constexpr const char* k_check =
    R"(// Written by cuticle @VERSION@. Green: every probe of the tables reads right. Red: one does not.
shader_type spatial;
render_mode unshaded;
#include "cuticle_hair.gdshaderinc"
void fragment() {
	ALBEDO = cuticle_verify_probes() == 0 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0);
}
)";

// LIGHT_COLOR is pi times the light's energy: the irradiance. The tangent is turned into the view's frame, as LIGHT and VIEW are.
constexpr const char* k_material =
    R"(// Written by cuticle @VERSION@. Hair by the tables, for strips or cards whose mesh tangent runs from root to tip.
shader_type spatial;
render_mode cull_disabled, specular_disabled;
#include "cuticle_hair.gdshaderinc"
varying vec3 root_to_tip;

void vertex() {
	root_to_tip = (MODELVIEW_MATRIX * vec4(TANGENT, 0.0)).xyz;
}

void fragment() {
	ALBEDO = vec3(1.0);
	ROUGHNESS = 1.0;
}

void light() {
	vec3 tangent = normalize(root_to_tip);
	float sine = dot(LIGHT, tangent);
	DIFFUSE_LIGHT += cuticle_hair_scattering(LIGHT, VIEW, tangent) * sqrt(max(1.0 - sine * sine, 0.0)) * LIGHT_COLOR * ATTENUATION;
}
)";

constexpr const char* k_readme = R"(# Hair tables for Godot 4

@TABLES@ of the model @MODEL@, written by cuticle @VERSION@.

1. Copy this folder into the project, with its `.import` files: they make Godot import the tables as data, without
   compression and mip maps.
2. Make a ShaderMaterial of `cuticle_hair.gdshader`, put each table into the parameter of its name, and give the material to
   hair strips or cards whose tangents run from root to tip.
3. Put a ShaderMaterial of `cuticle_lut_check.gdshader` with the same tables on any object: green says that every table reads
   right, red that one does not. `cuticle check lut FOLDER` names what an import did to the files.

`cuticle_hair.gdshaderinc` holds the functions for a shader of your own; the result is scattering without the cosine of the
light's inclination. These files follow Godot's documented names; nobody has opened them in the editor yet.
)";

Result<std::vector<TextFile>> files(const Manifest& manifest) {
  CUTICLE_TRY(check_readable(manifest, "godot", k_readable));
  std::vector<TextFile> made;
  std::string uniforms;
  for (const ManifestTable& table : manifest.tables) {
    made.push_back({table.file + ".import", k_import});
    uniforms += fmt::format("uniform sampler2D cuticle_{} : filter_linear, repeat_disable;\n", table.name);
  }
  CUTICLE_ASSIGN(const std::string include, engine_snippet(manifest, "glsl", uniforms));
  made.push_back({"cuticle_hair.gdshaderinc", include});
  const std::pair<std::string_view, std::string> values[] = {
      {"VERSION", manifest.tool_version}, {"MODEL", manifest.model}, {"TABLES", names_of_tables(manifest)}};
  made.push_back({"cuticle_lut_check.gdshader", filled(k_check, values)});
  // Tables that do not make S shade nothing by themselves.
  if (!manifest.terms.empty()) made.push_back({"cuticle_hair.gdshader", filled(k_material, values)});
  made.push_back({"README.md", filled(k_readme, values)});
  return made;
}

}  // namespace

const Target& entry() {
  static const Target target{"godot", "a .import a table, a material, cuticle_hair.gdshaderinc, a check", files};
  return target;
}

}  // namespace cuticle::lut::godot
