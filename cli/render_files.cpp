#include "cli/render_files.h"

#ifdef CUTICLE_HAS_GPU
#include <filesystem>

#include <fmt/core.h>

#include "core/image/cryptomatte.h"

namespace cuticle::cli {

namespace {

/// The file that the hair came from, without folder and ending; else "groom".
std::string groom_name(const scene::Scene& scene) {
  const std::string name = std::filesystem::path(scene.groom.file).stem().string();
  return name.empty() ? "groom" : name;
}

/// Channels of the three mattes, and what a compositing program reads of them in the file's header.
std::map<std::string, std::string> add_mattes(Image& image, const std::vector<SeenShare>& shares,
                                              const scene::Scene& scene) {
  std::map<std::string, std::string> attributes;
  const std::string groom = groom_name(scene), material = scene.material.model.name;
  add_matte(image, attributes, "crypto_strand", shares,
            [](std::uint32_t strand) { return fmt::format("strand_{}", strand - 1); });
  add_matte(image, attributes, "crypto_groom", shares, [&](std::uint32_t) { return groom; });
  add_matte(image, attributes, "crypto_material", shares, [&](std::uint32_t) { return material; });
  return attributes;
}

}  // namespace

Result<std::vector<std::string>> write_frame(const std::string& folder, int frame, plan::FrameResult& result,
                                             const scene::Scene& scene) {
  const std::string name = fmt::format("frame_{:04d}", frame), path = fmt::format("{}/{}", folder, name);
  Image image = result.aovs.pixels.empty() ? result.color : std::move(result.aovs);
  std::map<std::string, std::string> attributes;
  if (scene.outputs.cryptomatte) attributes = add_mattes(image, result.shares, scene);
  const bool layered = image.channels() > 4;
  CUTICLE_TRY(write_exr(path + ".exr", image, layered ? ExrType::single : ExrType::half, attributes));
  CUTICLE_TRY(write_png(path + ".png", tone_map(result.color, scene.outputs.exposure_stops)));
  std::vector<std::string> names = {name + ".exr", name + ".png"};
  if (!scene.outputs.deep) return names;
  const DeepImage deep = deep_image({result.color.width, result.color.height}, std::move(result.shares));
  CUTICLE_TRY(write_deep_exr(path + ".deep.exr", deep));
  names.push_back(name + ".deep.exr");
  return names;
}

}  // namespace cuticle::cli
#endif
