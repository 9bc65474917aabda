// Arrays of a VTK XML file (VTK File Formats, "XML File Formats"). Encoded ones are a header of one number, the bytes,
// or of 3 + n numbers where they are compressed: blocks, bytes of a block, bytes of the last where it is shorter (else
// 0), compressed bytes of each. Then the data. Base64 runs over both at once, or over each by itself where it is
// compressed.
#include "strands/formats/vtp/detail/values.h"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/core.h>
#include <zlib.h>

#include "core/memory_limit.h"
#include "strands/formats/bytes.h"
#include "strands/formats/words.h"

namespace cuticle::strands::vtp {

namespace {

constexpr std::uint64_t k_max_shrinking = 1032;  // of deflate: what claims more is no true size
constexpr std::uint64_t k_huge = std::uint64_t(1) << 56;

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// Bytes that are read from the front, as they are or out of base64.
class Source {
 public:
  Source(std::string_view rest, bool base64) : rest_(rest), base64_(base64) {}

  /// Nothing where the text ends before, or is no base64.
  std::optional<std::string> peek(std::uint64_t count) const {
    if (count > rest_.size()) return {};
    return base64_ ? decoded(count) : std::string(rest_.substr(0, count));
  }
  std::optional<std::string> take(std::uint64_t count) {
    std::optional<std::string> bytes = peek(count);
    if (bytes) rest_.remove_prefix(base64_ ? (count + 2) / 3 * 4 : count);
    return bytes;
  }
  std::uint64_t room() const { return rest_.size(); }

 private:
  std::optional<std::string> decoded(std::uint64_t count) const {
    if ((count + 2) / 3 * 4 > rest_.size()) return {};
    std::string bytes;
    bytes.reserve(count);
    std::uint32_t bits = 0;
    for (std::size_t i = 0; bytes.size() < count; ++i) {
      const int digit = base64_digit(rest_[i]);
      if (digit < 0) return {};
      bits = bits << 6 | std::uint32_t(digit);
      if (i % 4 != 0) bytes.push_back(char(bits >> (6 - 2 * (i % 4))));
    }
    return bytes;
  }

