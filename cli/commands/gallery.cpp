#include "cli/gallery/pictures.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>

#include <fmt/core.h>

#include "cli/command.h"
#include "cli/run_folder.h"
#include "cli/shared_files.h"
#include "core/file.h"
#include "core/image/image.h"
#include "viz/views.h"

namespace cuticle::cli {

namespace {

namespace fs = std::filesystem;

struct GalleryOptions {
  std::string out = "gallery", only;
  double scale = 1;
  bool list = false;
};

/// {440} as a length in pixels; nothing where the braces hold a word.
std::string scaled(const std::string& word, double scale) {
  if (word.size() < 3 || word.front() != '{' || !std::isdigit(static_cast<unsigned char>(word[1]))) return word;
  return std::to_string(std::max(64, int(std::atoi(word.c_str() + 1) * scale)));
}

std::string replaced(std::string text, const std::string& mark, const std::string& value) {
  for (std::size_t at = text.find(mark); at != text.npos; at = text.find(mark, at + value.size()))
    text.replace(at, mark.size(), value);
  return text;
}

std::vector<std::string> arguments_of(std::string_view command, const std::string& work, double scale) {
  const std::string scenes = share_file("scenes");
  std::vector<std::string> arguments;
  std::string word;
  for (const char c : std::string(command) + " ") {
    if (c != ' ') {
      word += c;
      continue;
    }
    arguments.push_back(scaled(replaced(replaced(word, "{work}", work), "{scenes}", scenes), scale));
    word.clear();
  }
  return arguments;
}

/// Why a picture cannot be made here; empty: it can.
std::string missing_for(const GalleryPicture& picture) {
  if (picture.needs_data && !std::getenv("CUTICLE_TEST_DATA")) return "CUTICLE_TEST_DATA is not set";
#ifndef CUTICLE_HAS_GPU
  for (const std::string_view command : picture.commands)
    if (command.starts_with("render") || command.starts_with("simulate"))
      return "this program was built without Vulkan";
#endif
  if (picture.needs_display)
    if (const auto views = viz::load_views(); !views) return views.error().message;
  return {};
}

Result<void> run_commands(const GalleryPicture& picture, const std::string& work, const GalleryOptions& options,
                          const Context& context) {
  for (const std::string_view command : picture.commands) {
    std::vector<std::string> arguments = arguments_of(command, work, options.scale);
    if (!context.device.empty()) arguments.insert(arguments.end(), {"--device", context.device});
    const int code = run_self(arguments, picture.needs_display);
    if (code != 0)
      return Error{ErrorKind::internal, fmt::format("{}: `cuticle {}` ended with {}", picture.name, command, code),
                   picture.needs_display ? "a window needs a display, or xvfb-run on the PATH" : ""};
  }
  return {};
}

/// Each pixel the mean of `side` x `side` of a picture's.
Image averaged(const Image& image, int side) {
  if (side == 1) return image;
  Image small = make_image(image.width / side, image.height / side, image.channel_names);
  for (int y = 0; y < small.height * side; ++y)
    for (int x = 0; x < small.width * side; ++x)
      for (int c = 0; c < image.channels(); ++c)
        small.at(x / side, y / side, c) += image.at(x, y, c) / float(side * side);
  return small;
}

Result<void> compose(const GalleryPicture& picture, const std::string& work, const std::string& file) {
  std::vector<Image> parts;
  for (const std::string_view part : picture.parts) {
    CUTICLE_ASSIGN(const Image large, read_image(fmt::format("{}/{}", work, part)));
    parts.push_back(averaged(large, picture.samples));
  }
  return write_png(file, contact_sheet(parts, picture.columns));
}

Result<void> make(const GalleryPicture& picture, const GalleryOptions& options, const Context& context) {
  const std::string folder = fs::absolute(options.out).string(), work = fmt::format("{}/.{}", folder, picture.name);
  CUTICLE_TRY(make_folder(work));
  Result<void> done = run_commands(picture, work, options, context);
  if (done) done = compose(picture, work, fmt::format("{}/{}.png", folder, picture.name));
  std::error_code failed;
  fs::remove_all(work, failed);
  return done;
}

Result<std::vector<GalleryPicture>> chosen(const std::string& only) {
  std::vector<GalleryPicture> pictures;
  for (const std::string& name : only.empty() ? std::vector<std::string>{} : split_list(only)) {
    const auto found = std::ranges::find(gallery_pictures(), name, &GalleryPicture::name);
    if (found == gallery_pictures().end())
      return usage_error(fmt::format("--only: there is no picture '{}'", name), "cuticle gallery --list");
    pictures.push_back(*found);
  }
  if (only.empty()) pictures.assign(gallery_pictures().begin(), gallery_pictures().end());
  return pictures;
}

int list(const std::vector<GalleryPicture>& pictures) {
  for (const GalleryPicture& picture : pictures) {
    fmt::print("{}: {}\n", picture.name, picture.title);
    for (const std::string_view command : picture.commands) fmt::print("  cuticle {}\n", command);
  }
  return Exit::ok;
}

int run(const GalleryOptions& options, Context& context) {
  const auto pictures = chosen(options.only);
  if (!pictures) return report(pictures.error());
  if (options.list) return list(*pictures);
  return in_folder(options.out, [&]() -> int {
    for (std::size_t k = 0; k < pictures->size(); ++k) {
      const GalleryPicture& picture = (*pictures)[k];
      context.progress->update("pictures", k, pictures->size());
      if (const std::string missing = missing_for(picture); !missing.empty())
        context.progress->message(fmt::format("{} is left out: {}", picture.name, missing));
      else if (const auto done = make(picture, options, context); !done)
        return report(done.error());
    }
    context.progress->update("pictures", pictures->size(), pictures->size());
    return Exit::ok;
  });
}

}  // namespace

void add_gallery(CLI::App& app, Context& context) {
  auto* command = app.add_subcommand("gallery", "make the twelve pictures of docs/gallery.md");
  auto options = std::make_shared<GalleryOptions>();
  command->add_option("--out", options->out, "folder to write (default: gallery)");
  command->add_option("--only", options->only, "pictures by name, a,b,c");
  command->add_option("--scale", options->scale, "of the pictures' width and height")->check(CLI::Range(0.1, 4.0));
  command->add_flag("--list", options->list, "print the pictures and the commands that make each");
  command->callback([&context, options] { context.action = [&context, options] { return run(*options, context); }; });
}

}  // namespace cuticle::cli
