#include "cli/gallery/pictures.h"

namespace cuticle::cli {

namespace {

/// Hair as it is rendered.
std::vector<GalleryPicture> hair() {
  return {
      {.name = "straight_blond",
       .title = "Straight blond hair by the window light",
       .commands = {"render {scenes}/straight.json --size {1040} {1144} --out {work}"},
       .parts = {"frame_0000.png"},
       .samples = 2},
      {.name = "black_curls",
       .title = "Black curls",
       .commands = {"render {scenes}/curls.json --hair black --size {1040} {1144} --out {work}"},
       .parts = {"frame_0000.png"},
       .samples = 2},
      {.name = "colours",
       .title = "Blond, brown, black and red hair",
       .commands =
           {"render {scenes}/straight.json --set sigma_a=0.02/0.062/0.17,beta=0.15 --size {440} {484} --out "
            "{work}/blond",
            "render {scenes}/straight.json --set sigma_a=0.4/0.68/1.35,beta=0.15 --size {440} {484} --out {work}/brown",
            "render {scenes}/straight.json --set sigma_a=1.6/2.5/4.6,beta=0.15 --size {440} {484} --out {work}/black",
            "render {scenes}/straight.json --set sigma_a=0.07/0.3/1.2,beta=0.15 --size {440} {484} --out {work}/red"},
       .parts = {"blond/frame_0000.png", "brown/frame_0000.png", "black/frame_0000.png", "red/frame_0000.png"},
       .columns = 4,
       .samples = 2},
      {.name = "fox_fur",
       .title = "Fur on a running fox",
       .commands = {"render {scenes}/fox_running.json --frames 0 --size {680} {480} --out {work}",
                    "render {scenes}/fox_running.json --frames 12 --size {680} {480} --out {work}",
                    "render {scenes}/fox_running.json --frames 24 --size {680} {480} --out {work}"},
       .parts = {"frame_0000.png", "frame_0012.png", "frame_0024.png"},
       .columns = 3,
       .samples = 2,
       .needs_data = true},
      {.name = "mermaid",
       .title = "Hair and fins under water, moved by a current",
       .commands = {"render {scenes}/mermaid.json --frames 40 --size {960} {960} --out {work}"},
       .parts = {"frame_0040.png"},
       .samples = 2},
      {.name = "cards_beside_strands",
       .title = "Hair cards beside the strands that they are made of",
       .commands = {"render {scenes}/waves.json --method cards --size {760} {836} --out {work}/cards",
                    "render {scenes}/waves.json --size {760} {836} --out {work}/strands"},
       .parts = {"cards/frame_0000.png", "strands/frame_0000.png"},
       .columns = 2,
       .samples = 2}};
}

/// What the functions, tables and shadows look like.
std::vector<GalleryPicture> diagrams() {
  return {
      {.name = "hard_case",
       .title = "The caustic of TRT: infinite, and smoothed",
       .commands = {"view lobes --preset blond --set caustic=exact --lobe TRT --theta-i 20 --radius linear "
                    "--size {1200} {780} --screenshot {work}/before.png",
                    "view lobes --preset blond --set caustic=smoothed --lobe TRT --theta-i 20 --radius linear "
                    "--size {1200} {780} --screenshot {work}/after.png"},
       .parts = {"before.png", "after.png"},

       .needs_display = true},
      {.name = "lobes",
       .title = "The lobes R, TT and TRT of blond hair, light from 30 degrees",
       .commands = {"view lobes --preset blond --theta-i 30 --size {1200} {800} --screenshot {work}/lobes.png"},
       .parts = {"lobes.png"},
       .needs_display = true},
      {.name = "tables",
       .title = "The lookup textures of M and N for blond hair",
       .commands = {"bake --preset blond --size 128 --out {work}"},
       .parts = {"preview.png"}},
      {.name = "shadow_slices",
       .title = "Light in a cut through the hair: truth, 16 slices of an opacity map, 16 layers of a deep opacity map",
       .commands =
           {"grow {scenes}/presets/wavy.json --share 0.6 --out {work}/hair.hair",
            "shadows {work}/hair.hair --methods truth,opacity_map,deep_opacity --layers 16 --resolution 256 --alpha 1 "
            "--rays 64 --cut {work}/cut.png --cut-size {260}"},
       .parts = {"cut.png"}},
      {.name = "error_against_time",
       .title = "Error against time of every model",
       .commands = {"study lobes --quick --out {work}"},
       .parts = {"lobes-all-models.png"}},
      {.name = "tension",
       .title = "Stretch along simulated strands",
       .commands = {"simulate {scenes}/hairworks.json --frames 0:12 --out {work}",
                    "view strands {work}/state_0012.vtp --size {1200} {800} --screenshot {work}/tension.png"},
       .parts = {"tension.png"},
       .needs_display = true}};
}

}  // namespace

std::span<const GalleryPicture> gallery_pictures() {
  static const std::vector<GalleryPicture> all = [] {
    std::vector<GalleryPicture> pictures = hair(), more = diagrams();
    pictures.insert(pictures.end(), more.begin(), more.end());
    return pictures;
  }();
  return all;
}

}  // namespace cuticle::cli
