// Scenes as plans, and as pictures in arrays.
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include "plan/plan.h"
#include "python/scene_frames.h"

#include "python/arrays.h"
#include "python/groom_file.h"
#include "python/interruptible.h"
#include "python/mesh.h"
#include "python/signals.h"

namespace cuticle::python {
namespace {

std::string plan_json(const std::string& json, const std::string& folder) {
  const scene::Scene scene = value_or_raise(parse_scene(json, folder));
  return value_or_raise(interruptible([&] { return plan_of(scene); }));
}

/// Control hairs, drawn strands, the head's mesh, and where its colliders are.
nb::tuple hair_of(const std::string& json, const std::string& folder) {
  const scene::Scene scene = value_or_raise(parse_scene(json, folder));
  HairAtRest hair = value_or_raise(interruptible([&] { return hair_at_rest(scene); }));
  std::vector<double> spheres;
  for (const Sphere& sphere : hair.spheres)
    spheres.insert(spheres.end(), {sphere.center.x, sphere.center.y, sphere.center.z, sphere.radius});
  return nb::make_tuple(in_file(std::move(hair.control), std::move(hair.notes)), in_file(std::move(hair.drawn)),
                        arrays_of(hair.head), take(std::move(spheres), {hair.spheres.size(), 4}));
}

/// (height, width, channels), and the channels' names.
nb::tuple array_of(Image image) {
  const std::vector<std::size_t> shape = {std::size_t(image.height), std::size_t(image.width),
                                          std::size_t(image.channels())};
  const std::vector<std::string> names = std::move(image.channel_names);
  return nb::make_tuple(take(std::move(image.pixels), shape), names);
}

/// Pixel and strand of each share, and its depth, light and share: (n, 2) and (n, 5).
nb::tuple arrays_of(const std::vector<SeenShare>& shares) {
  std::vector<std::uint32_t> places;
  std::vector<float> values;
  for (const SeenShare& share : shares) {
    places.insert(places.end(), {share.pixel, share.object});
    values.insert(values.end(), {share.depth, share.light.x, share.light.y, share.light.z, share.light.w});
  }
  return nb::make_tuple(take(std::move(places), {shares.size(), 2}), take(std::move(values), {shares.size(), 5}));
}

nb::tuple run(Frames& frames, int frame, const nb::object& call) {
  CalledProgress progress(call);
  auto result = [&] {
    const nb::gil_scoped_release released;
    return frames.run(frame, progress);
  }();
  PaintedFrame painted = value_or_raise(std::move(result));
  return nb::make_tuple(array_of(std::move(painted.color)), array_of(std::move(painted.layers)),
                        arrays_of(painted.shares), painted.notes);
}

std::unique_ptr<Frames> open(const std::string& json, const std::string& folder, const std::string& device,
                             const nb::object& call) {
  const scene::Scene scene = value_or_raise(parse_scene(json, folder));
  CalledProgress progress(call);
  auto opened = [&] {
    const nb::gil_scoped_release released;
    return open_frames(scene, device, progress);
  }();
  return value_or_raise(std::move(opened));
}

void change(Frames& frames, const std::string& json, const std::string& folder, const std::vector<std::string>& blocks,
            const nb::object& call) {
  const scene::Scene given = value_or_raise(parse_scene(json, folder));
  CalledProgress progress(call);
  auto changed = [&] {
    const nb::gil_scoped_release released;
    return frames.change(given, blocks, progress);
  }();
  if (!changed) raise(changed.error());
}

using Pixels = nb::ndarray<const float, nb::ndim<3>, nb::c_contig, nb::device::cpu>;

nb::object tone_mapped(const Pixels& pixels, double exposure_stops) {
  const std::size_t channels = pixels.shape(2);
  if (channels != 3 && channels != 4) raise(usage_error("pixels: not an array of (height, width, 3 or 4)"));
  std::vector<std::string> names = {"R", "G", "B", "A"};
  names.resize(channels);
  Image image = make_image(int(pixels.shape(1)), int(pixels.shape(0)), names);
  image.pixels.assign(pixels.data(), pixels.data() + pixels.size());
  return array_of(tone_map(image, exposure_stops))[0];
}

}  // namespace

void add_render(nb::module_& module) {
  nb::class_<Frames>(module, "Frames")
      .def("run", &run, nb::arg(), nb::arg().none())
      .def("change", &change, nb::arg(), nb::arg(), nb::arg(), nb::arg().none())
      .def("resolution",
           [](const Frames& frames) {
             const glm::ivec2 size = frames.resolution();
             return nb::make_tuple(size.x, size.y);
           })
      .def("strands", [](Frames& frames) { return in_file(value_or_raise(frames.strands())); })
      .def("plan", &Frames::plan)
      .def("device", &Frames::device);
  module.def("open_frames", &open, nb::arg(), nb::arg(), nb::arg(), nb::arg().none());
  module.def("plan_json", &plan_json);
  module.def("changed_blocks",
             [] { return std::vector<std::string>(std::begin(k_changed_blocks), std::end(k_changed_blocks)); });
  module.def("hair_of", &hair_of);
  module.def("scene_schema", [] { return scene::scene_schema(plan::catalogue()); });
  module.def("tone_map", &tone_mapped);
}

}  // namespace cuticle::python
