#pragma once
// Lists in a study's options.
#include <string>
#include <string_view>
#include <vector>

namespace cuticle::study {

/// "a,b,c" as its parts; empty text: none.
inline std::vector<std::string> split_commas(std::string_view text) {
  std::vector<std::string> parts;
  while (!text.empty()) {
    const std::size_t comma = text.find(',');
    parts.emplace_back(text.substr(0, comma));
    text = comma == std::string_view::npos ? "" : text.substr(comma + 1);
  }
  return parts;
}

}  // namespace cuticle::study
