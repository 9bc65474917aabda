#include "study/demo/demo_page.h"

#include "core/file.h"
#include "core/json/json.h"

namespace cuticle::study {

namespace {

Json section_json(const DemoSection& section) {
  Json json = {{"title", section.title}, {"text", section.text}, {"images", Json::list()}};
  for (const auto& [file, caption] : section.images) json["images"].push_back({{"file", file}, {"caption", caption}});
  if (!section.table.columns.empty()) json["table"] = {{"columns", section.table.columns}, {"rows", section.table.rows}};
  return json;
}

}  // namespace

Result<void> write_page(const DemoPage& page, const std::string& folder) {
  Json json = {{"title", page.title}, {"sections", Json::list()}};
  for (const DemoSection& section : page.sections) json["sections"].push_back(section_json(section));
  return write_text_file(folder + "/demo.json", json.dump(1));
}

}  // namespace cuticle::study
