#pragma once

#include <Eigen/Core>
#include <memory>

#include "fe/assembly.hpp"
#include "fe/model.hpp"
#include "fe/parametric_system.hpp"

namespace twindeck::fe {

/// A model numbered and assembled once: everything that does not depend on its prestress. The prestress of other parameter
/// values, and the system that it stiffens, then cost a factorisation and the geometric terms, not a new assembly.
/// `find_prestress` and `assemble` are its two functions for a single use. Copies share the
/// assembly; the const functions may run in several threads.
class Structure {
 public:
  struct Parts;  ///< see structure_parts.hpp
  /// @throws InputError for a model that is not sound (see `validate`)
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
