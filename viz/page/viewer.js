// Draws hair.js: hair by tables baked here, deep opacity shadow, and sliders. A still picture gathers frames until it is smooth.
import * as THREE from 'three';
import { OrbitControls } from 'three/orbit';
import { modelGlsl } from 'cuticle/model';
import { Tables } from 'cuticle/tables';
import { headGeometry, strandGeometry } from 'cuticle/strands';
import { depthMaterial, opacityMaterial, ribbonMaterial, skinMaterial } from 'cuticle/shading';

const MAP = 768, STILL_FRAMES = 48, RADIAN = Math.PI / 180;
const hair = window.cuticleHair, canvas = document.getElementById('view');
const asked = new URLSearchParams(location.search);

function say(words) {
  document.getElementById('wrong').textContent = words;
}

function makeRenderer() {
  const renderer = new THREE.WebGLRenderer({ canvas, antialias: false, preserveDrawingBuffer: true });
  if (!renderer.extensions.has('EXT_color_buffer_float')) throw new Error('This browser cannot draw into textures of floats (EXT_color_buffer_float).');
  renderer.autoClear = false;
  return renderer;
}

const floats = (width, height, options = {}) => new THREE.WebGLRenderTarget(width, height, {
  type: THREE.FloatType, minFilter: THREE.NearestFilter, magFilter: THREE.NearestFilter, ...options });

class Light {
  constructor(sphere) {
    this.sphere = sphere;
    this.camera = new THREE.OrthographicCamera(-sphere.radius, sphere.radius, sphere.radius, -sphere.radius, 0, 2 * sphere.radius);
    this.first = floats(MAP, MAP);
    this.opacity = floats(MAP, MAP, { type: THREE.HalfFloatType, minFilter: THREE.LinearFilter, magFilter: THREE.LinearFilter, depthBuffer: false });
    this.pixels = { value: new THREE.Vector2(MAP, MAP) };
  }
  aim(toLight) {
    this.camera.position.copy(toLight).multiplyScalar(this.sphere.radius).add(this.sphere.center);
    this.camera.up.set(0, 1, 0).addScaledVector(toLight, -toLight.y);
    if (this.camera.up.lengthSq() < 1e-4) this.camera.up.set(0, 0, 1);
    this.camera.lookAt(this.sphere.center);
    this.camera.updateMatrixWorld();
    this.camera.updateProjectionMatrix();
  }
  matrix() {
    return new THREE.Matrix4().multiplyMatrices(this.camera.projectionMatrix, this.camera.matrixWorldInverse);
  }
}

class Viewer {
  constructor() {
    this.renderer = makeRenderer();
    this.tables = new Tables(this.renderer, modelGlsl);
    const strands = strandGeometry(hair);
    strands.computeBoundingSphere();
    this.center = strands.boundingSphere.center.clone();
    const whole = strands.boundingSphere.clone();
    const head = hair.head ? headGeometry(hair.head) : null;
    this.light = new Light(whole);
    this.values = { ...hair.parameters, light_azimuth: 40, light_height: 35, light: 1, exposure: 0, width: hair.widen, shadow: 1, ambient: 0.35 };
    this.makeMaterials();
    const scene = (hairMaterial, skin) => {
      const made = new THREE.Scene();
      if (head && skin) made.add(new THREE.Mesh(head, skin));
      made.add(new THREE.Mesh(strands, hairMaterial));
      made.traverse((each) => { each.frustumCulled = false; });
      return made;
    };
    const of = this.materials;
    this.scenes = { view: scene(of.hair, of.skin), first: scene(of.hairDepth, of.skinDepth), opacity: scene(of.hairOpacity, of.skinOpacity) };
    this.camera = new THREE.PerspectiveCamera(24, 1, 0.01, 20);
    const distance = whole.radius / Math.sin(12 * RADIAN) * 1.05;
    this.camera.position.set(0.55, 0.12, 0.82).normalize().multiplyScalar(distance).add(this.center);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.target.copy(this.center);
    this.controls.addEventListener('change', () => this.restart());
    this.controls.update();
    this.makeDisplay();
    window.addEventListener('resize', () => this.resize());
    this.resize();
    this.bake();
  }

