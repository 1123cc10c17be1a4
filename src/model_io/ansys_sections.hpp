#pragma once

#include "model_io/ansys_build.hpp"

/// Inside of the library: cross-sections that SECTYPE and real constants give to beams, bars and shells.
namespace twindeck::model_io::ansys {

[[nodiscard]] CrossSection beam_section(Builder& builder, const Member& member, double poisson_ratio);
[[nodiscard]] CrossSection bar_section(Builder& builder, const Member& member);
[[nodiscard]] CrossSection shell_section(Builder& builder, const Member& member);

}  // namespace twindeck::model_io::ansys
