#pragma once

/// Where the repository and the build lie on this machine, for tests that read data of the repository. The paths are in the
/// object of test_places.cpp alone, so that no other object differs between two clones.
namespace twindeck::test_places {
extern const char* const sources;
extern const char* const build;
}  // namespace twindeck::test_places

#define TWINDECK_SOURCE_DIR ::twindeck::test_places::sources
#define TWINDECK_BINARY_DIR ::twindeck::test_places::build
