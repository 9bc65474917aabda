// Straight strands, one a cell, each with its own tangent and light, seen along -z: the pixel in the middle of a cell is S.
import { BufferAttribute, BufferGeometry, FloatType, GLSL3, Mesh, OrthographicCamera, RawShaderMaterial, WebGLRenderTarget } from 'three';

const CELL = 5;  // pixels; odd, so that a pixel has its centre in the middle of the cell
const HEAD = 'precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n';
const VERTEX = `${HEAD}
in vec3 position, tangent, light, eye;
out vec3 along, toLight, toEye;
void main() {
  along = tangent; toLight = light; toEye = eye;
  gl_Position = vec4(position, 1.0);
}`;
const FRAGMENT = `
in vec3 along, toLight, toEye;
out vec4 scattered;
void main() { scattered = vec4(cuticle_hair_scattering(normalize(toLight), normalize(toEye), normalize(along)), 1.0); }`;

// A ribbon through the middle of a cell, along the tangent's projection, as two triangles.
function ribbon(pair, column, row, columns, rows) {
  const [x, y] = [(column + 0.5) * 2 / columns - 1, (row + 0.5) * 2 / rows - 1], length = Math.hypot(pair.tangent[0], pair.tangent[1]);
  const [a, b] = length > 1e-3 ? [pair.tangent[0] / length, pair.tangent[1] / length] : [0, 1];
  const corner = (s, t) => [x + (a * s - b * t) / columns, y + (b * s + a * t) / rows, 0];
  return [corner(-0.9, -0.5), corner(0.9, -0.5), corner(0.9, 0.5), corner(-0.9, -0.5), corner(0.9, 0.5), corner(-0.9, 0.5)];
}

/// S [r, g, b] of each pair { tangent, light, eye } as the snippet gives it on the device.
export function measure(renderer, lut, glsl, pairs) {
  const columns = Math.ceil(Math.sqrt(pairs.length)) || 1, rows = Math.ceil(pairs.length / columns) || 1;
  const data = { position: [], tangent: [], light: [], eye: [] };
  pairs.forEach((pair, k) => {
    for (const corner of ribbon(pair, k % columns, Math.floor(k / columns), columns, rows)) {
      data.position.push(...corner);
      for (const name of ['tangent', 'light', 'eye']) data[name].push(...pair[name]);
    }
  });
  const geometry = new BufferGeometry();
  for (const [name, values] of Object.entries(data)) geometry.setAttribute(name, new BufferAttribute(new Float32Array(values), 3));
  const material = new RawShaderMaterial({ glslVersion: GLSL3, uniforms: lut.uniforms, vertexShader: VERTEX,
                                           fragmentShader: HEAD + glsl + FRAGMENT, depthTest: false });
  const target = new WebGLRenderTarget(columns * CELL, rows * CELL, { type: FloatType });
  const mesh = new Mesh(geometry, material);
  mesh.frustumCulled = false;
  renderer.setRenderTarget(target);
  renderer.render(mesh, new OrthographicCamera());
  const pixels = new Float32Array(columns * CELL * rows * CELL * 4);
  renderer.readRenderTargetPixels(target, 0, 0, columns * CELL, rows * CELL, pixels);
  renderer.setRenderTarget(null);
  return pairs.map((_, k) => {
    const x = (k % columns) * CELL + (CELL - 1) / 2, y = Math.floor(k / columns) * CELL + (CELL - 1) / 2;
    return Array.from(pixels.subarray(4 * (y * columns * CELL + x), 4 * (y * columns * CELL + x) + 3));
  });
}
