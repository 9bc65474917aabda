#include <algorithm>
#include <memory>

#include <fmt/core.h>
#include <OpenImageIO/imageio.h>

#include <cuticle/core/file.h>
#include <cuticle/core/image/image.h>

namespace cuticle {
namespace {

template <class Sample>
std::vector<Sample> quantised(const std::vector<float>& pixels, float largest) {
  std::vector<Sample> samples(pixels.size());
  std::transform(pixels.begin(), pixels.end(), samples.begin(), [largest](float value) {
    const float clamped = value > 0.0f ? std::min(value, 1.0f) : 0.0f;
    return Sample(clamped * largest + 0.5f);
  });
  return samples;
}

Result<void> write_picture(const std::string& path, const OIIO::ImageSpec& spec, const void* samples) {
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(path);
  if (!output) return internal_error(fmt::format("{}: {}", path, OIIO::geterror()));
  if (!output->open(path, spec) || !output->write_image(spec.format, samples) || !output->close())
    return bad_input(fmt::format("{}: cannot write ({})", path, output->geterror()), "check the folder and the free space");
  return {};
}

}  // namespace

Result<void> write_png(const std::string& path, const Image& image, int bits) {
  if (bits != 8 && bits != 16) return usage_error(fmt::format("{}: PNG of {} bits; allowed: 8, 16", path, bits));
  if (image.width < 1 || image.height < 1 || image.channels() < 1 || image.channels() > 4)
    return bad_input(fmt::format("{}: a picture of {}x{} and {} channels cannot be written as PNG (1 .. 4 channels)", path,
                                 image.width, image.height, image.channels()));
  OIIO::ImageSpec spec(image.width, image.height, image.channels(), bits == 8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16);
  spec.attribute("oiio:UnassociatedAlpha", 1);
  return write_through_temporary(path, [&](const std::string& name) -> Result<void> {
    if (bits == 8) return write_picture(name, spec, quantised<std::uint8_t>(image.pixels, 255.0f).data());
    return write_picture(name, spec, quantised<std::uint16_t>(image.pixels, 65535.0f).data());
  });
}

Result<Image> read_image(const std::string& path) {
  OIIO::ImageSpec settings;
  settings.attribute("oiio:UnassociatedAlpha", 1);
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &settings);
  if (!input) return bad_input(fmt::format("{}: not a readable picture ({})", path, OIIO::geterror()));
  const OIIO::ImageSpec& spec = input->spec();
  Image image = make_image(spec.width, spec.height, spec.channelnames);
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

}  // namespace cuticle
