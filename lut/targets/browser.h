#pragma once
// JavaScript that the targets of browsers' engines share.
#include <string>
#include <vector>

#include "lut/target.h"

namespace cuticle::lut::browser {

/// The files of an engine from its texts: hairLut.js, README.md and, where the tables make S, hairMaterial.js. The texts
/// may hold @VERSION@, @MODEL@, @TABLES@, @GLSL@ (the tables' functions in GLSL ES 3.00) and @READ@ (`addressOf(folder,
/// module)`, `manifestOf(base)` and `halfTable(url, format)` of KTX2 or DDS: width, height, halves). Error: usage where a browser cannot read the format.
Result<std::vector<TextFile>> files_of(const Manifest& manifest, std::string_view target,
                                       std::span<const std::string_view> formats, const char* module,
                                       const char* material, const char* readme);

}  // namespace cuticle::lut::browser
