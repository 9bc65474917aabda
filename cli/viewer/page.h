#pragma once
// A folder that shows a groom in any browser with WebGL 2, opened from disk.
#include <string>

#include "bsdf/marschner/marschner.h"
#include "core/result.h"
#include "strands/groom.h"
#include "strands/mesh.h"

namespace cuticle::cli::viewer {

/// Files of this folder, and the flattened formulas of the model (CMakeLists.txt).
extern const char* const k_page;
extern const char* const k_viewer;
extern const char* const k_tables_module;
extern const char* const k_strands_module;
extern const char* const k_shading_module;
extern const char* const k_model;

/// hair.js: strands, head (without vertices where there is none), parameters and words, as one object. Positions take
/// 16 bits of their box: at most 4 micrometres off on a head of half a metre.
std::string hair_script(const strands::Groom& groom, const strands::Mesh& head,
                        const bsdf::marschner::Parameters& model, const std::string& title, const std::string& words,
                        double widen);
/// index.html, with three.js of that folder in it. Error: bad_input where the folder holds no three.js of this kind.
Result<std::string> page(const std::string& three_folder, const std::string& snippet, const std::string& title);

}  // namespace cuticle::cli::viewer
