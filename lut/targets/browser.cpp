#include "lut/targets/browser.h"

#include "lut/snippets/snippet.h"

namespace cuticle::lut::browser {
namespace {

constexpr const char* k_reading = R"(function addressOf(folder, module) {
  return new URL(folder.endsWith('/') ? folder : folder + '/', globalThis.location?.href ?? module);
}

async function bytesOf(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status}`);
  return response.arrayBuffer();
}

async function manifestOf(base) {
  return JSON.parse(new TextDecoder().decode(await bytesOf(new URL('manifest.json', base))));
}

// Level 0 of the uncompressed half floats that cuticle writes.
async function halfTable(url, format) {
  const bytes = await bytesOf(url), view = new DataView(bytes), isKtx = format === 'ktx2';
  const width = view.getUint32(isKtx ? 20 : 16, true), height = view.getUint32(isKtx ? 24 : 12, true);
  const at = isKtx ? Number(view.getBigUint64(80, true)) : 148;
  return { width, height, halves: new Uint16Array(bytes.slice(at, at + 8 * width * height)) };
}
)";

Result<std::string> glsl_of(const Manifest& manifest) {
  CUTICLE_ASSIGN(const snippets::Dialect* glsl, snippets::find_dialect("glsl"));
  return engine_snippet(manifest, "glsl", snippets::declarations(manifest, *glsl));
}

}  // namespace

Result<std::vector<TextFile>> files_of(const Manifest& manifest, std::string_view target,
                                       std::span<const std::string_view> formats, const char* module,
                                       const char* material, const char* readme) {
  CUTICLE_TRY(check_readable(manifest, target, formats));
  CUTICLE_ASSIGN(const std::string glsl, glsl_of(manifest));
  const std::pair<std::string_view, std::string> values[] = {{"VERSION", manifest.tool_version},
                                                             {"READ", k_reading},
                                                             {"GLSL", glsl},
                                                             {"MODEL", manifest.model},
                                                             {"TABLES", names_of_tables(manifest)}};
  std::vector<TextFile> made = {{"hairLut.js", filled(module, values)}, {"README.md", filled(readme, values)}};
  // Tables that do not make S shade nothing by themselves.
  if (!manifest.terms.empty()) made.push_back({"hairMaterial.js", filled(material, values)});
  return made;
}

}  // namespace cuticle::lut::browser
