// ES modules for Babylon.js and WebGL 2.
#include "lut/targets/browser.h"

namespace cuticle::lut::babylon {
namespace {

// A browser decodes a PNG of 16 bits to 8.
constexpr std::string_view k_readable[] = {"ktx2", "dds", "png8"};

constexpr const char* k_module = R"(// Written by cuticle @VERSION@ from manifest.json.
//   import { loadHairLut, verifyHairLut, hairLutGlsl } from './hairLut.js';
//   const lut = await loadHairLut(scene);                // textures: data, linear, clamped, no mip maps
//   await verifyHairLut(engine, lut);                    // 0: every probe reads right; else 100 * table + probe
import { RawTexture } from '@babylonjs/core/Materials/Textures/rawTexture.js';
import { RenderTargetTexture } from '@babylonjs/core/Materials/Textures/renderTargetTexture.js';
import { Texture } from '@babylonjs/core/Materials/Textures/texture.js';
import { EffectRenderer, EffectWrapper } from '@babylonjs/core/Materials/effectRenderer.js';
import '@babylonjs/core/Engines/Extensions/engine.rawTexture.js';
import '@babylonjs/core/Engines/Extensions/engine.renderTarget.js';
import '@babylonjs/core/Engines/Extensions/engine.readTexture.js';

export const hairLutGlsl = `
@GLSL@`;

const RGBA = 5, FLOAT = 1, HALF_FLOAT = 2;  // Engine.TEXTUREFORMAT_RGBA, TEXTURETYPE_FLOAT, TEXTURETYPE_HALF_FLOAT

@READ@
async function ofHalves(scene, url, format) {
  const { width, height, halves } = await halfTable(url, format);
  return new RawTexture(halves, width, height, RGBA, scene, false, false, Texture.BILINEAR_SAMPLINGMODE, HALF_FLOAT);
}

function ofPicture(scene, url) {
  return new Promise((done, failed) => {
    const texture = new Texture(url, scene, { noMipmap: true, invertY: false, samplingMode: Texture.BILINEAR_SAMPLINGMODE,
                                              onLoad: () => done(texture), onError: (message) => failed(new Error(`${url}: ${message}`)) });
    texture.gammaSpace = false;
  });
}

export async function loadHairLut(scene, folder = new URL('.', import.meta.url).href) {
  const base = addressOf(folder, import.meta.url), manifest = await manifestOf(base), textures = {};
  for (const table of manifest.tables) {
    const url = new URL(table.file, base).href;
    const texture = await (manifest.format === 'png8' ? ofPicture(scene, url) : ofHalves(scene, url, manifest.format));
    texture.wrapU = texture.wrapV = Texture.CLAMP_ADDRESSMODE;
    textures[`cuticle_${table.name}`] = texture;
  }
  return { manifest, textures, scene };
}

export function verifyHairLut(engine, lut) {
  const names = Object.keys(lut.textures);
  const target = new RenderTargetTexture('found', 1, lut.scene, { type: FLOAT, generateDepthBuffer: false, generateMipMaps: false });
  const wrapper = new EffectWrapper({ engine, name: 'verifyHairLut', samplerNames: names, fragmentShader:
    `precision highp float;\nprecision highp sampler2D;\n${hairLutGlsl}\nvoid main() { gl_FragColor = vec4(float(cuticle_verify_probes())); }` });
  wrapper.onApplyObservable.add(() => names.forEach((name) => wrapper.effect.setTexture(name, lut.textures[name])));
  const renderer = new EffectRenderer(engine);
  return new Promise((done) => wrapper.effect.executeWhenCompiled(async () => {
    renderer.render(wrapper, target);
    const [code] = await target.readPixels();
    for (const each of [renderer, wrapper, target]) each.dispose();
    done(code);
  }));
}
)";

constexpr const char* k_material = R"(// Written by cuticle @VERSION@. Hair by the tables, for meshes whose attribute `tangent` runs from root to tip.
//   mesh.material = createHairMaterial(scene, lut, { toLight: new Vector3(1, 1, 0.3), irradiance: new Vector3(3, 3, 3) });
// `picture`: a texture of cards, whose alpha cuts out the strands; `lines`: for meshes of lines.
import { Vector3 } from '@babylonjs/core/Maths/math.vector.js';
import { ShaderMaterial } from '@babylonjs/core/Materials/shaderMaterial.js';
import { hairLutGlsl } from './hairLut.js';

const LINES = 4;  // Material.LineListDrawMode

export function createHairMaterial(scene, lut, { toLight = new Vector3(1, 1, 0.3), irradiance = new Vector3(3, 3, 3),
                                                 ambient = new Vector3(0.05, 0.05, 0.05), picture = null, lines = false } = {}) {
  const names = Object.keys(lut.textures);
  const material = new ShaderMaterial('hair', scene, {
    vertexSource: `precision highp float;
      attribute vec3 position; attribute vec4 tangent; ${picture ? 'attribute vec2 uv;' : ''}
      uniform mat4 world, viewProjection; uniform vec3 cameraPosition;
      varying vec3 vAlong, vToEye; varying vec2 vPlace;
      void main() {
        vec4 place = world * vec4(position, 1.0);
        vAlong = mat3(world) * tangent.xyz;
        vPlace = ${picture ? 'uv' : 'vec2(0.0)'};
        vToEye = cameraPosition - place.xyz;
        gl_Position = viewProjection * place;
      }`,
    fragmentSource: `precision highp float; precision highp sampler2D;
      varying vec3 vAlong, vToEye; varying vec2 vPlace;
      uniform vec3 toLight, irradiance, ambient; ${picture ? 'uniform sampler2D picture;' : ''}
      ${hairLutGlsl}
      void main() {
        ${picture ? 'vec4 texel = texture2D(picture, vPlace); if (texel.a < 0.5) discard;' : ''}
        vec3 along = normalize(vAlong);
        float sine = dot(toLight, along);
        vec3 lit = ambient + irradiance * cuticle_hair_scattering(toLight, normalize(vToEye), along) * sqrt(max(1.0 - sine * sine, 0.0));
        vec3 shown = pow(lit / (1.0 + lit), vec3(1.0 / 2.2));
        gl_FragColor = vec4(shown ${picture ? '* mix(0.6, 1.0, texel.r)' : ''}, 1.0);
      }`,
  }, { attributes: ['position', 'tangent', ...(picture ? ['uv'] : [])],
       uniforms: ['world', 'viewProjection', 'cameraPosition', 'toLight', 'irradiance', 'ambient'],
       samplers: [...names, ...(picture ? ['picture'] : [])] });
  material.backFaceCulling = false;
  material.setVector3('toLight', toLight.clone().normalize());
  material.setVector3('irradiance', irradiance);
  material.setVector3('ambient', ambient);
  for (const name of names) material.setTexture(name, lut.textures[name]);
  if (picture) {
    material.setTexture('picture', picture);
    material.forceDepthWrite = true;
  }
  if (lines) material.fillMode = LINES;
  material.onBind = () => material.getEffect().setVector3('cameraPosition', scene.activeCamera.globalPosition);
  return material;
}
)";