  std::string_view rest_;
  bool base64_;
};

/// Whole numbers of 4 or 8 bytes.
std::vector<std::uint64_t> whole_numbers(std::string_view bytes, std::size_t width) {
  std::vector<std::uint64_t> values;
  for (std::size_t i = 0; i + width <= bytes.size(); i += width) {
    values.push_back(0);
    std::memcpy(&values.back(), bytes.data() + i, width);
  }
  return values;
}

std::optional<std::string> read_plain(Source& source, std::size_t width) {
  const auto header = source.peek(width);
  if (!header) return {};
  const std::uint64_t size = whole_numbers(*header, width)[0];
  if (size > source.room()) return {};
  std::optional<std::string> bytes = source.take(width + size);
  if (bytes) bytes->erase(0, width);
  return bytes;
}

std::optional<std::string> inflated(std::string_view block, std::uint64_t size) {
  std::string bytes(size, '\0');
  uLongf got = size;
  const int state = uncompress(reinterpret_cast<Bytef*>(bytes.data()), &got,
                               reinterpret_cast<const Bytef*>(block.data()), uLong(block.size()));
  if (state != Z_OK || got != size) return {};
  return bytes;
}

/// An array as it is stored: plain bytes, or blocks that unfold to `sizes`.
struct Stored {
  std::string data;
  std::vector<std::uint64_t> packed, unfolded;  ///< of each block; none: the data are plain
  std::uint64_t size() const {
    std::uint64_t sum = packed.empty() ? data.size() : 0;
    for (const std::uint64_t block : unfolded) sum = std::min(sum + std::min(block, k_huge), k_huge);
    return sum;
  }
};

std::optional<Stored> take_blocks(Source& source, std::size_t width) {
  const auto begin = source.peek(3 * width);
  if (!begin) return {};
  const std::vector<std::uint64_t> counts = whole_numbers(*begin, width);
  if (counts[0] > source.room() / width) return {};
  const auto header = source.take((3 + counts[0]) * width);
  if (!header) return {};
  Stored stored;
  stored.packed = whole_numbers(*header, width);
  stored.packed.erase(stored.packed.begin(), stored.packed.begin() + 3);
  std::uint64_t sum = 0;
  for (const std::uint64_t size : stored.packed) {
    if (size > source.room()) return {};
    sum += size;
    const bool is_last = stored.unfolded.size() + 1 == stored.packed.size();
    stored.unfolded.push_back(is_last && counts[2] > 0 ? counts[2] : counts[1]);
    if (stored.unfolded.back() > k_max_shrinking * (size + 1)) return {};
  }
  auto data = source.take(sum);
  if (!data) return {};
  stored.data = std::move(*data);
  return stored;
}

std::optional<Stored> take(Source& source, std::size_t width, bool is_compressed) {
  if (is_compressed) return take_blocks(source, width);
  std::optional<std::string> plain = read_plain(source, width);
  return plain ? std::optional(Stored{std::move(*plain), {}, {}}) : std::nullopt;
}

std::optional<std::string> unfold(Stored stored) {
  if (stored.packed.empty()) return std::move(stored.data);
  std::string bytes;
  std::string_view rest = stored.data;
  for (std::size_t k = 0; k < stored.packed.size(); ++k) {
    const auto block = inflated(rest.substr(0, stored.packed[k]), stored.unfolded[k]);
    if (!block) return {};
    bytes += *block;
    rest.remove_prefix(stored.packed[k]);
  }
  return bytes;
}

template <class T>
void append_numbers(std::string_view bytes, std::vector<double>& values) {
  for (std::size_t i = 0; i + sizeof(T) <= bytes.size(); i += sizeof(T)) {
    T value;
    std::memcpy(&value, bytes.data() + i, sizeof(T));
    values.push_back(double(value));
  }
}

struct NumberType {
  std::string_view name;
  std::size_t size;
  void (*append)(std::string_view bytes, std::vector<double>& values);
};
template <class T>
constexpr NumberType type_of(std::string_view name) {
  return {name, sizeof(T), append_numbers<T>};
}
constexpr NumberType k_types[] = {
    type_of<float>("Float32"),        type_of<double>("Float64"),       type_of<std::int8_t>("Int8"),
    type_of<std::uint8_t>("UInt8"),   type_of<std::int16_t>("Int16"),   type_of<std::uint16_t>("UInt16"),
    type_of<std::int32_t>("Int32"),   type_of<std::uint32_t>("UInt32"), type_of<std::int64_t>("Int64"),
    type_of<std::uint64_t>("UInt64"),
};

/// Nothing, and the word, where a word is no number.
std::optional<std::vector<double>> numbers_of_text(std::string_view text, std::string_view& bad_word) {
  std::vector<double> values;
  while (!text.empty())
    for (std::string_view line = next_line(text), word = next_word(line); !word.empty(); word = next_word(line)) {
      const std::optional<double> value = to_number(word);
      bad_word = word.substr(0, 40);
      if (!value) return {};
      values.push_back(*value);
    }
  return values;
}

}  // namespace

Error VtkFile::error(const std::string& array, const std::string& problem) const {
  return bad_input(fmt::format("{}: {}: {}", where_, array, problem));
}

Result<void> VtkFile::open(std::span<const std::byte> bytes, const std::string& where) {
  where_ = where;
  std::string_view text = to_text(bytes);
  // What is appended as it is would end the XML anywhere: the elements are parsed without it.
  const std::size_t tag = std::min(text.find("<AppendedData"), text.size());
  const std::size_t end = std::min(text.find('>', tag), text.size());
  const std::size_t mark = std::min(text.find('_', end), text.size());
  std::string without;
  if (tag < text.size()) {
    appended_ = text.substr(std::min(mark + 1, text.size()));
    without.append(text.substr(0, std::min(end + 1, text.size()))).append("</AppendedData></VTKFile>");
    text = without;
  }
  const pugi::xml_parse_result read = document_.load_buffer(text.data(), text.size());
  if (!read) return bad_input(fmt::format("{}: no XML at byte {}: {}", where, read.offset, read.description()));
  const std::string_view order = root().attribute("byte_order").as_string("LittleEndian");
  if (order != "LittleEndian") return error("VTKFile", fmt::format("byte_order '{}', allowed LittleEndian", order));
  return {};
}

/// Several arrays may name the same bytes, so their sizes add up.
Result<void> VtkFile::count_memory(const std::string& array, std::uint64_t bytes, std::string_view type) const {
  std::uint64_t number = 1;
  for (const NumberType& known : k_types)
    if (known.name == type) number = known.size;
  memory_ += bytes + bytes / number * sizeof(double);
  return require_memory(fmt::format("{}: {}: what the arrays hold so far", where_, array), {memory_});
}

Result<std::string> VtkFile::bytes_of(pugi::xml_node array) const {
  const std::string name = array.attribute("Name").as_string("DataArray");
  const std::string_view format = array.attribute("format").as_string();
  std::string_view rest = array.text().get();
  bool base64 = true;
  if (format == "appended") {
    const std::uint64_t offset = array.attribute("offset").as_ullong();
    if (offset > appended_.size())
      return error(name, fmt::format("offset {}, allowed 0 .. {}", offset, appended_.size()));
    rest = appended_.substr(offset);
    base64 = std::string_view(root().child("AppendedData").attribute("encoding").as_string()) != "raw";
  } else {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t\r\n"), rest.size()));
  }
  const std::string_view compressor = root().attribute("compressor").as_string();
  if (!compressor.empty() && compressor != "vtkZLibDataCompressor") {
    Error refused = error(name, fmt::format("compressor '{}', allowed vtkZLibDataCompressor or none", compressor));
    refused.hint = "write the file with the compressor ZLib or none";
    return refused;
  }
  Source source(rest, base64);
  const std::size_t width = std::string_view(root().attribute("header_type").as_string()) == "UInt64" ? 8 : 4;
  std::optional<Stored> stored = take(source, width, !compressor.empty());
  if (stored) CUTICLE_TRY(count_memory(name, stored->size(), array.attribute("type").as_string()));
  const std::optional<std::string> bytes = stored ? unfold(std::move(*stored)) : std::nullopt;
  if (!bytes) return error(name, fmt::format("'{}' data are cut short or damaged", format));
  return *bytes;
}

Result<std::vector<double>> VtkFile::numbers(pugi::xml_node array) const {
  const std::string name = array.attribute("Name").as_string("DataArray");
  const std::string_view format = array.attribute("format").as_string("ascii");
  if (format == "ascii") {
    std::string_view bad_word;
    auto values = numbers_of_text(array.text().get(), bad_word);
    if (!values) return error(name, fmt::format("'{}' is no number", bad_word));
    return std::move(*values);
  }
  if (format != "binary" && format != "appended")
    return error(name, fmt::format("format '{}', allowed ascii, binary, appended", format));
  CUTICLE_ASSIGN(const std::string bytes, bytes_of(array));
  const std::string_view type = array.attribute("type").as_string();
  std::vector<double> values;
  for (const NumberType& known : k_types) {
    if (known.name != type) continue;
    values.reserve(bytes.size() / known.size);
    known.append(bytes, values);
    return values;
  }
  return error(name, fmt::format("type '{}' is none of numbers", type));
}

}  // namespace cuticle::strands::vtp
