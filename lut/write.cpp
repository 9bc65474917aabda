#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <system_error>

#include <fmt/format.h>

#include "core/file.h"
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
  /// The manifest last: it holds the digests of the others, so that a set whose writing was killed does not pass for one.
  std::vector<fs::path> names() const {
    std::vector<fs::path> result;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder())) result.push_back(entry.path().filename());
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

/// Each table's first three channels in colour and its fourth in grey.
Image preview(const TableSet& set) {
  std::vector<Image> pictures;
  for (const Table& table : set.tables) {
    pictures.push_back(tone_map(preview_of(table, 0, std::min(3, table.image.channels()))));
    if (table.image.channels() > 3) pictures.push_back(tone_map(preview_of(table, 3, 1)));
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

Result<void> write_texts(const std::vector<TextFile>& files, const Staging& staging) {
  for (const TextFile& file : files) CUTICLE_TRY(write_text_file(staging.file(file.name), file.text));
  return {};
}

/// The shader functions, and what each engine needs beside the tables.
Result<void> write_for_engines(const Manifest& manifest, std::span<const Target* const> targets,
                               const Staging& staging) {
  for (const snippets::Dialect& dialect : snippets::dialects()) {
    CUTICLE_ASSIGN(const std::string text, snippets::snippet(manifest, dialect));
    CUTICLE_TRY(write_text_file(staging.file(fmt::format("cuticle_hair.{}", dialect.extension)), text));
  }
  for (const Target* target : targets) {
    CUTICLE_ASSIGN(const std::vector<TextFile> files, target->files(manifest));
    CUTICLE_TRY(write_texts(files, staging));
  }
  return {};
}

Result<void> write_all(const TableSet& set, const Format& format, std::span<const Target* const> targets,
                       const Staging& staging) {
  const std::string manifest = manifest_json(set, format);
  for (const Table& table : set.tables)
    CUTICLE_TRY(format.write(staging.file(file_name(table, format)), engine_image(table), manifest));
  CUTICLE_ASSIGN(const std::string complete, with_digests(manifest, staging.folder()));
  CUTICLE_TRY(write_text_file(staging.file("manifest.json"), complete));
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
