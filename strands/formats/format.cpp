#include "strands/formats/format.h"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include "strands/formats/words.h"

namespace cuticle::strands {

namespace {

std::string extension_of(const std::string& path) {
  const std::size_t dot = path.find_last_of("./");
  std::string extension = dot == std::string::npos || path[dot] != '.' ? "" : path.substr(dot + 1);
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return extension;
}

bool has(std::span<const std::string_view> extensions, std::string_view extension) {
  return std::find(extensions.begin(), extensions.end(), extension) != extensions.end();
}

void add_to_list(std::string& list, std::span<const std::string_view> extensions) {
  for (std::string_view extension : extensions) list += fmt::format("{}.{}", list.empty() ? "" : ", ", extension);
}

bool is_held(const Holds& holds, const std::string& name, const Attribute& attribute) {
  if (holds.attributes) return is_plain_word(name);
  return std::any_of(holds.named.begin(), holds.named.end(), [&](const NamedAttribute& named) {
    return named.name == name && named.components == attribute.components;
  });
}

/// Whether the radii of a strand run evenly from one end to the other, to a millionth.
bool run_evenly(std::span<const float> radii) {
  const float root = radii.front(), tip = radii.back();
  for (std::size_t i = 0; i < radii.size(); ++i) {
    const float even = root + (tip - root) * float(i) / float(radii.size() - 1);
    if (std::abs(radii[i] - even) > 1e-6f * std::max(root, tip)) return false;
  }
  return true;
}

bool has_even_radii(const Groom& groom) {
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    if (!run_evenly({groom.radii.data() + groom.offsets[s], groom.strand_size(s)})) return false;
  return true;
}

}  // namespace

std::string list_of_extensions(bool to_write) {
  std::string list;
  for (const Format* format : formats()) {
    if (!to_write || format->format) add_to_list(list, format->extensions);
    if (!to_write) add_to_list(list, format->read_only);
  }
  return list;
}

namespace {

/// Which grooms a folder holds that was given in place of one.
Error refusal_of_folder(const std::string& path) {
  std::vector<std::string> grooms;
  std::error_code failed;
  for (const auto& entry : std::filesystem::directory_iterator(path, failed))
    if (entry.is_regular_file(failed) && format_of(entry.path().string())) grooms.push_back(entry.path().filename());
  std::ranges::sort(grooms);
  if (grooms.empty())
    return bad_input(fmt::format("{}: is a folder without a groom in it", path),
                     "give a groom file: " + list_of_extensions(false));
  return bad_input(fmt::format("{}: is a folder, not a groom; it holds {}", path, fmt::join(grooms, ", ")),
                   (std::filesystem::path(path) / grooms.front()).string());
}

}  // namespace

Result<const Format*> format_of(const std::string& path, bool to_write) {
  std::error_code failed;
  if (!to_write && std::filesystem::is_directory(path, failed)) return refusal_of_folder(path);
  const std::string extension = extension_of(path);
  for (const Format* format : formats()) {
    if (has(format->extensions, extension) && (!to_write || format->format)) return format;
    if (has(format->read_only, extension) && !to_write) return format;
  }
  return bad_input(fmt::format("{}: extension '{}', allowed {}", path, extension, list_of_extensions(to_write)),
                   "give the file the ending of its format");
}

std::vector<std::string> drop_what_it_cannot_hold(Groom& groom, const Format& format) {
  const Holds& holds = format.holds;
  std::vector<std::string> lost;
  const auto say = [&](const std::string& what) {
    lost.push_back(fmt::format(".{} cannot hold {}: dropped", format.extensions.front(), what));
  };
  std::erase_if(groom.attributes, [&](const auto& entry) {
    if (is_held(holds, entry.first, entry.second)) return false;
    say(fmt::format("the attribute '{}'", entry.first));
    return true;
  });
  if (!holds.root_uv && !groom.root_uv.empty()) {
    say("root texture coordinates");
    groom.root_uv.clear();
  }
  if (!holds.roots && !groom.root_triangle.empty()) {
    say("the triangles that the roots lie in");
    groom.root_triangle.clear();
    groom.root_barycentrics.clear();
  }
  if (holds.widths == Widths::none) say("radii");
  if (holds.widths == Widths::ends && !has_even_radii(groom)) say("the radii between the ends of a strand");
  return lost;
}

Result<void> check_sizes(const Groom& groom, const Format& format) {
  const std::string_view name = format.extensions.front();
  if (groom.strand_count() == 0)
    return bad_input(fmt::format(".{}: the groom has 0 strands, at least 1 is needed", name));
  for (std::size_t s = 0; s < groom.strand_count(); ++s)
    if (groom.strand_size(s) < 2 || groom.strand_size(s) > format.holds.most_points)
      return bad_input(fmt::format(".{}: strand {} has {} points, allowed 2 .. {}", name, s, groom.strand_size(s),
                                   format.holds.most_points),
                       "cuticle convert --repair takes strands of one point out");
  return {};
}

}  // namespace cuticle::strands
