#define TWINDECK_INSTANCE
#include "linalg/dense_instances.hpp"
