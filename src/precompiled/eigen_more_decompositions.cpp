#define TWINDECK_INSTANCE
#include "precompiled/eigen_more_decompositions.hpp"
