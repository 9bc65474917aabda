// Shaders of the picture and of the deep opacity map (Yuksel and Keyser 2008).
import * as THREE from 'three';
import { hairLutGlsl } from 'cuticle/snippet';

export const BOUNDARIES = [0.06, 0.2, 0.5];  // of the layers, as shares of the light's range; the fourth holds all

// A ribbon at least one pixel wide: what it is wider than the fibre, it covers less.
const RIBBON = `
  in vec3 hairTangent;
  in float radius, side, strand;
  uniform vec2 pixels;
  uniform float widen;
  out vec3 worldTangent, world;
  out float cover, number, across;
  void main() {
    world = position;
    worldTangent = hairTangent;
    number = strand;
    across = side;
    vec4 middle = projectionMatrix * viewMatrix * vec4(position, 1.0);
    vec4 ahead = projectionMatrix * viewMatrix * vec4(position + 1e-3 * hairTangent, 1.0);
    vec2 along = (ahead.xy / ahead.w - middle.xy / middle.w) * pixels;
    along = dot(along, along) > 0.0 ? normalize(along) : vec2(0.0, 1.0);
    float metre = length(vec2(projectionMatrix[0][0] * pixels.x, projectionMatrix[1][1] * pixels.y)) * 0.35355339 / middle.w;
    float half_width = radius * widen * metre;  // in pixels
    float drawn = max(half_width, 0.5);
    cover = half_width / drawn;
    middle.xy += side * drawn * vec2(-along.y, along.x) * 2.0 / pixels * middle.w;
    gl_Position = middle;
  }`;
const HASH = `
  float hash(vec3 p) { p = fract(p * vec3(0.1031, 0.1030, 0.0973)); p += dot(p, p.yxz + 33.33); return fract((p.x + p.y) * p.z); }`;

// What lies between a point and the light, as the sum of -log(1 - coverage).
const LOOKUP = `
  uniform sampler2D firstDepth, opacity;
  uniform mat4 toMap;
  uniform float range, blur, shadows;
  ${HASH}
  float thickness(vec3 world, float seed) {
    vec4 place = toMap * vec4(world, 1.0);
    vec2 spread = blur * (vec2(hash(vec3(gl_FragCoord.xy, seed)), hash(vec3(gl_FragCoord.yx + 7.0, seed))) - 0.5);
    vec2 uv = 0.5 * place.xy + 0.5 + spread;
    float behind = (0.5 * place.z + 0.5) - textureLod(firstDepth, uv, 0.0).x;
    vec4 sums = textureLod(opacity, uv, 0.0);
    vec4 ends = vec4(${BOUNDARIES.map((b) => b.toFixed(3)).join(', ')}, 1.0);
    float found = sums.x * clamp(behind / ends.x, 0.0, 1.0);
    for (int k = 1; k < 4; ++k)
      found += (sums[k] - sums[k - 1]) * clamp((behind - ends[k - 1]) / (ends[k] - ends[k - 1]), 0.0, 1.0);
    return found * shadows;
  }`;

export function ribbonMaterial(uniforms) {
  return new THREE.ShaderMaterial({
    glslVersion: THREE.GLSL3, side: THREE.DoubleSide, uniforms, vertexShader: RIBBON,
    fragmentShader: `
      ${hairLutGlsl}
      in vec3 worldTangent, world;
      in float cover, number, across;
      uniform vec3 toLight, irradiance, ambient, forward, back;
      uniform float frame;
      out vec4 color;
      ${LOOKUP}
      // Dual scattering with the means of the tables: light that came straight, light that fibres in front sent on, and
      // what those behind send back (Zinke et al. 2008, equations 5 and 14 without their widths).
      void main() {
        if (cover < 1.0 && hash(vec3(gl_FragCoord.xy, number + 17.0 * frame)) > cover) discard;
        vec3 tangent = normalize(worldTangent), eye = normalize(cameraPosition - world);
        float sine = dot(toLight, tangent), cosine = sqrt(max(1.0 - sine * sine, 0.0));
        float crossed = thickness(world, frame);
        vec3 straight = vec3(exp(-crossed)), sent = (1.0 - straight) * pow(forward, vec3(crossed)) * 0.7;
        vec3 rest = max(1.0 - forward * forward, 0.02);
        vec3 returned = back * forward * forward / rest + back * back * back * forward * forward / (rest * rest * rest);
        vec3 single = cuticle_hair_scattering(toLight, eye, tangent);
        vec3 many = min(returned, vec3(1.0)) / (3.14159265 * 3.14159265);
        vec3 lit = (straight + sent) * irradiance * cosine * (single + many);
        vec3 albedo = min(forward + back, vec3(0.99));
        float open = mix(0.35, 1.0, exp(-0.5 * crossed));
        color = vec4(lit + ambient * open * albedo * albedo, 1.0);
      }` });
}

export function skinMaterial(uniforms) {
  return new THREE.ShaderMaterial({
    glslVersion: THREE.GLSL3, uniforms, side: THREE.DoubleSide,
    vertexShader: 'out vec3 n, world; void main() { n = normal; world = position; gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0); }',
    fragmentShader: `
      in vec3 n, world;
      uniform vec3 toLight, irradiance, ambient;
      uniform float frame;
      out vec4 color;
      ${LOOKUP}
      void main() {
        vec3 normal = normalize(gl_FrontFacing ? n : -n);
        vec3 lit = ambient * (0.75 + 0.25 * normal.y) + irradiance / 3.14159265 * max(dot(normal, toLight), 0.0) * exp(-thickness(world + 0.002 * normal, frame));
        color = vec4(vec3(0.27, 0.142, 0.098) * 1.6 * lit, 1.0);
      }` });
}

// Seen from the light: the nearest depth, then what is covered up to each layer's end.
export function depthMaterial(uniforms, ofHair) {
  return new THREE.ShaderMaterial({
    glslVersion: THREE.GLSL3, side: THREE.DoubleSide, uniforms, vertexShader: ofHair ? RIBBON : 'void main() { gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0); }',
    fragmentShader: 'out vec4 color; void main() { color = vec4(gl_FragCoord.z); }' });
}
export function opacityMaterial(uniforms, ofHair) {
  return new THREE.ShaderMaterial({
    glslVersion: THREE.GLSL3, side: THREE.DoubleSide, uniforms, depthTest: false, depthWrite: false, blending: THREE.CustomBlending,
    blendEquation: THREE.AddEquation, blendSrc: THREE.OneFactor, blendDst: THREE.OneFactor, blendSrcAlpha: THREE.OneFactor,
    blendDstAlpha: THREE.OneFactor, transparent: true,
    vertexShader: ofHair ? RIBBON : 'void main() { gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0); }',
    fragmentShader: `
      ${ofHair ? 'in float cover;' : 'const float cover = 0.0;'}
      uniform sampler2D firstDepth;
      uniform vec2 pixels;
      out vec4 color;
      void main() {
        float behind = gl_FragCoord.z - textureLod(firstDepth, gl_FragCoord.xy / pixels, 0.0).x;
        float amount = ${ofHair ? '-log(1.0 - 0.98 * min(cover, 1.0))' : '12.0'};
        color = amount * vec4(lessThanEqual(vec4(behind), vec4(${BOUNDARIES.map((b) => b.toFixed(3)).join(', ')}, 1e9)));
      }` });
}
