#pragma once
// Names of joints, bones and clips as people type them.
#include <algorithm>
#include <cctype>
#include <string_view>

namespace cuticle::strands {

inline bool equal_ignoring_case(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  return std::ranges::equal(a, b, {}, lower, lower);
}

}  // namespace cuticle::strands
