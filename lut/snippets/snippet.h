#pragma once
// Shader text that reads a folder of tables, from its manifest: the same functions in GLSL, HLSL and WGSL.
#include "lut/manifest.h"
#include "lut/snippets/dialect.h"

namespace cuticle::lut::snippets {

/// The functions for one manifest:
///   `cuticle_read_TABLE(uv)`: the four channels decoded (stored * scale), level 0;
///   `cuticle_hair_scattering(light, eye, tangent)`: S of unit directions away from the fibre and the tangent from root
///   to tip, without the cosine of the light (only where the layout has terms);
///   `cuticle_verify_probes()`: 0, or 100 * table + probe, both from 1, of the first probe that reads wrong.
/// The textures cuticle_TABLE and, in HLSL and WGSL, cuticle_sampler are declared by the includer (`declarations`).
/// On software Vulkan and WebGPU S agrees with what the CPU reads from the same tables to 1.5 / 1024 of itself; to
/// 4 / 1024 where axes are angles, by the driver's arc functions (lut_snippet_gpu_test, tests/browser/test_wgsl.py).
/// Error: internal for an axis or a factor that no expression is known for.
Result<std::string> snippet(const Manifest& manifest, const Dialect& dialect);
/// The declarations that the snippet stands on; texture k at binding k, the sampler after the last.
std::string declarations(const Manifest& manifest, const Dialect& dialect);

}  // namespace cuticle::lut::snippets
