#pragma once
// The sections of the demo's page, collected as data (demo.json); the Python package makes the HTML from it.
#include <string>
#include <utility>
#include <vector>

#include "core/result.h"

namespace cuticle::study {

struct DemoTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
};
struct DemoSection {
  std::string title, text;
  std::vector<std::pair<std::string, std::string>> images;  ///< file below the page's folder, caption
  DemoTable table;
};
struct DemoPage {
  std::string title;
  std::vector<DemoSection> sections;
};

/// Writes demo.json into the folder (schema: python/cuticle_report/README.md).
Result<void> write_page(const DemoPage& page, const std::string& folder);

}  // namespace cuticle::study
