#include "test_places.hpp"

namespace twindeck::test_places {

const char* const sources = TWINDECK_SOURCE_FOLDER;
const char* const build = TWINDECK_BINARY_FOLDER;

}  // namespace twindeck::test_places
