// Models without kernels for drawing, drawn one point at a time.
#include <gtest/gtest.h>

#include "tests/support/batch_data.h"

namespace cuticle::bsdf::one_by_one_test {
namespace {

using tests::Arrays;
using tests::Data;

// deon draws its inclination by the fifth and the sixth.
TEST(Batch, ModelWithoutKernels_DrawsByNumbersAfterTheFifth) {
  const Data data(8);
  const Model& deon = *find_model("deon").value();
  const BatchEvaluator batch = *BatchEvaluator::make(deon, parse_settings(deon, "", "").value());
  BatchQueries queries = data.queries();
  Arrays without(8), with(8);
  ASSERT_TRUE(batch.sample(queries, without.out()).ok());
  queries.u[5] = data.u[0];
  ASSERT_TRUE(batch.sample(queries, with.out()).ok());
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NE(without.x[i], with.x[i]) << i;
}

}  // namespace
}  // namespace cuticle::bsdf::one_by_one_test
