#include "strands/formats/number_text.h"

#include <algorithm>
#include <charconv>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

#include "core/expect.h"

namespace cuticle::strands {

namespace {

constexpr std::size_t k_block = 1 << 16;  ///< numbers that a thread writes at once
constexpr std::size_t k_window = 64;      ///< blocks that are held before they are appended
constexpr std::size_t k_max_digits = 16;  ///< -1.1754944e-38, 4294967295

template <class T>
std::string rows_of(std::span<const T> values, std::size_t components, const RowText& form) {
  std::string text;
  text.reserve(values.size() * 12);
  for (std::size_t i = 0; i < values.size(); ++i) {
    text += i % components == 0 ? form.open : form.between;
    char digits[k_max_digits];
    text.append(digits, std::to_chars(digits, digits + k_max_digits, values[i]).ptr);
    if ((i + 1) % components == 0 || i + 1 == values.size()) (text += form.close) += form.after;
  }
  return text;
}

template <class T>
void append(std::string& text, std::span<const T> values, std::size_t components, const RowText& form) {
  CUTICLE_EXPECT(components > 0, "a row has numbers");
  const std::size_t block = std::max(k_block / components, std::size_t(1)) * components,
                    count = (values.size() + block - 1) / block;
  for (std::size_t first = 0; first < count; first += k_window) {
    std::vector<std::string> parts(std::min(k_window, count - first));
    oneapi::tbb::parallel_for(std::size_t(0), parts.size(), [&](std::size_t k) {
      const std::size_t begin = (first + k) * block;
      parts[k] = rows_of(values.subspan(begin, std::min(block, values.size() - begin)), components, form);
    });
    for (const std::string& part : parts) text += part;
  }
}

}  // namespace

void append_rows(std::string& text, std::span<const float> values, std::size_t components, const RowText& form) {
  append(text, values, components, form);
}
void append_rows(std::string& text, std::span<const std::uint32_t> values, std::size_t components,
                 const RowText& form) {
  append(text, values, components, form);
}

}  // namespace cuticle::strands
