#pragma once
// A folder that shows a groom in any browser with WebGL 2, opened from disk.
#include <string>

#include "bsdf/marschner/marschner.h"
#include "core/progress.h"
#include "core/result.h"
#include "strands/groom.h"
#include "strands/mesh.h"

namespace cuticle::viz::page {

/// What the page shows. `three`: the folder of npm's package three; empty: CUTICLE_THREE, or node_modules here, above,
/// or in `also`.
struct PageRequest {
  strands::Groom groom;
  strands::Mesh head = {};  ///< without vertices: none
  std::string title = "hair", three = {}, also = {};
  std::size_t strands = 20000;        ///< at most so many are shown, as much wider as they are fewer
  bsdf::marschner::Parameters model;  ///< corrected, its exact caustic at theta_d, a circle
};
/// Whether a page can be made, whatever the groom. Errors: bad_input where three.js is not found, with what to install;
/// usage where the model is a form that the page cannot bake.
Result<void> check_page(const PageRequest& request);
/// Writes index.html and hair.js into the folder, which it makes. Errors: those of check_page. Test: tests/browser
/// (test_viewer.py).
Result<void> write_page(const PageRequest& request, const std::string& folder, Progress& progress);

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
Result<std::string> index_page(const std::string& three_folder, const std::string& snippet, const std::string& title);

}  // namespace cuticle::viz::page
