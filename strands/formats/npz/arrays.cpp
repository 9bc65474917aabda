#include <cmath>
#include <cstring>

#include <fmt/core.h>
#include <glm/gtc/packing.hpp>

#include "core/memory_limit.h"
#include "strands/formats/bytes.h"
#include "strands/formats/npz/detail/arrays.h"
#include "strands/formats/words.h"

namespace cuticle::strands::npz {

namespace {

constexpr std::string_view k_magic = "\x93NUMPY";
constexpr std::size_t k_max_axes = 8;

/// The text after `key` in the header's dictionary, past its colon; empty where there is none.
std::string_view value_of(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(key);
  if (at == header.npos) return {};
  const std::string_view rest = header.substr(at + key.size());
  const std::size_t colon = rest.find(':');
  return colon == rest.npos ? std::string_view()
                            : rest.substr(std::min(rest.find_first_not_of(" ", colon + 1), rest.size()));
}

struct Header {
  char kind = 'f';
  std::size_t item = 4;
  std::vector<std::uint64_t> shape;
  std::size_t data = 0;  ///< offset of the numbers
};

class Parser {
 public:
  Parser(std::span<const std::byte> bytes, const std::string& name, const std::string& where)
      : bytes_(bytes, where), name_(name) {}

  Result<Array> parse() {
    CUTICLE_TRY(read_header());
    Array array{.name = name_, .shape = header_.shape};
    const std::uint64_t room = (bytes_.size() - header_.data) / header_.item;
    const std::optional<std::uint64_t> count = product_within(room, header_.shape);
    if (!count) return error("shape", fmt::format("more than the {} numbers of its bytes", room));
    CUTICLE_TRY(header_.kind == 'f' ? read_reals(*count, array.values) : read_whole(*count, array.whole));
    return array;
  }

 private:
  Error error(const char* field, const std::string& problem) const {
    return bad_input(fmt::format("{}: array '{}': {}: {}", bytes_.where(), name_, field, problem));
  }

  Result<std::string_view> header_text() {
    const std::string_view all = to_text({bytes_.data(), bytes_.size()});
    if (!all.starts_with(k_magic) || !bytes_.has(0, 12)) return error("header", "no .npy");
    const bool is_long = bytes_.at<std::uint8_t>(6) > 1;
    const std::uint64_t begin = is_long ? 12 : 10;
    const std::uint64_t length = is_long ? bytes_.at<std::uint32_t>(8) : bytes_.at<std::uint16_t>(8);
    if (!bytes_.has(begin, length)) return error("header", fmt::format("{} bytes, the file ends before", length));
    header_.data = begin + length;
    return all.substr(begin, length);
  }

  Result<void> read_header() {
    CUTICLE_ASSIGN(const std::string_view text, header_text());
    const std::string_view type = value_of(text, "'descr'").substr(0, 6);
    if (type.size() < 5 || (type[1] != '<' && type[1] != '|') || std::string_view("fiub").find(type[2]) == type.npos ||
        std::string_view("1248").find(type[3]) == type.npos || type.substr(2, 2) == "f1" || type[4] != type[0])
      return error("descr", fmt::format("{}, allowed little-endian f2 f4 f8, i and u of 1, 2, 4, 8 bytes, bool", type));
    header_.kind = type[2];
    header_.item = std::size_t(type[3] - '0');
    if (!value_of(text, "'fortran_order'").starts_with("False")) return error("fortran_order", "must be False");
    return read_shape(value_of(text, "'shape'"));
  }

  Result<void> read_shape(std::string_view text) {
    const std::size_t end = text.find(')');
    if (!text.starts_with('(') || end == text.npos) return error("shape", "no tuple");
    text = text.substr(1, end - 1);
    while (!text.empty()) {
      const std::size_t comma = std::min(text.find(','), text.size());
      std::string_view part = text.substr(0, comma);
      text.remove_prefix(std::min(comma + 1, text.size()));
      const std::string_view word = next_word(part);
      if (word.empty()) continue;
      const std::optional<double> extent = to_number(word);
      if (!extent || !(*extent >= 0 && *extent < 1e15) || *extent != std::floor(*extent) ||
          header_.shape.size() == k_max_axes)
        return error("shape", fmt::format("'{}'", word.substr(0, 40)));
      header_.shape.push_back(std::uint64_t(*extent));
    }
    return {};
  }

  Result<void> read_reals(std::uint64_t count, std::vector<float>& values) const {
    values.resize(count);
    if (header_.item == 4 && count > 0) std::memcpy(values.data(), bytes_.data() + header_.data, 4 * count);
    for (std::uint64_t i = 0; header_.item != 4 && i < count; ++i) {
      const std::uint64_t at = header_.data + i * header_.item;
      values[i] = header_.item == 2 ? glm::unpackHalf1x16(bytes_.at<std::uint16_t>(at)) : float(bytes_.at<double>(at));
    }
    return {};
  }

  Result<void> read_whole(std::uint64_t count, std::vector<std::uint32_t>& whole) const {
    whole.resize(count);
    for (std::uint64_t i = 0; i < count; ++i) {
      std::uint64_t value = 0;
      std::memcpy(&value, bytes_.data() + header_.data + i * header_.item, header_.item);
      const bool is_negative = header_.kind == 'i' && (value >> (8 * header_.item - 1)) != 0;
      if (is_negative || value > 0xffffffffu)
        return error("values", fmt::format("number {} is outside 0 .. 4294967295", i));
      whole[i] = std::uint32_t(value);
    }
    return {};
  }

  ByteView bytes_;
  const std::string& name_;
  Header header_;
};

std::vector<std::byte> format_array(std::string_view type, std::span<const std::uint64_t> shape,
                                    std::span<const std::byte> data) {
  std::string extents;
  for (std::uint64_t extent : shape) extents += fmt::format("{}, ", extent);
  std::string header = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, extents);
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  std::vector<std::byte> bytes = to_bytes(k_magic);
  append(bytes, std::uint8_t(1));
  append(bytes, std::uint8_t(0));
  append(bytes, std::uint16_t(header.size()));
  append_all(bytes, std::as_bytes(std::span(header)));
  append_all(bytes, data);
  return bytes;
}

}  // namespace

std::uint64_t Array::count() const { return values.size() + whole.size(); }

Result<Array> parse_npy(std::span<const std::byte> bytes, const std::string& name, const std::string& where) {
  return Parser(bytes, name, where).parse();
}

std::vector<std::byte> format_npy(std::span<const float> values, std::span<const std::uint64_t> shape) {
  return format_array("<f4", shape, std::as_bytes(values));
}

std::vector<std::byte> format_npy(std::span<const std::uint32_t> values) {
  const std::uint64_t count = values.size();
  return format_array("<u4", {&count, 1}, std::as_bytes(values));
}

}  // namespace cuticle::strands::npz
