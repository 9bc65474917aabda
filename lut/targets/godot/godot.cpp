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
  const std::pair<std::string_view, std::string> values[] = {{"VERSION", manifest.tool_version}};
  made.push_back({"cuticle_lut_check.gdshader", filled(k_check, values)});
  return made;
}

}  // namespace

const Target& entry() {
  static const Target target{"godot", "a .import a table, cuticle_hair.gdshaderinc, cuticle_lut_check.gdshader", files};
  return target;
}

}  // namespace cuticle::lut::godot
