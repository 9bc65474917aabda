// An ES module for three.js and WebGL 2.
#include <fmt/format.h>

#include "lut/snippets/snippet.h"
#include "lut/target.h"

namespace cuticle::lut::three {
namespace {

// A browser decodes a PNG of 16 bits to 8.
constexpr std::string_view k_readable[] = {"exr", "ktx2", "dds", "png8"};

constexpr const char* k_module = R"(// Written by cuticle @VERSION@ from manifest.json.
//   import { loadHairLut, verifyHairLut, hairLutGlsl } from './hairLut.js';
//   const lut = await loadHairLut();                     // textures: data, linear, clamped, no mip maps
//   verifyHairLut(renderer, lut);                        // 0: every probe reads right; else 100 * table + probe
//   new ShaderMaterial({ glslVersion: GLSL3, uniforms: lut.uniforms, fragmentShader: hairLutGlsl + '...' });
import { ClampToEdgeWrapping, DataTexture, GLSL3, HalfFloatType, LinearFilter, Mesh, NoColorSpace, OrthographicCamera,
         PlaneGeometry, RGBAFormat, RawShaderMaterial, TextureLoader, WebGLRenderTarget } from 'three';
import { EXRLoader } from 'three/addons/loaders/EXRLoader.js';

export const hairLutGlsl = `
@GLSL@`;

// Level 0 of the uncompressed half floats that cuticle writes; `sizeAt`: offsets of width and height.
function halfTexture(bytes, sizeAt, texelsAt) {
  const view = new DataView(bytes);
  const [width, height] = sizeAt.map((offset) => view.getUint32(offset, true));
  return new DataTexture(new Uint16Array(bytes.slice(texelsAt(view), texelsAt(view) + width * height * 8)), width, height,
                         RGBAFormat, HalfFloatType);
}

// EXRLoader gives the bottom row first; a table's first row is v = 0.
function topRowFirst(texture) {
  const { data, width, height } = texture.image, row = (data.length / height);
  const turned = data.slice();
  for (let y = 0; y < height; ++y) turned.set(data.subarray(y * row, (y + 1) * row), (height - 1 - y) * row);
  return new DataTexture(turned, width, height, texture.format, texture.type);
}

async function bytesOf(url) {
  const response = await fetch(url);
  if (!response.ok) throw new Error(`${url}: ${response.status}`);
  return response.arrayBuffer();
}

const READERS = {
  exr: async (url) => topRowFirst(await new EXRLoader().setDataType(HalfFloatType).loadAsync(url)),
  ktx2: async (url) => halfTexture(await bytesOf(url), [20, 24], (view) => Number(view.getBigUint64(80, true))),
  dds: async (url) => halfTexture(await bytesOf(url), [16, 12], () => 148),
  png8: (url) => new TextureLoader().loadAsync(url),
};

function asData(texture) {
  texture.colorSpace = NoColorSpace;
  texture.wrapS = texture.wrapT = ClampToEdgeWrapping;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.generateMipmaps = false;
  texture.premultiplyAlpha = false;
  texture.flipY = false;
  texture.needsUpdate = true;
  return texture;
}

export async function loadHairLut(folder = new URL('.', import.meta.url).href) {
  const manifest = await (await fetch(new URL('manifest.json', folder))).json();
  const uniforms = {};
  for (const table of manifest.tables) {
    const texture = await READERS[manifest.format](new URL(table.file, folder).href);
    uniforms[`cuticle_${table.name}`] = { value: asData(texture) };
  }
  return { manifest, uniforms };
}

const HEAD = 'precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n';

export function verifyHairLut(renderer, lut) {
  const material = new RawShaderMaterial({
    glslVersion: GLSL3, uniforms: lut.uniforms, depthTest: false,
    vertexShader: HEAD + 'in vec3 position;\nvoid main() { gl_Position = vec4(position.xy, 0.0, 1.0); }\n',
    fragmentShader: HEAD + 'out vec4 found;\n' + hairLutGlsl +
      'void main() { int code = cuticle_verify_probes(); found = vec4(code / 256, code % 256, 0, 255) / 255.0; }\n',
  });
  const target = new WebGLRenderTarget(1, 1), geometry = new PlaneGeometry(2, 2), before = renderer.getRenderTarget();
  renderer.setRenderTarget(target);
  renderer.render(new Mesh(geometry, material), new OrthographicCamera());
  const texel = new Uint8Array(4);
  renderer.readRenderTargetPixels(target, 0, 0, 1, 1, texel);
  renderer.setRenderTarget(before);
  for (const each of [material, target, geometry]) each.dispose();
  return texel[0] * 256 + texel[1];
}
)";

Result<std::vector<TextFile>> files(const Manifest& manifest) {
  CUTICLE_TRY(check_readable(manifest, "three", k_readable));
  CUTICLE_ASSIGN(const snippets::Dialect* glsl, snippets::find_dialect("glsl"));
  CUTICLE_ASSIGN(const std::string snippet, engine_snippet(manifest, "glsl", snippets::declarations(manifest, *glsl)));
  const std::pair<std::string_view, std::string> values[] = {{"VERSION", manifest.tool_version}, {"GLSL", snippet}};
  return std::vector<TextFile>{{"hairLut.js", filled(k_module, values)}};
}

}  // namespace

const Target& entry() {
  static const Target target{"three", "hairLut.js: an ES module that loads, binds and verifies the tables", files};
  return target;
}

}  // namespace cuticle::lut::three
