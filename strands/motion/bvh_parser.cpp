#include "strands/motion/bvh.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include <fmt/core.h>

#include "core/file.h"
#include "core/text.h"
#include "strands/motion/names.h"

namespace cuticle::strands {

namespace {

constexpr std::array<std::string_view, 6> k_channels = {"Xposition", "Yposition", "Zposition",
                                                        "Xrotation", "Yrotation", "Zrotation"};

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

class BvhParser {
 public:
  BvhParser(std::string_view text, const std::string& where) : text_(text), where_(where) {}

  Result<Motion> parse() {
    CUTICLE_TRY(expect("HIERARCHY"));
    CUTICLE_TRY(expect("ROOT"));
    CUTICLE_TRY(read_hierarchy());
    CUTICLE_TRY(expect("MOTION"));
    CUTICLE_TRY(read_frame_header());
    CUTICLE_TRY(read_frames());
    return std::move(motion_);
  }

 private:
  Error error(const std::string& problem) const {
    return bad_input(fmt::format("{}: line {}: {}", where_, line_, problem));
  }

  /// The next word, or empty at the end of the file.
  std::string_view next_word() {
    while (at_ < text_.size() && is_space(text_[at_])) line_ += text_[at_++] == '\n';
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  /// The rest of the line, without the spaces around it: names may hold spaces.
  std::string rest_of_line() {
    while (at_ < text_.size() && is_space(text_[at_]) && text_[at_] != '\n') ++at_;
    std::size_t end = std::min(text_.find('\n', at_), text_.size());
    const std::size_t begin = at_;
    at_ = end;
    while (end > begin && is_space(text_[end - 1])) --end;
    return std::string(text_.substr(begin, end - begin));
  }

  Result<void> expect(std::string_view word) {
    const std::string_view found = next_word();
    if (equal_ignoring_case(found, word)) return {};
    return error(fmt::format("expected {}, found '{}'", word, found.substr(0, 40)));
  }

  template <class T>
  Result<T> read_number(const char* field, T minimum, T maximum) {
    const std::string_view word = next_word();
    T value{};
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (code != std::errc() || end != word.data() + word.size() || !(value >= minimum && value <= maximum))
      return error(fmt::format("{}: '{}', expected a number {} .. {}", field, word.substr(0, 40), minimum, maximum));
    return value;
  }

  Result<void> read_hierarchy() {
    CUTICLE_TRY(open_joint(-1));
    std::vector<int> stack{0};
    while (!stack.empty()) {
      const std::string_view word = next_word();
      if (word == "}") {
        stack.pop_back();
      } else if (equal_ignoring_case(word, "JOINT")) {
        CUTICLE_TRY(open_joint(stack.back()));
        stack.push_back(int(motion_.joints.size()) - 1);
      } else if (equal_ignoring_case(word, "End")) {
        CUTICLE_TRY(skip_end_site());
      } else {
        return error(fmt::format("expected JOINT, End Site or }}, found '{}'", word.substr(0, 40)));
      }
    }
    return {};
  }

  Result<void> open_joint(int parent) {
    Joint joint;
    joint.name = rest_of_line();
    joint.parent = parent;
    if (joint.name.empty()) return error("expected a joint's name");
    CUTICLE_TRY(expect("{"));
    CUTICLE_ASSIGN(joint.offset, read_offset());
    CUTICLE_TRY(read_channels(joint));
    motion_.joints.push_back(std::move(joint));
    return {};
  }

  Result<glm::dvec3> read_offset() {
    CUTICLE_TRY(expect("OFFSET"));
    glm::dvec3 offset(0);
    for (int i = 0; i < 3; ++i) {
      CUTICLE_ASSIGN(offset[i], read_number("OFFSET", -1e6, 1e6));
    }
    return offset;
  }

  Result<void> read_channels(Joint& joint) {
    CUTICLE_TRY(expect("CHANNELS"));
    CUTICLE_ASSIGN(const int count, read_number("CHANNELS", 0, 6));
    joint.first_channel = int(motion_.channel_count);
    for (int i = 0; i < count; ++i) {
      CUTICLE_ASSIGN(const int channel, read_channel());
      if (std::ranges::find(joint.channels, channel) != joint.channels.end())
        return error(
            fmt::format("channel {} of joint {} is given twice", k_channels[std::size_t(channel)], in_quotes(joint.name)));
      joint.channels.push_back(channel);
    }
    motion_.channel_count += std::size_t(count);
    return {};
  }

  Result<int> read_channel() {
    const std::string_view word = next_word();
    for (std::size_t i = 0; i < k_channels.size(); ++i)
      if (equal_ignoring_case(word, k_channels[i])) return int(i);
    return error(fmt::format("channel '{}', expected one of Xposition .. Zposition, Xrotation .. Zrotation",
                             word.substr(0, 40)));
  }

  Result<void> skip_end_site() {
    CUTICLE_TRY(expect("Site"));
    CUTICLE_TRY(expect("{"));
    CUTICLE_ASSIGN([[maybe_unused]] const glm::dvec3 offset, read_offset());
    return expect("}");
  }

  Result<void> read_frame_header() {
    CUTICLE_TRY(expect("Frames:"));
    CUTICLE_ASSIGN(motion_.frame_count, read_number<std::size_t>("Frames", 1, 100000000));
    CUTICLE_TRY(expect("Frame"));
    CUTICLE_TRY(expect("Time:"));
    CUTICLE_ASSIGN(motion_.frame_time, read_number("Frame Time", 1e-6, 1e3));
    return {};
  }

  Result<void> read_frames() {
    // A number takes two bytes at least, so a lying frame count is refused before anything is allocated for it.
    const std::size_t room = (text_.size() - at_) / 2 + 1;
    if (motion_.channel_count == 0) return error("no joint has a channel");
    if (motion_.frame_count > room / motion_.channel_count)
      return error(fmt::format("Frames: {} of {} channels, allowed 1 .. {} in a file of {} bytes", motion_.frame_count,
                               motion_.channel_count, room / motion_.channel_count, text_.size()));
    motion_.values.reserve(motion_.frame_count * motion_.channel_count);
    for (std::size_t i = 0; i < motion_.frame_count * motion_.channel_count; ++i) {
      CUTICLE_ASSIGN(const float value, read_number("frame value", -1e7f, 1e7f));
      motion_.values.push_back(value);
    }
    return {};
  }

  std::string_view text_;
  std::string where_;
  std::size_t at_ = 0, line_ = 1;
  Motion motion_;
};

bool ends_with_ignoring_case(std::string_view text, std::string_view ending) {
  return text.size() >= ending.size() && equal_ignoring_case(text.substr(text.size() - ending.size()), ending);
}

}  // namespace

Result<Motion> parse_bvh(std::string_view text, const std::string& where) { return BvhParser(text, where).parse(); }

Result<Motion> read_bvh(const std::string& path) {
  CUTICLE_ASSIGN(const std::string text, read_text_file(path));
  return parse_bvh(text, path);
}

Result<int> find_joint(const Motion& motion, std::string_view name) {
  for (std::size_t i = 0; i < motion.joints.size(); ++i)
    if (equal_ignoring_case(motion.joints[i].name, name)) return int(i);
  for (std::size_t i = 0; i < motion.joints.size(); ++i)
    if (ends_with_ignoring_case(motion.joints[i].name, name)) return int(i);
  constexpr std::size_t most_named = 40;
  std::string known;
  for (std::size_t i = 0; i < std::min(most_named, motion.joints.size()); ++i)
    known += (i == 0 ? "" : ", ") + printable(motion.joints[i].name, 60);
  if (motion.joints.size() > most_named) known += fmt::format(" and {} more", motion.joints.size() - most_named);
  return bad_input(fmt::format("joint {} is not in the skeleton; it has: {}", in_quotes(name), known),
                   "name one of these joints");
}

}  // namespace cuticle::strands
