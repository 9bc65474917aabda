#include "viz/page/page.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include <fmt/core.h>

#include "core/file.h"
#include "core/json/json.h"

namespace cuticle::viz::page {

namespace {

constexpr double k_steps = 65535, k_degree = std::numbers::pi / 180;

std::string base64(std::span<const std::byte> bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k) three = three << 8 | (k < count ? std::uint32_t(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[three >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}
template <class T>
std::string base64_of(const std::vector<T>& values) {
  return base64(std::as_bytes(std::span(values)));
}

Json triple(const glm::vec3& v) { return Json::list({v.x, v.y, v.z}); }

Json packed(const std::vector<glm::vec3>& positions) {
  glm::vec3 lower = positions.front(), upper = lower;
  for (const glm::vec3& position : positions) {
    lower = glm::min(lower, position);
    upper = glm::max(upper, position);
  }
  const glm::vec3 size = glm::max(upper - lower, glm::vec3(1e-6f));
  std::vector<std::uint16_t> steps;
  steps.reserve(3 * positions.size());
  for (const glm::vec3& position : positions)
    for (int c = 0; c < 3; ++c)
      steps.push_back(std::uint16_t(std::lround(k_steps * double((position[c] - lower[c]) / size[c]))));
  return {{"lower", triple(lower)}, {"size", triple(size)}, {"steps", base64_of(steps)}};
}

Json head_of(const strands::Mesh& head) {
  std::vector<std::uint32_t> corners;
  for (const auto& triangle : head.triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  return {{"positions", packed(head.positions)}, {"triangles", base64_of(corners)}};
}

Json model_of(const bsdf::marschner::Parameters& model) {
  return {{"eta", model.eta},
          {"sigma_a", Json::list({model.sigma_a.x, model.sigma_a.y, model.sigma_a.z})},
          {"beta_deg", model.beta / k_degree},
          {"alpha_deg", model.alpha / k_degree}};
}

std::string replaced(std::string text, std::string_view mark, std::string_view value) {
  const std::size_t at = text.find(mark);
  return at == text.npos ? text : text.replace(at, mark.size(), value);
}

/// Characters that would end an element of the page, or begin one, in a title.
std::string escaped(const std::string& text) {
  std::string made;
  for (const char c : text) {
    if (c == '<')
      made += "&lt;";
    else if (c == '&')
      made += "&amp;";
    else
      made += c;
  }
  return made;
}

std::string module_text(std::string_view name, const std::string& text) {
  return fmt::format("export const {} = {};\n", name, Json(text).dump());
}

std::string address(std::string_view text) {
  return "data:text/javascript;base64," + base64(std::as_bytes(std::span(text.data(), text.size())));
}

}  // namespace

std::string hair_script(const strands::Groom& groom, const strands::Mesh& head,
                        const bsdf::marschner::Parameters& model, const std::string& title, const std::string& words,
                        double widen) {
  const float greatest = *std::ranges::max_element(groom.radii);
  std::vector<std::uint16_t> radii;
  for (const float radius : groom.radii)
    radii.push_back(std::uint16_t(std::lround(k_steps * double(radius / greatest))));
  Json hair{{"title", title},
            {"words", words},
            {"widen", widen},
            {"offsets", base64_of(groom.offsets)},
            {"positions", packed(groom.positions)},
            {"radii", base64_of(radii)},
            {"greatest_radius", greatest},
            {"parameters", model_of(model)}};
  if (!head.positions.empty()) hair["head"] = head_of(head);
  return "window.cuticleHair = " + hair.dump() + ";\n";
}

Result<std::string> index_page(const std::string& three_folder, const std::string& snippet, const std::string& title) {
  CUTICLE_ASSIGN(const std::string core, read_text_file(three_folder + "/build/three.core.js"));
  CUTICLE_ASSIGN(std::string three, read_text_file(three_folder + "/build/three.module.js"));
  CUTICLE_ASSIGN(const std::string orbit, read_text_file(three_folder + "/examples/jsm/controls/OrbitControls.js"));
  constexpr std::string_view import = "'./three.core.js'";
  if (three.find(import) == three.npos)
    return bad_input(three_folder + ": three.module.js does not import three.core.js", "npm install three@0.187.0");
  while (three.find(import) != three.npos) three = replaced(std::move(three), import, "'three/core'");
  const Json imports{{"imports",
                      {{"three", address(three)},
                       {"three/core", address(core)},
                       {"three/orbit", address(orbit)},
                       {"cuticle/model", address(module_text("modelGlsl", k_model))},
                       {"cuticle/snippet", address(module_text("hairLutGlsl", snippet))},
                       {"cuticle/tables", address(k_tables_module)},
                       {"cuticle/strands", address(k_strands_module)},
                       {"cuticle/shading", address(k_shading_module)}}}};
  std::string text = replaced(k_page, "@TITLE@", escaped(title));
  text = replaced(std::move(text), "@IMPORTS@", imports.dump());
  return replaced(std::move(text), "@SCRIPT@", k_viewer);
}

}  // namespace cuticle::viz::page
