#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "core/file.h"
#include "core/image/text.h"
#include "core/json/json.h"
#include "lut/format.h"
#include "lut/probes.h"
#include "lut/snippets/snippet.h"
#include "lut/table_set.h"
#include "lut/target.h"

namespace cuticle::lut {
namespace {

namespace fs = std::filesystem;

/// A folder beside the final files that vanishes unless its files were moved out.
class Staging {
 public:
  explicit Staging(std::string target) : target_(std::move(target)) {
    std::error_code code;
    existed_ = fs::exists(target_, code);
  }
  ~Staging() {
    folder_.reset();
    std::error_code code;
    if (!existed_ && !moved_) fs::remove(target_, code);  // only if empty
  }
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;
  Result<void> make() {
    CUTICLE_TRY(make_folder(target_));
    CUTICLE_ASSIGN(Temporary folder, Temporary::folder(target_));
    folder_.emplace(std::move(folder));
    return {};
  }
  const std::string& folder() const { return folder_->path(); }
  std::string file(std::string_view name) const { return (fs::path(folder()) / name).string(); }
  /// Moves every file to its place; takes back what was moved when one cannot be.
  Result<void> move_out() {
    std::vector<fs::path> done;
    for (const fs::path& name : names()) {
      std::error_code code;
      fs::create_directories((target_ / name).parent_path(), code);
      if (const Result<void> moved = move_into_place(file(name.string()), (target_ / name).string()); !moved) {
        for (const fs::path& each : done) fs::remove(target_ / each);
        return bad_input(moved.error().message, "choose another folder by --out");
      }
      done.push_back(name);
    }
    moved_ = true;
    return {};
  }

 private:
  /// The manifest last: it holds the digests of the others, so that a set whose writing was killed does not pass for
  /// one.
  std::vector<fs::path> names() const {
    std::vector<fs::path> result;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder()))
      if (entry.is_regular_file()) result.push_back(fs::relative(entry.path(), folder()));
    std::ranges::sort(result, {}, [](const fs::path& name) { return std::pair(name == "manifest.json", name); });
    return result;
  }
  fs::path target_;
  std::optional<Temporary> folder_;
  bool existed_ = false, moved_ = false;
};

/// One channel group of a table as a grey or rgb picture, its 99th percentile at 0.8 of white.
Image preview_of(const Table& table, int first, int count) {
  Image picture = make_image(table.image.width, table.image.height, {"R", "G", "B"});
  std::vector<double> values;
  const auto value = [&](int x, int y, int c) { return double(table.image.at(x, y, c)) * table.scale[c]; };
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < count; ++c) values.push_back(value(x, y, first + c));
  const auto rank = values.begin() + std::ptrdiff_t(0.99 * double(values.size() - 1));
  std::nth_element(values.begin(), rank, values.end());
  const double white = *rank > 0 ? 0.8 / *rank : 1;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      for (int c = 0; c < 3; ++c) picture.at(x, y, c) = float(value(x, y, first + std::min(c, count - 1)) * white);
  return picture;
}

/// The picture enlarged to at least 256 pixels each way, under lines that say what it shows.
Image labelled(const Image& picture, const std::vector<std::string>& lines) {
  constexpr int least = 256, margin = 4;
  const int x_scale = std::max(1, least / picture.width), y_scale = std::max(1, least / picture.height);
  const int top = int(lines.size()) * k_text_height + 2 * margin;
  Image sheet = make_image(picture.width * x_scale + 2 * margin, picture.height * y_scale + top + margin, {"R", "G", "B"});
  for (std::size_t i = 0; i < lines.size(); ++i)
    draw_text(sheet, margin, margin + int(i) * k_text_height, lines[i], 0.9F);
  for (int y = 0; y < picture.height * y_scale; ++y)
    for (int x = 0; x < picture.width * x_scale; ++x)
      for (int c = 0; c < 3; ++c) sheet.at(x + margin, y + top, c) = picture.at(x / x_scale, y / y_scale, c);
  return sheet;
}

/// Three channels of a colour by its name; others by all of theirs.
std::string names_of(const TableLayout& table, int first, int count) {
  const std::string_view begins = table.channels[std::size_t(first)].name;
  if (count == 3 && begins.ends_with(".r")) return fmt::format("{} in colour", begins.substr(0, begins.size() - 2));
  std::string names;
  for (int c = first; c < first + count; ++c)
    names += fmt::format("{}{}", names.empty() ? "" : " ", table.channels[std::size_t(c)].name);
  return names + (count > 1 ? " as r, g, b" : "");
}

