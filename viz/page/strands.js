// The strands as ribbons that face the eye or the light, and the head as a mesh, out of hair.js.
import * as THREE from 'three';

function bytesOf(text) {
  return Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer;
}

// 16 bits of the box that the numbers lie in.
function positionsOf(packed) {
  const steps = new Uint16Array(bytesOf(packed.steps)), found = new Float32Array(steps.length);
  for (let i = 0; i < steps.length; ++i) found[i] = packed.lower[i % 3] + steps[i] / 65535 * packed.size[i % 3];
  return found;
}

function tangentsOf(positions, offsets) {
  const tangents = new Float32Array(positions.length), d = new THREE.Vector3();
  for (let s = 0; s + 1 < offsets.length; ++s)
    for (let v = offsets[s]; v < offsets[s + 1]; ++v) {
      const a = Math.max(v - 1, offsets[s]), b = Math.min(v + 1, offsets[s + 1] - 1);
      d.set(...[0, 1, 2].map((c) => positions[3 * b + c] - positions[3 * a + c]));
      if (d.lengthSq() === 0) d.set(0, 1, 0);
      d.normalize().toArray(tangents, 3 * v);
    }
  return tangents;
}

// Every vertex twice, at the ribbon's two sides.
function twice(values, components) {
  const found = new Float32Array(2 * values.length);
  for (let v = 0; v < values.length / components; ++v)
    for (let side = 0; side < 2; ++side)
      for (let c = 0; c < components; ++c) found[(2 * v + side) * components + c] = values[v * components + c];
  return found;
}

export function strandGeometry(hair) {
  const offsets = new Uint32Array(bytesOf(hair.offsets)), positions = positionsOf(hair.positions);
  const count = positions.length / 3, steps = new Uint16Array(bytesOf(hair.radii));
  const radii = Float32Array.from(steps, (step) => step / 65535 * hair.greatest_radius);
  const sides = new Float32Array(2 * count), numbers = new Float32Array(count), indices = [];
  for (let s = 0; s + 1 < offsets.length; ++s)
    for (let v = offsets[s]; v < offsets[s + 1]; ++v) {
      sides[2 * v] = -1;
      sides[2 * v + 1] = 1;
      numbers[v] = s;
      if (v + 1 < offsets[s + 1]) indices.push(2 * v, 2 * v + 1, 2 * v + 2, 2 * v + 1, 2 * v + 3, 2 * v + 2);
    }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(twice(positions, 3), 3));
  geometry.setAttribute('hairTangent', new THREE.BufferAttribute(twice(tangentsOf(positions, offsets), 3), 3));
  geometry.setAttribute('radius', new THREE.BufferAttribute(twice(radii, 1), 1));
  geometry.setAttribute('strand', new THREE.BufferAttribute(twice(numbers, 1), 1));
  geometry.setAttribute('side', new THREE.BufferAttribute(sides, 1));
  geometry.setIndex(new THREE.BufferAttribute(Uint32Array.from(indices), 1));
  return geometry;
}

export function headGeometry(head) {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute('position', new THREE.BufferAttribute(positionsOf(head.positions), 3));
  geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(bytesOf(head.triangles)), 1));
  geometry.computeVertexNormals();
  return geometry;
}
