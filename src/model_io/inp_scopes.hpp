#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model_io/inp_cards.hpp"

/// Inside of the library: parts and instances of an .inp file. A card inside a part is read once for each instance of the part,
/// in the instance's place and with numbers of its own.
namespace twindeck::model_io {

/// Where a card is read: an instance of a part, or (the first scope) the assembly with everything outside of parts.
///
/// The numbers of a file hold within an instance. Those of the first stay as they are in the model; where the numbers of a
/// further one, or of the assembly, overlap with what came before, a multiple of a power of ten is added to them.
struct InpScope {
  std::string name;  ///< of the instance, as written; "" = the assembly
  long node_offset = 0, element_offset = 0;
  long last_node = 0;                                      ///< the largest number of the file in it
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< of the part in the assembly: x -> rotation x + shift_m
  Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();
  [[nodiscard]] bool turned() const { return !rotation.isIdentity(0.0); }
};

/// One reading of a card.
struct InpReading {
  const InpCard* card = nullptr;
  int scope = 0;
};

struct InpPlan {
  std::vector<InpScope> scopes;
  std::vector<InpReading> readings;  ///< in the order of the file, parts at the place of their instances
  std::vector<std::string> notes;
};

/// Parts, instances and their numbers. Cards below the step whose modes are asked for (the first with *FREQUENCY) are left out.
/// @throws InputError  for an instance of an unknown part, two of one name, an axis of rotation without length, a PART or
///         INSTANCE that is not closed, numbers too large to be kept apart
[[nodiscard]] InpPlan plan_readings(const InpFile& file);

/// The *BOUNDARY cards that hold in that step: OP=NEW in a step drops those before the step.
[[nodiscard]] std::vector<const InpCard*> boundaries_in_force(const InpFile& file);

/// @throws InputError  if the step with *FREQUENCY holds other directions than the static steps, whose loaded state it starts
/// from
void refuse_other_supports_than_of_static_steps(const InpFile& file);

}  // namespace twindeck::model_io