  makeMaterials() {
    const u = this.uniforms = {
      ...this.tables.bindings, toLight: { value: new THREE.Vector3() }, irradiance: { value: new THREE.Color() }, ambient: { value: new THREE.Color() },
      forward: { value: new THREE.Vector3() }, back: { value: new THREE.Vector3() }, frame: { value: 0 }, widen: { value: 1 },
      pixels: { value: new THREE.Vector2() }, firstDepth: { value: this.light.first.texture }, opacity: { value: this.light.opacity.texture },
      toMap: { value: new THREE.Matrix4() }, range: { value: 1 }, blur: { value: 4 / MAP }, shadows: { value: 1 } };
    const map = { pixels: this.light.pixels, widen: u.widen };
    const second = { ...map, firstDepth: u.firstDepth };
    this.materials = { hair: ribbonMaterial(u), skin: skinMaterial(u), hairDepth: depthMaterial(map, true), skinDepth: depthMaterial(map, false),
                       hairOpacity: opacityMaterial(second, true), skinOpacity: opacityMaterial(second, false) };
  }

  makeDisplay() {
    const show = { gathered: { value: null }, share: { value: 1 }, exposure: { value: 1 } };
    const vertexShader = 'out vec2 uv_; void main() { uv_ = uv; gl_Position = vec4(position.xy, 0.0, 1.0); }';
    const quad = (fragmentShader, more = {}) => new THREE.Mesh(new THREE.PlaneGeometry(2, 2), new THREE.ShaderMaterial({
      glslVersion: THREE.GLSL3, uniforms: show, depthTest: false, depthWrite: false, vertexShader, fragmentShader, ...more }));
    const head = 'in vec2 uv_; uniform sampler2D gathered; uniform float share, exposure; out vec4 color;\n';
    this.show = show;
    this.adding = quad(head + 'void main() { color = vec4(textureLod(gathered, uv_, 0.0).rgb, 1.0); }', {
      blending: THREE.CustomBlending, blendSrc: THREE.OneFactor, blendDst: THREE.OneFactor, blendSrcAlpha: THREE.OneFactor, blendDstAlpha: THREE.OneFactor, transparent: true });
    this.showing = quad(head + `
      void main() {
        vec3 light = textureLod(gathered, uv_, 0.0).rgb * share * exposure;
        vec3 kept = mix(light, 0.8 + 0.2 * (1.0 - exp(-(light - 0.8) / 0.2)), step(0.8, light));
        color = vec4(mix(12.92 * kept, 1.055 * pow(max(kept, 0.0), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, kept)), 1.0);
      }`);
    this.plain = new THREE.OrthographicCamera();
  }

  resize() {
    const width = canvas.clientWidth, height = canvas.clientHeight, ratio = Number(asked.get('ratio')) || Math.min(window.devicePixelRatio, 2);
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.size = this.renderer.getDrawingBufferSize(new THREE.Vector2());
    this.camera.aspect = width / height;
    this.shift = width > 700 ? 0.5 * 262 / width * this.size.x : 0;  // beside the panel
    this.uniforms.pixels.value.copy(this.size);
    for (const each of [this.one, this.sum]) each?.dispose();
    this.one = floats(this.size.x, this.size.y, { type: THREE.HalfFloatType });
    this.sum = floats(this.size.x, this.size.y, { type: THREE.HalfFloatType, depthBuffer: false });
    this.restart();
  }

  bake() {
    const v = this.values;
    this.tables.bake({ eta: v.eta, sigma_a: v.sigma_a, beta: v.beta_deg * RADIAN, alpha: v.alpha_deg * RADIAN });
    const shares = this.tables.forwardAndBack();
    this.uniforms.forward.value.set(...shares.forward);
    this.uniforms.back.value.set(...shares.back);
    this.relight();
  }

  relight() {
    const v = this.values, u = this.uniforms, height = v.light_height * RADIAN, azimuth = v.light_azimuth * RADIAN;
    u.toLight.value.set(Math.cos(height) * Math.sin(azimuth), Math.sin(height), Math.cos(height) * Math.cos(azimuth));
    u.irradiance.value.setRGB(3.9, 3.65, 3.3).multiplyScalar(v.light);
    u.ambient.value.setRGB(0.9, 1, 1.12).multiplyScalar(v.ambient);
    u.widen.value = v.width;
    u.shadows.value = v.shadow;
    this.show.exposure.value = 2 ** v.exposure;
    this.light.aim(u.toLight.value);
    u.toMap.value.copy(this.light.matrix());
    for (const [target, scene, clear] of [[this.light.first, this.scenes.first, 1], [this.light.opacity, this.scenes.opacity, 0]])
      this.draw(target, scene, this.light.camera, new THREE.Color(clear, clear, clear), clear);
    this.restart();
  }

