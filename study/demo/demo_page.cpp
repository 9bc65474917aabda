#include <cuticle/study/demo/demo_page.h>

#include <nlohmann/json.hpp>

#include <cuticle/core/file.h>

namespace cuticle::study {

namespace {

nlohmann::json section_json(const DemoSection& section) {
  nlohmann::json json = {{"title", section.title}, {"text", section.text}, {"images", nlohmann::json::array()}};
  for (const auto& [file, caption] : section.images) json["images"].push_back({{"file", file}, {"caption", caption}});
  if (!section.table.columns.empty()) json["table"] = {{"columns", section.table.columns}, {"rows", section.table.rows}};
  return json;
}

}  // namespace

Result<void> write_page(const DemoPage& page, const std::string& folder) {
  nlohmann::json json = {{"title", page.title}, {"sections", nlohmann::json::array()}};
  for (const DemoSection& section : page.sections) json["sections"].push_back(section_json(section));
  return write_text_file(folder + "/demo.json", json.dump(1));
}

}  // namespace cuticle::study
