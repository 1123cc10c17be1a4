#define TWINDECK_INSTANCE
#include "precompiled/eigen_kernels.hpp"
