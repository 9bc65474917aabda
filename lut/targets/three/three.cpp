// An ES module for three.js and WebGL 2.
#include "lut/targets/browser.h"

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

@READ@
async function halfTexture(url, format) {
  const { width, height, halves } = await halfTable(url, format);
  return new DataTexture(halves, width, height, RGBAFormat, HalfFloatType);
}

// EXRLoader gives the bottom row first; a table's first row is v = 0.
function topRowFirst(texture) {
  const { data, width, height } = texture.image, row = (data.length / height);
  const turned = data.slice();
  for (let y = 0; y < height; ++y) turned.set(data.subarray(y * row, (y + 1) * row), (height - 1 - y) * row);
  return new DataTexture(turned, width, height, texture.format, texture.type);
}

const READERS = {
  exr: async (url) => topRowFirst(await new EXRLoader().setDataType(HalfFloatType).loadAsync(url)),
  ktx2: (url) => halfTexture(url, 'ktx2'),
  dds: (url) => halfTexture(url, 'dds'),
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
  const base = addressOf(folder, import.meta.url), manifest = await manifestOf(base);
  const uniforms = {};
  for (const table of manifest.tables) {
    const texture = await READERS[manifest.format](new URL(table.file, base).href);
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

constexpr const char* k_material = R"(// Written by cuticle @VERSION@. Hair by the tables, for lines or strips with an attribute `hairTangent` (vec3) from root to tip.
//   const material = createHairMaterial(lut, { toLight: new Vector3(1, 1, 0.3), irradiance: new Color(3, 3, 3) });
import { Color, DoubleSide, GLSL3, ShaderMaterial, Vector3 } from 'three';
import { hairLutGlsl } from './hairLut.js';

export function createHairMaterial(lut, { toLight = new Vector3(1, 1, 0.3), irradiance = new Color(3, 3, 3),
                                          ambient = new Color(0.05, 0.05, 0.05) } = {}) {
  return new ShaderMaterial({
    glslVersion: GLSL3, side: DoubleSide,
    uniforms: { ...lut.uniforms, toLight: { value: toLight.clone().normalize() }, irradiance: { value: irradiance },
                ambient: { value: ambient } },
    vertexShader: `
      in vec3 hairTangent;
      out vec3 worldTangent, toEye;
      void main() {
        vec4 world = modelMatrix * vec4(position, 1.0);
        worldTangent = mat3(modelMatrix) * hairTangent;
        toEye = cameraPosition - world.xyz;
        gl_Position = projectionMatrix * viewMatrix * world;
      }`,
    fragmentShader: `
      uniform vec3 toLight, irradiance, ambient;
      in vec3 worldTangent, toEye;
      out vec4 color;
      ${hairLutGlsl}
      void main() {
        vec3 tangent = normalize(worldTangent);
        float sine = dot(toLight, tangent);
        vec3 scattered = cuticle_hair_scattering(toLight, normalize(toEye), tangent) * sqrt(max(1.0 - sine * sine, 0.0));
        color = linearToOutputTexel(vec4(ambient + scattered * irradiance, 1.0));
      }`,
  });
}
)";

constexpr const char* k_readme = R"(# Hair tables for three.js

@TABLES@ of the model @MODEL@, written by cuticle @VERSION@.

1. Serve this folder with the page and load it: `import { loadHairLut, verifyHairLut } from './three/hairLut.js'` and
   `const lut = await loadHairLut()`. The textures are linear, clamped and without mip maps.
2. `import { createHairMaterial } from './three/hairMaterial.js'`: `createHairMaterial(lut)` is a material for lines or strips
   whose attribute `hairTangent` runs from root to tip.
3. `verifyHairLut(renderer, lut)` gives 0 where every table reads right. `cuticle check lut FOLDER` names what was done to the
   files.

`hairLutGlsl` holds the functions for a shader of your own; the result is scattering without the cosine of the light's
inclination.
)";

Result<std::vector<TextFile>> files(const Manifest& manifest) {
  return browser::files_of(manifest, "three", k_readable, k_module, k_material, k_readme);
}

}  // namespace

const Target& entry() {
  static const Target target{"three", "hairLut.js loads, binds and verifies the tables; hairMaterial.js shades with them", files};
  return target;
}

}  // namespace cuticle::lut::three
