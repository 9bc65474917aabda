// ES modules for PlayCanvas and WebGL 2.
#include "lut/targets/browser.h"

namespace cuticle::lut::playcanvas {
namespace {

// A browser decodes a PNG of 16 bits to 8.
constexpr std::string_view k_readable[] = {"ktx2", "dds", "png8"};

constexpr const char* k_module = R"(// Written by cuticle @VERSION@ from manifest.json.
//   import { loadHairLut, verifyHairLut, hairLutGlsl } from './hairLut.js';
//   const lut = await loadHairLut(app.graphicsDevice);   // textures: data, linear, clamped, no mip maps
//   await verifyHairLut(app.graphicsDevice, lut);        // 0: every probe reads right; else 100 * table + probe
import * as pc from 'playcanvas';

export const hairLutGlsl = `
@GLSL@`;

@READ@
// The texels as they are: without a colour space and with colour not multiplied by alpha.
async function ofPicture(url) {
  const bitmap = await createImageBitmap(new Blob([await bytesOf(url)], { type: 'image/png' }), { premultiplyAlpha: 'none', colorSpaceConversion: 'none' });
  return { width: bitmap.width, height: bitmap.height, bitmap };
}

function textureOf(device, name, { width, height, halves, bitmap }) {
  const texture = new pc.Texture(device, { name, width, height, format: halves ? pc.PIXELFORMAT_RGBA16F : pc.PIXELFORMAT_RGBA8, mipmaps: false,
                                           minFilter: pc.FILTER_LINEAR, magFilter: pc.FILTER_LINEAR, flipY: false, premultiplyAlpha: false,
                                           addressU: pc.ADDRESS_CLAMP_TO_EDGE, addressV: pc.ADDRESS_CLAMP_TO_EDGE, levels: halves ? [halves] : undefined });
  if (bitmap) texture.setSource(bitmap);
  return texture;
}

export async function loadHairLut(device, folder = new URL('.', import.meta.url).href) {
  const base = addressOf(folder, import.meta.url), manifest = await manifestOf(base), textures = {};
  for (const table of manifest.tables) {
    const url = new URL(table.file, base).href;
    const texels = await (manifest.format === 'png8' ? ofPicture(url) : halfTable(url, manifest.format));
    textures[`cuticle_${table.name}`] = textureOf(device, table.name, texels);
  }
  return { manifest, textures };
}

export async function verifyHairLut(device, lut) {
  const found = new pc.Texture(device, { name: 'found', width: 1, height: 1, format: pc.PIXELFORMAT_RGBA32F, mipmaps: false,
                                         minFilter: pc.FILTER_NEAREST, magFilter: pc.FILTER_NEAREST });
  const target = new pc.RenderTarget({ colorBuffer: found, depth: false });
  const shader = pc.ShaderUtils.createShader(device, { uniqueName: 'verifyHairLut', attributes: { vertex_position: pc.SEMANTIC_POSITION },
    vertexGLSL: 'attribute vec2 vertex_position; void main() { gl_Position = vec4(vertex_position, 0.0, 1.0); }',
    fragmentGLSL: `precision highp sampler2D;\n${hairLutGlsl}\nvoid main() { gl_FragColor = vec4(float(cuticle_verify_probes())); }` });
  for (const [name, texture] of Object.entries(lut.textures)) device.scope.resolve(name).setValue(texture);
  device.setBlendState(pc.BlendState.NOBLEND);
  device.setDepthState(pc.DepthState.NODEPTH);
  device.setCullMode(pc.CULLFACE_NONE);
  pc.drawQuadWithShader(device, target, shader);
  const [code] = await found.read(0, 0, 1, 1, { renderTarget: target, immediate: true });
  target.destroy();
  found.destroy();
  return code;
}
)";

constexpr const char* k_material = R"(// Written by cuticle @VERSION@. Hair by the tables, for meshes whose tangents run from root to tip.
//   meshInstance.material = createHairMaterial(lut, { toLight: [1, 1, 0.3], irradiance: [3, 3, 3] });
// `picture`: a texture of cards, whose alpha cuts out the strands.
import * as pc from 'playcanvas';
import { hairLutGlsl } from './hairLut.js';

export function createHairMaterial(lut, { toLight = [1, 1, 0.3], irradiance = [3, 3, 3], ambient = [0.05, 0.05, 0.05], picture = null } = {}) {
  const material = new pc.ShaderMaterial({
    uniqueName: picture ? 'cuticleHairCards' : 'cuticleHair',
    attributes: { vertex_position: pc.SEMANTIC_POSITION, vertex_tangent: pc.SEMANTIC_TANGENT,
                  ...(picture ? { vertex_uv: pc.SEMANTIC_TEXCOORD0 } : {}) },
    vertexGLSL: `attribute vec3 vertex_position; attribute vec4 vertex_tangent; ${picture ? 'attribute vec2 vertex_uv;' : ''}
      uniform mat4 matrix_model;
      uniform mat4 matrix_viewProjection;
      uniform vec3 view_position;
      varying vec3 vAlong, vToEye; varying vec2 vPlace;
      void main() {
        vec4 world = matrix_model * vec4(vertex_position, 1.0);
        vAlong = mat3(matrix_model) * vertex_tangent.xyz;
        vPlace = ${picture ? 'vertex_uv' : 'vec2(0.0)'};
        vToEye = view_position - world.xyz;
        gl_Position = matrix_viewProjection * world;
      }`,
    fragmentGLSL: `precision highp sampler2D;
      varying vec3 vAlong, vToEye; varying vec2 vPlace;
      uniform vec3 toLight;
      uniform vec3 irradiance;
      uniform vec3 ambient;
      ${picture ? 'uniform sampler2D picture;' : ''}
      ${hairLutGlsl}
      void main() {
        ${picture ? 'vec4 texel = texture2D(picture, vPlace); if (texel.a < 0.5) discard;' : ''}
        vec3 along = normalize(vAlong);
        float sine = dot(toLight, along);
        vec3 lit = ambient + irradiance * cuticle_hair_scattering(toLight, normalize(vToEye), along) * sqrt(max(1.0 - sine * sine, 0.0));
        vec3 shown = pow(lit / (1.0 + lit), vec3(1.0 / 2.2));
        gl_FragColor = vec4(shown ${picture ? '* mix(0.6, 1.0, texel.r)' : ''}, 1.0);
      }` });
  material.cull = pc.CULLFACE_NONE;
  const length = Math.hypot(...toLight);
  material.setParameter('toLight', toLight.map((c) => c / length));
  material.setParameter('irradiance', irradiance);
  material.setParameter('ambient', ambient);
  if (picture) material.setParameter('picture', picture);
  for (const [name, texture] of Object.entries(lut.textures)) material.setParameter(name, texture);
  material.update();
  return material;
}
)";

