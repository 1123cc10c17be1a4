#pragma once

#include <Eigen/Core>
#include <memory>

#include "fe/assembly.hpp"
#include "fe/model.hpp"
#include "fe/parametric_system.hpp"

namespace twindeck::fe {

/// A model that is numbered and assembled once, as far as this does not depend on the prestress. The prestress of other
/// parameter values, and the system with it, then need a factorisation and the geometric terms, but no new assembly.
/// The functions `find_prestress` and `assemble` do the same for a single use. Copies share the assembly. The const functions
/// may run in several threads.
class Structure {
 public:
  struct Parts;  ///< see structure_parts.hpp
  /// @throws InputError for an invalid model (see `validate`)
  explicit Structure(Model model);
  [[nodiscard]] const Model& model() const;
  /// See `find_prestress`.
  [[nodiscard]] PrestressState prestress(const Eigen::VectorXd& theta) const;
  /// See `assemble`.
  [[nodiscard]] ParametricSystem system(const PrestressState& state) const;

 private:
  std::shared_ptr<const Parts> parts_;
};

}  // namespace twindeck::fe