constexpr const char* k_readme = R"(# Hair tables for Babylon.js

@TABLES@ of the model @MODEL@, written by cuticle @VERSION@.

1. Serve this folder with the page and load it: `import { loadHairLut, verifyHairLut } from './babylon/hairLut.js'` and
   `const lut = await loadHairLut(scene)`. The textures are linear, clamped and without mip maps.
2. `import { createHairMaterial } from './babylon/hairMaterial.js'`: `mesh.material = createHairMaterial(scene, lut, { lines: true })`
   for the lines of `cuticle convert x.glb`, `{ picture: mesh.material.albedoTexture }` for the cards of `cuticle cards`. Set
   `scene.useRightHandedSystem = true` for glTF.
3. `await verifyHairLut(engine, lut)` gives 0 where every table reads right. `cuticle check lut FOLDER` names what was done to the
   files.

`hairLutGlsl` holds the functions for a shader of your own; the result is scattering without the cosine of the light's
inclination. The material's colours are mapped by x / (1 + x) and encoded with an exponent of 1 / 2.2.
)";

Result<std::vector<TextFile>> files(const Manifest& manifest) {
  return browser::files_of(manifest, "babylon", k_readable, k_module, k_material, k_readme);
}

}  // namespace

const Target& entry() {
  static const Target target{"babylon", "hairLut.js loads, binds and verifies the tables; hairMaterial.js shades with them", files};
  return target;
}

}  // namespace cuticle::lut::babylon
