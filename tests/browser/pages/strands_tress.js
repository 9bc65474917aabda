// A head of hair: strands that fall from a parting over a ball, as thin ribbons that face the camera, lit by a key light and a rim.
import { BufferAttribute, BufferGeometry, Color, DoubleSide, GLSL3, Mesh, PerspectiveCamera, RawShaderMaterial, Scene, SphereGeometry,
         Vector3 } from 'three';

const STRANDS = 6500, POINTS = 22, WIDTH = 0.005;
const HEAD = 'precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n';
const VERTEX = `${HEAD}
uniform mat4 projectionMatrix, viewMatrix;
uniform vec3 cameraPosition;
in vec3 position, tangent, normal;
in vec2 side;  // -1 or 1 across; a number of the strand in [0, 1)
out vec3 along, place, outward;
out float strand;
void main() {
  vec3 across = normalize(cross(tangent, cameraPosition - position));
  place = position; along = tangent; outward = normal; strand = side.y;
  gl_Position = projectionMatrix * viewMatrix * vec4(position + across * side.x * ${WIDTH}, 1.0);
}`;
// The light that neighbours scatter on is a soft glow of the hair's own colour; what a ball's far side would shade is dark.
const FRAGMENT = `
uniform vec3 cameraPosition, lights[2], powers[2], tint;
in vec3 along, place, outward;
in float strand;
out vec4 color;
void main() {
  vec3 toEye = normalize(cameraPosition - place), t = normalize(along), sum = vec3(0.0);
  for (int k = 0; k < 2; ++k) {
    float lit = smoothstep(-0.35, 0.55, dot(normalize(outward), lights[k]));
    float cosine = length(cross(lights[k], t));
    sum += powers[k] * lit * (cuticle_hair_scattering(lights[k], toEye, t) + tint * (0.004 + 0.014 * cosine));
  }
  sum *= 0.75 + 0.5 * strand;
  color = vec4(pow(sum / (1.0 + 0.35 * sum), vec3(1.0 / 2.2)), 1.0);
}`;

// A number in [0, 1) for a strand and a purpose.
const chance = (k, purpose) => { const x = Math.sin(k * 12.9898 + purpose * 78.233) * 43758.5453; return x - Math.floor(x); };

// Roots over the upper part of the ball; each strand slides down the ball, then falls, with waves that grow toward the tip.
function strandPoints(k) {
  const azimuth = 2 * Math.PI * chance(k, 1), height = 0.15 + 0.85 * Math.sqrt(chance(k, 2)), lift = 1 + 0.10 * chance(k, 3);
  const start = Math.acos(Math.min(height, 0.999)), length = 1.75 + 0.35 * chance(k, 4), lock = Math.floor(azimuth * 9), points = [];
  for (let i = 0; i < POINTS; ++i) {
    const s = length * i / (POINTS - 1), down = start + s, fall = Math.max(0, down - 1.75), polar = Math.min(down, 1.75);
    const wave = 0.035 * s * s, phase = 5.5 * s + 2.1 * lock + 0.7 * chance(k, 5), spin = azimuth + wave * Math.sin(phase) * 0.9;
    const radius = lift * (1 + 0.05 * s + wave * 0.5 * Math.cos(phase));
    points.push(new Vector3(radius * Math.sin(polar) * Math.sin(spin), radius * Math.cos(polar) - fall * 1.05,
                            radius * Math.sin(polar) * Math.cos(spin)));
  }
  return points;
}

function hair() {
  const position = [], tangent = [], normal = [], side = [], index = [];
  for (let k = 0; k < STRANDS; ++k) {
    const points = strandPoints(k), first = position.length / 3;
    points.forEach((point, i) => {
      const along = points[Math.min(i + 1, POINTS - 1)].clone().sub(points[Math.max(i - 1, 0)]).normalize();
      const outward = new Vector3(point.x, Math.max(point.y, 0), point.z).normalize();
      for (const s of [-1, 1]) {
        position.push(...point.toArray()); tangent.push(...along.toArray()); normal.push(...outward.toArray());
        side.push(s * (1 - 0.7 * i / POINTS), chance(k, 6));
      }
      if (i + 1 < POINTS) { const v = first + 2 * i; index.push(v, v + 1, v + 2, v + 1, v + 3, v + 2); }
    });
  }
  const geometry = new BufferGeometry();
  for (const [name, values, count] of [['position', position, 3], ['tangent', tangent, 3], ['normal', normal, 3], ['side', side, 2]])
    geometry.setAttribute(name, new BufferAttribute(new Float32Array(values), count));
  geometry.setIndex(index);
  return geometry;
}

const plainMaterial = () => new RawShaderMaterial({
  glslVersion: GLSL3, vertexShader: `${HEAD}uniform mat4 projectionMatrix, viewMatrix; in vec3 position;
void main() { gl_Position = projectionMatrix * viewMatrix * vec4(position, 1.0); }`,
  fragmentShader: `${HEAD}out vec4 color; void main() { color = vec4(0.05, 0.035, 0.03, 1.0); }` });

/// Draws into the renderer's canvas, 600 x 640.
export function drawTress(renderer, lut, glsl) {
  renderer.setSize(600, 640, false);
  renderer.setClearColor(new Color(0x14161a));
  const camera = new PerspectiveCamera(30, 600 / 640, 0.1, 20);
  camera.position.set(0.5, 0.75, 6.3);
  camera.lookAt(0, -0.25, 0);
  const uniforms = { ...lut.uniforms, lights: { value: [new Vector3(0.3, 0.55, 0.9).normalize(), new Vector3(-0.8, 0.5, -0.75).normalize()] },
                     powers: { value: [new Vector3(15, 14.4, 13.5), new Vector3(4, 4.4, 5)] }, tint: { value: new Vector3(0.6, 0.36, 0.2) } };
  const scene = new Scene();
  scene.add(new Mesh(new SphereGeometry(0.98, 48, 32), plainMaterial()));
  scene.add(new Mesh(hair(), new RawShaderMaterial({ glslVersion: GLSL3, uniforms, vertexShader: VERTEX,
                                                    fragmentShader: HEAD + glsl + FRAGMENT, side: DoubleSide })));
  scene.children.forEach((mesh) => { mesh.frustumCulled = false; });
  renderer.render(scene, camera);
}