Image labelled_preview(const Table& table, int first, int count) {
  const TableLayout& layout = *table.layout;
  const std::vector<std::string> lines = {
      fmt::format("{}: {}", layout.name, names_of(layout, first, count)),
      fmt::format("right {} {:.3g} .. {:.3g}", axis_info(layout.u.quantity).name, layout.u.lower, layout.u.upper),
      fmt::format("down {} {:.3g} .. {:.3g}", axis_info(layout.v.quantity).name, layout.v.lower, layout.v.upper)};
  return labelled(tone_map(preview_of(table, first, count)), lines);
}

/// Each table's first three channels in colour and its fourth in grey, each with its name and axes.
Image preview(const TableSet& set) {
  std::vector<Image> pictures;
  for (const Table& table : set.tables) {
    pictures.push_back(labelled_preview(table, 0, std::min(3, table.image.channels())));
    if (table.image.channels() > 3) pictures.push_back(labelled_preview(table, 3, 1));
  }
  return contact_sheet(pictures, int(pictures.size()));
}

/// A copy whose channels are named R, G, B, A, which is what engines look for.
Image engine_image(const Table& table) {
  static const std::vector<std::string> names = {"R", "G", "B", "A"};
  Image image = table.image;
  image.channel_names.assign(names.begin(), names.begin() + image.channels());
  return image;
}

/// An engine's folder: a copy of the tables and the manifest, and what the engine needs beside them.
Result<void> write_folder(const Target& target, const Manifest& manifest, const Staging& staging) {
  CUTICLE_ASSIGN(const std::vector<TextFile> files, target.files(manifest));
  CUTICLE_TRY(make_folder(staging.file(target.name)));
  const auto file = [&](const std::string& name) { return staging.file(fmt::format("{}/{}", target.name, name)); };
  for (const TextFile& text : files) CUTICLE_TRY(write_text_file(file(text.name), text.text));
  std::vector<std::string> copied = {"manifest.json"};
  for (const ManifestTable& table : manifest.tables) copied.push_back(table.file);
  for (const std::string& name : copied) {
    std::error_code code;
    fs::copy_file(staging.file(name), file(name), code);
    if (code) return bad_input(fmt::format("{}: {}", file(name), code.message()), "choose another folder by --out");
  }
  return {};
}

/// The shader functions, and a folder for each engine.
Result<void> write_for_engines(const Manifest& manifest, std::span<const Target* const> targets,
                               const Staging& staging) {
  for (const snippets::Dialect& dialect : snippets::dialects()) {
    CUTICLE_ASSIGN(const std::string text, snippets::snippet(manifest, dialect));
    CUTICLE_TRY(write_text_file(staging.file(fmt::format("cuticle_hair.{}", dialect.extension)), text));
  }
  for (const Target* target : targets) CUTICLE_TRY(write_folder(*target, manifest, staging));
  return {};
}

Result<void> write_all(const TableSet& set, const Format& format, std::span<const Target* const> targets,
                       const Staging& staging) {
  const std::string manifest = manifest_json(set, format);
  for (const Table& table : set.tables)
    CUTICLE_TRY(format.write(staging.file(file_name(table, format)), engine_image(table), manifest));
  CUTICLE_ASSIGN(const std::string complete, with_digests(manifest, staging.folder()));
  CUTICLE_TRY(write_text_file(staging.file("manifest.json"), complete));
  // Apart from all else, which is the same whenever the same tables are baked.
  const Json timings = {{"bake_ms", set.bake_ms}};
  CUTICLE_TRY(write_text_file(staging.file("timings.json"), timings.dump(2) + "\n"));
  CUTICLE_ASSIGN(const Manifest parsed, parse_manifest(complete, "manifest.json"));
  CUTICLE_TRY(write_for_engines(parsed, targets, staging));
  return write_png(staging.file("preview.png"), preview(set));
}

}  // namespace

Result<void> write(const TableSet& set, const Format& format, const std::string& folder,
                   std::span<const Target* const> targets) {
  Staging staging(folder);
  CUTICLE_TRY(staging.make());
  CUTICLE_TRY(write_all(set, format, targets, staging));
  return staging.move_out();
}

}  // namespace cuticle::lut
