#include "tests/hard_cases/catalogue.h"

#include <fmt/core.h>

namespace cuticle::hard_cases {

/// The texts of catalogue/*.json, ended by a null pointer; written into the build by CMake.
extern const char* const k_documents[];

namespace {

Json with_shared_groom(Json inputs, const Json& grooms) {
  const Json* groom = inputs.find("groom");
  if (groom != nullptr && groom->is_text()) inputs["groom"] = Json(grooms.at(groom->text()));
  return inputs;
}

Case case_of(const Json& item, const Json& document) {
  return {.id = item.at("id").text(),
          .family = document.value("family", item.at("subject").text()),
          .subject = item.at("subject").text(),
          .why = item.at("why").text(),
          .source = item.value("source", document.value("source", std::string())),
          .full = item.value("full", false),
          .inputs = with_shared_groom(item.at("inputs"), document.value("grooms", Json::object())),
          .expect = item.at("expect")};
}

}  // namespace

std::vector<Case> cases_of(const Json& document) {
  std::vector<Case> cases;
  for (const Json& item : document.at("cases")) cases.push_back(case_of(item, document));
  return cases;
}

Result<std::vector<Case>> all_cases() {
  std::vector<Case> all;
  for (const char* const* text = k_documents; *text != nullptr; ++text) {
    CUTICLE_ASSIGN(const Json document, Json::parse(*text));
    try {
      for (Case& item : cases_of(document)) all.push_back(std::move(item));
    } catch (const Json::Mismatch& error) {
      return internal_error(
          fmt::format("hard cases, family '{}': {}", document.value("family", std::string()), error.what()));
    }
  }
  return all;
}

}  // namespace cuticle::hard_cases
