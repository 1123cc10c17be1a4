// Oracle: a beam on two bearings has the waves 2 L / j; zones no longer than the spacing.
#include <gtest/gtest.h>

#include "diagnosis/reduction/basis_modes.hpp"
#include "diagnosis/reduction/diagnosed_model.hpp"
#include "unit/fe/assembly_models.hpp"

namespace twindeck::tests {
namespace {

constexpr int kElements = 60;
constexpr double kSpan = 30.0;

/// A beam along x on two bearings, which bends in its upright plane alone.
fe::Model beam_on_two_bearings() {
  fe::Model model = fe::test::with_steel();
  for (int i = 0; i <= kElements; ++i) fe::test::add_node(model, kSpan * i / kElements, 0.0, 0.0);
  for (int i = 0; i < kElements; ++i) fe::test::add_element(model, fe::ElementType::beam, "girder", 0, 0, {i, i + 1});
  for (int i = 0; i <= kElements; ++i) {
    const bool is_end = i == 0 || i == kElements;
    model.supports.push_back({"n" + std::to_string(i), i, {true, true, is_end, true, false, true}});
  }
  return model;
}

struct Diagnosed {
  std::shared_ptr<diagnosis::DiagnosedModel> prepared;
  diagnosis::Structure structure;
  diagnosis::FeatureSet features;

  /// @param modes  measured; the highest frequency lies just above the last of them
  explicit Diagnosed(int modes) {
    matching::Channel channel;
    channel.name = "middle";
    channel.point = "31";
    channel.direction = Eigen::Vector3d::UnitZ();
    prepared = diagnosis::prepare_model(dynamics::from_model(beam_on_two_bearings()), {channel}, 0.1);
    structure = prepared->structure();
    diagnosis::Row row;
    row.value = 1.01 * dynamics::ModalSolver(*structure.system).solve(structure.theta, modes).frequency_Hz[modes - 1];
    features.rows.push_back(row);
  }
};

TEST(SpacingOfPlaces, IsAnEighthOfTheShortestWave) {
  for (const int modes : {1, 3, 5}) {
    const Diagnosed beam(modes);
    const diagnosis::BasisModes basis = diagnosis::modes_of_basis(beam.structure, beam.features, 12);
    EXPECT_NEAR(basis.eighth_of_wave_m, 2.0 * kSpan / modes / 8.0, 0.02 * kSpan / modes) << modes << " modes";
  }
}

TEST(SpacingOfPlaces, MakesZonesUntilNoneIsLonger) {
  const Diagnosed beam(1);
  diagnosis::PlaceOptions options;
  options.max_zones = 2;
  EXPECT_EQ(diagnosis::find_places(beam.structure, options).sets.at("elements").size(), 2U);
  options.zone_spacing_m = 2.0;
  const auto zones = diagnosis::find_places(beam.structure, options).sets.at("elements");
  EXPECT_GE(zones.size(), 15U);
  for (const diagnosis::Place& zone : zones)
    EXPECT_LE(static_cast<double>(zone.elements.size() - 1) * kSpan / kElements, options.zone_spacing_m) << zone.id;
}

}  // namespace
}  // namespace twindeck::tests
