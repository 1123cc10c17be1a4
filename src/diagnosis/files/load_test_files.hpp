#pragma once

#include <filesystem>

#include "diagnosis/features/features.hpp"
#include "diagnosis/reduction/diagnosed_model.hpp"
#include "diagnosis/reduction/structure.hpp"

/// The load cases and gauges of load tests, as their files place them on the model.
namespace twindeck::diagnosis {

struct LoadTestFiles {
  std::filesystem::path model;     ///< folder with loads.csv, or another source, which has none
  std::filesystem::path channels;  ///< channels.csv
};

/// The load cases that rows were measured under and the gauges of the channels, over the structure's free dofs; empty if no row
/// belongs to a load test.
/// @throws InputError  naming the line: see diagnosis/reduction/load_test_vectors.hpp and model_io/load_cases.hpp; a row whose
///         channel shows nothing of the model's motion
[[nodiscard]] LoadTests load_tests_in_use(const DiagnosedModel& model, const Structure& structure, const Places& places,
                                          const FeatureSet& features, const LoadTestFiles& files);

/// Checks loads and gauges as far as the files alone show, before anything is solved: nodes, supports and elements that the
/// model does not have. @throws InputError  as above
void refuse_unplaced_load_tests(const FeatureSet& features, const std::vector<matching::Channel>& channels,
                                const dynamics::ReadModel& model, const LoadTestFiles& files);

}  // namespace twindeck::diagnosis
