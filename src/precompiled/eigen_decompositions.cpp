#define TWINDECK_INSTANCE
#include "precompiled/eigen_decompositions.hpp"
