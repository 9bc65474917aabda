// The library of pictures: a file of its own, because OpenImageIO brings some 250 libraries with it.
#include <memory>

#include <OpenImageIO/imageio.h>
#include <fmt/core.h>

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

Result<Image> read(const std::string& path) {
  OIIO::ImageSpec settings;
  settings.attribute("oiio:UnassociatedAlpha", 1);
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &settings);
  if (!input) return bad_input(fmt::format("{}: not a readable picture ({})", path, OIIO::geterror()));
  const OIIO::ImageSpec& spec = input->spec();
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