constexpr const char* k_readme = R"(# Hair tables for PlayCanvas

@TABLES@ of the model @MODEL@, written by cuticle @VERSION@.

1. Serve this folder with the page and load it: `import { loadHairLut, verifyHairLut } from './playcanvas/hairLut.js'` and
   `const lut = await loadHairLut(app.graphicsDevice)`. The textures are linear, clamped and without mip maps.
2. `import { createHairMaterial } from './playcanvas/hairMaterial.js'`: `meshInstance.material = createHairMaterial(lut)` for the lines of
   `cuticle convert x.glb`, with `{ picture: meshInstance.material.diffuseMap }` for the cards of `cuticle cards`. The camera's
   `toneMapping` is `TONEMAP_LINEAR` and its `gammaCorrection` `GAMMA_NONE`: the material does both.
3. `await verifyHairLut(app.graphicsDevice, lut)` gives 0 where every table reads right. `cuticle check lut FOLDER` names what was
   done to the files.

`hairLutGlsl` holds the functions for a shader of your own; the result is scattering without the cosine of the light's
inclination. The material's colours are mapped by x / (1 + x) and encoded with an exponent of 1 / 2.2.
)";

Result<std::vector<TextFile>> files(const Manifest& manifest) {
  return browser::files_of(manifest, "playcanvas", k_readable, k_module, k_material, k_readme);
}

}  // namespace

const Target& entry() {
  static const Target target{"playcanvas", "hairLut.js loads, binds and verifies the tables; hairMaterial.js shades with them", files};
  return target;
}

}  // namespace cuticle::lut::playcanvas
