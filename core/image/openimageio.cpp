// The library of pictures: a file of its own, because OpenImageIO brings some 250 libraries with it.
#include <algorithm>
#include <memory>
#include <string_view>

#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include "core/image/detail/picture_library.h"

namespace cuticle::detail {
namespace {

Result<void> write(const std::string& path, const Samples& samples) {
  const OIIO::TypeDesc type = samples.bits == 8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16;
  OIIO::ImageSpec spec(samples.width, samples.height, samples.channels, type);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(path);
  if (!output) return internal_error(fmt::format("{}: {}", path, OIIO::geterror()));
  if (!output->open(path, spec) || !output->write_image(type, samples.data) || !output->close())
    return bad_input(fmt::format("{}: cannot write ({})", path, output->geterror()),
                     "check the folder and the free space");
  return {};
}

/// What pictures of light and texture come in. The library reads some thirty more, films and volumes among them, by
/// content and not by name: more code than a picture from elsewhere should reach.
constexpr std::string_view k_kinds[] = {"openexr", "png", "jpeg", "hdr", "tiff", "pnm", "targa", "bmp", "dds", "webp"};

Result<Image> read(const std::string& path, Result<void> (*check)(const std::string&, const PictureSize&)) {
  OIIO::ImageSpec settings;
  settings.attribute("oiio:UnassociatedAlpha", 1);
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &settings);
  if (!input) return bad_input(fmt::format("{}: not a readable picture ({})", path, OIIO::geterror()));
  if (std::ranges::find(k_kinds, input->format_name()) == std::end(k_kinds))
    return bad_input(fmt::format("{}: a picture of the kind '{}'; allowed: {}", path, input->format_name(),
                                 fmt::join(k_kinds, ", ")));
  const OIIO::ImageSpec& spec = input->spec();
  CUTICLE_TRY(check(path, {spec.width, spec.height, spec.depth, spec.nchannels}));
  Image image{spec.width, spec.height, spec.channelnames, {}};
  image.pixels.resize(std::size_t(spec.width) * std::size_t(spec.height) * std::size_t(spec.nchannels));
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, image.pixels.data()))
    return bad_input(fmt::format("{}: cannot read the pixels ({})", path, input->geterror()));
  return image;
}

Result<int> mip_levels(const std::string& path) {
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path);
  if (!input) return bad_input(fmt::format("{}: not a readable picture ({})", path, OIIO::geterror()));
  int levels = 1;
  while (input->seek_subimage(0, levels)) ++levels;
  return levels;
}

}  // namespace
}  // namespace cuticle::detail

extern "C" const cuticle::detail::PictureLibrary* cuticle_picture_library() {
  static const cuticle::detail::PictureLibrary library{cuticle::detail::write, cuticle::detail::read,
                                                       cuticle::detail::mip_levels};
  return &library;
}
