#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// The campaign of broken inputs: a table of cases (cases/*.toml), each a sound input with one thing changed, and what the step
/// must answer. tests/broken_inputs/README.md tells how to write one.
namespace twindeck::broken {

/// A row of the table.
struct Case {
  std::string name;                    ///< file and key: "model_nodes.id_twice"
  std::string step;                    ///< "s1_model"
  std::string base;                    ///< sound input: a folder of bases/
  std::vector<std::string> changes;    ///< of the whole file first, then the case's own; in the language of change.hpp
  std::vector<std::string> arguments;  ///< of the command line, without --out and --quiet
  int exit = 2;                        ///< expected exit code
  std::vector<std::string> words;      ///< that stderr must hold (exit code 0 and --quiet: stderr, stdout or a file of --out)
  bool quiet = true;                   ///< whether --quiet is added: false where a warning is looked for
  bool program = false;                ///< run as a program instead of inside this process
  bool own_out = false;                ///< `arguments` say --out themselves, or leave it out
};

/// All cases below `folder`, by file and then by key. Keys of a file before its table [cases] hold for all of its cases.
/// @throws std::runtime_error  naming the file, for anything that is not as README.md says
[[nodiscard]] std::vector<Case> read_cases(const std::filesystem::path& folder);

/// Words between blanks; "…" keeps blanks and knows \n \t \r \\ \" \xHH.
/// @throws std::runtime_error  for a quote that is not closed or an unknown escape
[[nodiscard]] std::vector<std::string> split_words(const std::string& text);

}  // namespace twindeck::broken
