#pragma once

#include <map>
#include <string>

/// Cards that a model does without, and cards that it cannot do without: one table each.
namespace twindeck::model_io::nastran {

/// Cards that change neither stiffness nor mass, with the reason ("a load"); they are counted in a note.
[[nodiscard]] const std::map<std::string, std::string>& ignored_cards();

/// Cards that are known and refused, with what to write instead.
[[nodiscard]] const std::map<std::string, std::string>& refused_cards();

/// PARAM names that would scale the matrices of the structure; every other parameter but WTMASS and COUPMASS is passed over.
[[nodiscard]] bool scales_matrices(const std::string& parameter);

}  // namespace twindeck::model_io::nastran
