/// Oracles: the VTK format's own counting rules (as many numbers as points, cells, components say), and the scaling that the
/// header promises (longest vector 1). Tags must close in the order in which they were opened.
#include "model_io/vtu.hpp"

#include <sstream>

#include "test_folder.hpp"

namespace twindeck::model_io::test {
namespace {

/// The one-of-everything model with a system in which every displacement is free, and one mode.
std::string vtu_of_one_mode(const TestFolder& folder) {
  fe::Model model = one_of_everything();
  model.title = "a < b & c";
  const int n = 6 * static_cast<int>(model.nodes.size());
  fe::ParametricSystem system;
  system.pattern.resize(n, n);
  system.expansion.resize(n, n);
  system.expansion.setIdentity();
  dynamics::EigenModes modes;
  modes.frequency_Hz = Eigen::VectorXd::Constant(1, 0.681);
  modes.shapes = Eigen::VectorXd::Zero(n);
  modes.shapes(6, 0) = 3.0;   // node 2, x
  modes.shapes(8, 0) = -4.0;  // node 2, z
  modes.shapes(9, 0) = 99.0;  // a rotation, which must not count
  write_vtu(model, system, modes, folder.path() / "model.vtu");
  return folder.read("model.vtu");
}

std::vector<double> numbers_of(const std::string& text, const std::string& name) {
  const auto at = text.find("Name=\"" + name + "\"");
  if (at == std::string::npos) return {};
  const auto first = text.find('>', at) + 1;
  std::istringstream stream(text.substr(first, text.find('<', first) - first));
  std::vector<double> numbers;
  for (double x = 0.0; stream >> x;) numbers.push_back(x);
  return numbers;
}

TEST(Vtu, IsWellFormedXml) {
  const TestFolder folder;
  const std::string text = vtu_of_one_mode(folder);
  std::vector<std::string> open;
  std::string rest;
  std::size_t done = 0;
  for (std::size_t begin = text.find('<'); begin != std::string::npos; begin = text.find('<', done)) {
    const std::size_t end = text.find('>', begin);
    ASSERT_NE(end, std::string::npos);
    const std::string tag = text.substr(begin + 1, end - begin - 1);
    EXPECT_EQ(tag.find('<'), std::string::npos) << tag;
    rest += text.substr(done, begin - done);
    done = end + 1;
    if (tag.starts_with("?") || tag.starts_with("!--")) continue;  // the prolog and comments
    if (!tag.starts_with("/")) {
      open.push_back(tag.substr(0, tag.find(' ')));
      continue;
    }
    ASSERT_FALSE(open.empty());
    EXPECT_EQ(open.back(), tag.substr(1));
    open.pop_back();
  }
  EXPECT_TRUE(open.empty());
  // Outside tags only numbers are left.
  EXPECT_EQ((rest + text.substr(done)).find_first_not_of("0123456789.eE+- \n"), std::string::npos);
}

TEST(Vtu, CountsPointsCellsAndComponents) {
  const TestFolder folder;
  const std::string text = vtu_of_one_mode(folder);
  EXPECT_NE(text.find("<Piece NumberOfPoints=\"4\" NumberOfCells=\"5\">"), std::string::npos);
  EXPECT_EQ(numbers_of(text, "Points").size(), 12u);
  EXPECT_EQ(numbers_of(text, "connectivity"), (std::vector<double>{0, 1, 1, 2, 1, 2, 0, 1, 2, 3, 1, 2, 3}));
  EXPECT_EQ(numbers_of(text, "offsets"), (std::vector<double>{2, 4, 6, 10, 13}));
  EXPECT_EQ(numbers_of(text, "types"), (std::vector<double>{3, 3, 3, 9, 5}));
  EXPECT_EQ(numbers_of(text, "type"), (std::vector<double>{0, 2, 1, 3, 3}));
  EXPECT_EQ(numbers_of(text, "group"), (std::vector<double>{0, 2, 2, 1, 1}));  // chord, slab_foot_B, stay_60
  EXPECT_EQ(numbers_of(text, "element"), (std::vector<double>{10, 11, 13, 12, 14}));
}

TEST(Vtu, ModesAreScaledToTheLongestTranslation) {
  const TestFolder folder;
  const std::vector<double> shape = numbers_of(vtu_of_one_mode(folder), "mode_01_0.6810_Hz");
  ASSERT_EQ(shape.size(), 12u);
  EXPECT_DOUBLE_EQ(shape[3], 0.6);
  EXPECT_DOUBLE_EQ(shape[5], -0.8);
}

}  // namespace
}  // namespace twindeck::model_io::test
