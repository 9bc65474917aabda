// A curve of the study of lobes.
#include <cstdio>

#include <cuticle/bsdf/model.h>
#include <cuticle/study/lobes/lobes_study.h>

int main() {
  const auto model = cuticle::bsdf::find_model("marschner");
  if (!model || !cuticle::study::albedo_curve(**model, "", 9)) return 1;
  std::printf("albedo of marschner\n");
}
