// The tables of `cuticle bake --layout nalu_theta`, made on this device from the same formulas whenever a slider moves.
import * as THREE from 'three';

export const TABLES = ['M', 'N_TT_R', 'N_TRT'], SIZE = 128;
const FULL_SCREEN = 'void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }';
const HEAD = 'precision highp float;\nprecision highp int;\n';

// A texel's value: rows and columns run from the first to the last value of their axis. N_TRT holds means over a texel's azimuths.
const TEXELS = [`
  Inclinations t = make_inclinations((place.x - 0.5) * PI, (place.y - 0.5) * PI);
  vec4 found = vec4(0.0);
  for (int p = 0; p < 3; ++p) found[p] = longitudinal(longitudinal_lobe(m, p), t.sin_i, t.cos_i, t.sin_o, t.cos_o);`, `
  Refraction r = refraction_at(m, 0.5 * PI * place.y);
  Azimuth a = make_azimuth(PI * place.x);
  vec4 found = vec4(azimuthal_tt(r, a, false), azimuthal_r(r, a, false).x);`, `
  Refraction r = refraction_at(m, 0.5 * PI * place.y);
  Caustic c = make_caustic(r);
  vec2 edges = clamp(vec2(gl_FragCoord.x - 1.0, gl_FragCoord.x) / ${SIZE - 1}.0, 0.0, 1.0) * PI;
  TrtRoots ends[2];
  for (int k = 0; k < 2; ++k) ends[k] = trt_roots(r, c, edges[k]);
  vec4 found = vec4(mean_trt(r, c, ends[0], ends[1], edges.y - edges.x), 0.0);`];

export class Tables {
  constructor(renderer, model) {
    this.renderer = renderer;
    this.uniforms = { eta: { value: 1 }, sigma_a: { value: new THREE.Vector3() }, beta: { value: 1 }, alpha: { value: 0 } };
    this.targets = TABLES.map(() => new THREE.WebGLRenderTarget(SIZE, SIZE, {
      type: THREE.HalfFloatType, minFilter: THREE.LinearFilter, magFilter: THREE.LinearFilter, depthBuffer: false }));
    const materials = TEXELS.map((text) => new THREE.RawShaderMaterial({
      glslVersion: THREE.GLSL3, uniforms: this.uniforms, depthTest: false, vertexShader: HEAD + 'in vec3 position;\n' + FULL_SCREEN,
      fragmentShader: `${HEAD}${model}
        uniform float eta, beta, alpha;
        uniform vec3 sigma_a;
        out vec4 texel;
        const float PI = 3.14159265358979;
        void main() {
          vec2 place = (gl_FragCoord.xy - 0.5) / ${SIZE - 1}.0;
          Marschner m = make_marschner(eta, sigma_a, beta, alpha);
          ${text}
          texel = min(found, vec4(65504.0));
        }` }));
    this.quads = materials.map((material) => new THREE.Mesh(new THREE.PlaneGeometry(2, 2), material));
    this.camera = new THREE.OrthographicCamera();
    this.bindings = Object.fromEntries(TABLES.map((name, k) => [`cuticle_${name}`, { value: this.targets[k].texture }]));
  }

  bake({ eta, sigma_a, beta, alpha }) {
    const u = this.uniforms, before = this.renderer.getRenderTarget();
    u.eta.value = eta;
    u.sigma_a.value.set(...sigma_a);
    u.beta.value = beta;
    u.alpha.value = alpha;
    this.quads.forEach((quad, k) => {
      this.renderer.setRenderTarget(this.targets[k]);
      this.renderer.render(quad, this.camera);
    });
    this.renderer.setRenderTarget(before);
  }

  // The texels of table k as floats, first row first.
  read(k) {
    const halves = new Uint16Array(4 * SIZE * SIZE);
    this.renderer.readRenderTargetPixels(this.targets[k], 0, 0, SIZE, SIZE, halves);
    return Float32Array.from(halves, THREE.DataUtils.fromHalfFloat);
  }

  // Shares of the light that a fibre sends on and back, over all azimuths at a middle inclination: what dual scattering
  // (Zinke et al. 2008, section 4.1) calls a_f and a_b.
  forwardAndBack() {
    const row = Math.round(SIZE * 0.3), [tt, trt] = [this.read(1), this.read(2)];
    const shares = { forward: [0, 0, 0], back: [0, 0, 0] }, step = 2 * Math.PI / (SIZE - 1);
    for (let x = 0; x < SIZE; ++x)
      for (let c = 0; c < 3; ++c) {
        const texel = 4 * (row * SIZE + x), n = tt[texel + c] + tt[texel + 3] + trt[texel + c];
        shares[x < SIZE / 2 ? 'back' : 'forward'][c] += n * step * (x === 0 || x === SIZE - 1 ? 0.5 : 1);
      }
    for (const side of ['forward', 'back']) shares[side] = shares[side].map((a) => Math.min(a, 0.99));
    return shares;
  }
}