  draw(target, scene, camera, color, alpha) {
    this.renderer.setRenderTarget(target);
    this.renderer.setClearColor(color, alpha);
    this.renderer.clear();
    this.renderer.render(scene, camera);
  }

  restart() {
    this.frames = 0;
    if (!this.asking) this.asking = requestAnimationFrame(() => this.gather());
  }

  // One more frame, moved by a part of a pixel.
  gather() {
    const n = this.frames++;
    this.asking = 0;
    const part = (base) => { let f = 1, r = 0; for (let i = n + 1; i > 0; i = Math.floor(i / base)) r += (f /= base) * (i % base); return r - 0.5; };
    this.camera.setViewOffset(this.size.x, this.size.y, part(2) + this.shift, part(3), this.size.x, this.size.y);
    this.uniforms.frame.value = n;
    this.draw(this.one, this.scenes.view, this.camera, new THREE.Color().setRGB(0.035, 0.036, 0.04), 1);
    this.show.gathered.value = this.one.texture;
    this.renderer.setRenderTarget(this.sum);
    this.renderer.setClearColor(0, 0);
    if (n === 0) this.renderer.clear();
    this.renderer.render(this.adding, this.plain);
    this.show.gathered.value = this.sum.texture;
    this.show.share.value = 1 / this.frames;
    this.renderer.setRenderTarget(null);
    this.renderer.render(this.showing, this.plain);
    if (this.frames < (Number(asked.get('frames')) || STILL_FRAMES)) this.asking = requestAnimationFrame(() => this.gather());
    else document.body.dataset.still = 'yes';
  }
}

const SLIDERS = [
  ['Model: marschner', [
    ['eta', 'refractive index', 1.3, 1.8, 0.01, 'bake'],
    ['sigma_a.0', 'absorption, red (1 / radius)', 0, 2, 0.005, 'bake'], ['sigma_a.1', 'absorption, green', 0, 2, 0.005, 'bake'],
    ['sigma_a.2', 'absorption, blue', 0, 2, 0.005, 'bake'], ['beta_deg', 'roughness beta (degrees)', 3, 30, 0.25, 'bake'],
    ['alpha_deg', 'tilt of the scales alpha (degrees)', -10, 0, 0.25, 'bake']]],
  ['Light', [
    ['light_azimuth', 'around (degrees)', -180, 180, 1, 'relight'], ['light_height', 'height (degrees)', -30, 89, 1, 'relight'],
    ['light', 'strength', 0, 4, 0.05, 'relight'], ['ambient', 'sky', 0, 2, 0.05, 'relight'],
    ['shadow', 'shadow: share of the opacity', 0, 2, 0.05, 'relight'], ['width', 'width of the strands (times)', 0.25, 12, 0.05, 'relight'],
    ['exposure', 'exposure (stops)', -4, 4, 0.1, 'relight']]]];

function addSlider(panel, viewer, [name, words, least, most, step, then]) {
  const [key, place] = name.split('.'), label = panel.appendChild(document.createElement('label'));
  const get = () => place ? viewer.values[key][place] : viewer.values[key];
  const output = document.createElement('output'), input = document.createElement('input');
  Object.assign(input, { type: 'range', min: Math.min(least, get()), max: Math.max(most, get()), step, id: name });
  input.value = get();
  const tell = () => { output.textContent = Number(get().toPrecision(3)); };
  input.addEventListener('input', () => {
    if (place) viewer.values[key][place] = Number(input.value);
    else viewer.values[key] = Number(input.value);
    tell();
    delete document.body.dataset.still;
    viewer[then]();
  });
  label.append(words, output, input);
  tell();
}

function addPanel(viewer) {
  const panel = document.getElementById('panel');
  panel.appendChild(document.createElement('h1')).textContent = hair.title;
  panel.appendChild(document.createElement('p')).textContent = hair.words;
  for (const [title, sliders] of SLIDERS) {
    panel.appendChild(document.createElement('h2')).textContent = title;
    for (const slider of sliders) addSlider(panel, viewer, slider);
  }
}

try {
  const viewer = window.cuticleViewer = new Viewer();
  addPanel(viewer);
} catch (error) {
  say(`The hair cannot be shown: ${error.message ?? error}`);
  throw error;
}
