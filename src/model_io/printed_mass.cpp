#include "model_io/printed_mass.hpp"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <vector>

#include "model_io/deck_card.hpp"

namespace twindeck::model_io {
namespace {

/// The numbers of a line; words between them are passed over.
std::vector<double> numbers_in(const std::string& line) {
  std::istringstream stream(line);
  std::vector<double> numbers;
  for (std::string word; stream >> word;) {
    std::istringstream one(word);
    double value = 0.0;
    if (one >> value && one.eof()) numbers.push_back(value);
  }
  return numbers;
}

/// The next line with numbers.
std::vector<double> numbers_below(std::ifstream& stream) {
  std::string line;
  while (std::getline(stream, line))
    if (std::vector<double> numbers = numbers_in(line); !numbers.empty()) return numbers;
  return {};
}

/// Rows X, Y, Z of the grid point weight generator: mass and the centre by each axis, whose own coordinate has no meaning.
std::string of_weight_generator(std::ifstream& stream) {
  const std::vector<double> x = numbers_below(stream), y = numbers_below(stream), z = numbers_below(stream);
  if (x.size() < 4 || y.size() < 4 || z.size() < 4) return "";
  return fmt::format("mass {:g}, centre of mass ({:g}, {:g}, {:g})", x[0], y[1], x[2], x[3]);
}

std::string of_abaqus(std::ifstream& stream) {
  const std::vector<double> mass = numbers_below(stream), centre = numbers_below(stream);
  if (mass.empty()) return "";
  std::string words = fmt::format("mass {:g}", mass[0]);
  if (centre.size() == 3) words += fmt::format(", centre of mass ({:g}, {:g}, {:g})", centre[0], centre[1], centre[2]);
  return words;
}

}  // namespace

std::string printed_mass(const std::filesystem::path& deck) {
  for (const char* ending : {".f06", ".dat"}) {
    std::filesystem::path beside = deck;
    beside.replace_extension(ending);
    if (beside == deck || !std::filesystem::is_regular_file(beside)) continue;
    std::ifstream stream(beside);
    std::string line, words;
    while (words.empty() && std::getline(stream, line)) {
      const std::string upper = upper_case(line);
      if (upper.find("MASS AXIS SYSTEM (S)") != std::string::npos) words = of_weight_generator(stream);
      if (upper.find("TOTAL MASS OF MODEL") != std::string::npos) words = of_abaqus(stream);
    }
    if (!words.empty()) return beside.filename().string() + " has " + words;
  }
  return "";
}

}  // namespace twindeck::model_io
