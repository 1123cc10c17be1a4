// Oracle: what OpenBLAS and the OpenMP runtime say themselves, where they are there.
#include "linalg/one_thread.hpp"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include "linalg/dense.hpp"

namespace twindeck::linalg {
namespace {

using Number = int (*)();

Number number(const char* name) { return reinterpret_cast<Number>(dlsym(RTLD_DEFAULT, name)); }

TEST(UseOneThread, LimitsOpenBlas) {
  use_one_thread();
  use_one_thread();  // may be called again
  const Number threads = number("openblas_get_num_threads");
  if (threads == nullptr) GTEST_SKIP() << "the BLAS is not OpenBLAS";
  EXPECT_EQ(threads(), 1);
}

TEST(SerialScope, AllowsNoParallelRegionAndPutsTheLimitBack) {
  const Number levels = number("omp_get_max_active_levels");
  if (levels == nullptr) GTEST_SKIP() << "no OpenMP runtime is loaded";
  const int before = levels();
  {
    const SerialScope outer;
    EXPECT_EQ(levels(), 0);
    {
      const SerialScope inner;
      EXPECT_EQ(levels(), 0);
    }
    EXPECT_EQ(levels(), 0);  // the inner one leaves the outer one's limit
  }
  EXPECT_EQ(levels(), before);
}

}  // namespace
}  // namespace twindeck::linalg
