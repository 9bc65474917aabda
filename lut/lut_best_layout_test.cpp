// What `auto` chooses, against every layout of no more bytes.
#include <gtest/gtest.h>

#include "lut/comparison.h"
#include "lut/format.h"
#include "lut/max_error.h"
#include "lut/table_set.h"

namespace cuticle::lut::lut_best_layout_test {
namespace {

constexpr int k_size = 128;

struct Fibre {
  const char *model, *settings;
};

const bsdf::Model& model_of(const Fibre& fibre) { return **bsdf::find_model(fibre.model); }
registry::ParameterValues values_of(const Fibre& fibre) {
  return *registry::parse_assignments(model_of(fibre).entry.parameters, fibre.settings);
}

Result<double> error_of_s(const Fibre& fibre, const Layout& layout) {
  CUTICLE_ASSIGN(TableSet set, bake(model_of(fibre), values_of(fibre), layout, k_size, silent_progress()));
  CUTICLE_TRY(store_as(set, half_exr()));
  CUTICLE_TRY(certify_scattering(cpu_source(model_of(fibre), set.values), set));
  double worst = 0;
  for (const ChannelError& error : set.scattering)
    worst = std::max(worst, relative_error(error.rms, error.signal_rms));
  return worst;
}

TEST(Layout, Best_HasTheLeastErrorOfItsBytes) {
  for (const Fibre& fibre : {Fibre{"marschner", ""}, Fibre{"marschner", "caustic=smoothed"}}) {
    const Layout& best = **find_layout(k_best_layout, model_of(fibre), values_of(fibre));
    const double error = *error_of_s(fibre, best);
    const std::size_t bytes = texture_bytes(best, k_size, half_exr());
    for (const Layout* layout : layouts()) {
      if (layout->terms.empty() || layout->solve || texture_bytes(*layout, k_size, half_exr()) > bytes) continue;
      const Result<double> other = error_of_s(fibre, *layout);
      if (!other.ok()) continue;
      EXPECT_LE(error, *other * (1 + 1e-9)) << fibre.settings << " " << layout->entry.name;
    }
  }
}

TEST(Layout, Best_IsNamedByWhatTheModelHas) {
  const auto name = [](const Fibre& fibre) {
    return (*find_layout(k_best_layout, model_of(fibre), values_of(fibre)))->entry.name;
  };
  EXPECT_EQ(name({"marschner", ""}), "nalu_caustic");
  EXPECT_EQ(name({"marschner", "caustic=smoothed"}), "nalu_theta");
  EXPECT_EQ(name({"deon", "attenuation_angle=theta_d"}), "deon");
  EXPECT_EQ(name({"deon", "attenuation_angle=theta_o"}), "chiang");
  EXPECT_EQ(name({"chiang", "field=far"}), "chiang");
  EXPECT_EQ(name({"kajiya_kay", ""}), "factored");
  EXPECT_EQ(name({"karis", ""}), "karis");
  EXPECT_EQ(name({"scheuermann", ""}), "half_vector");
}

}  // namespace
}  // namespace cuticle::lut::lut_best_layout_test
