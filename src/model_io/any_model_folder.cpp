#include "model_io/any_model_folder.hpp"

#include "model_io/load_cases.hpp"
#include "model_io/matrix_model.hpp"
#include "model_io/read_model.hpp"
#include "model_io/write_model.hpp"

namespace twindeck::model_io {

dynamics::ReadModel read_model_folder(const std::filesystem::path& folder) {
  if (!is_matrix_model(folder)) return dynamics::valid_model(read_model(folder));
  dynamics::ReadModel read;
  read.source = folder.string();
  read.matrices = read_matrix_model(folder);
  return read;
}

void save_model(const dynamics::LoadedModel& loaded, const Eigen::VectorXd& theta, const std::filesystem::path& folder) {
  if (loaded.model) {
    write_model(fe::with_parameters(*loaded.model, theta), folder);
  } else {
    fe::ParametricSystem system = loaded.system;
    for (std::size_t p = 0; p < system.parameters.size(); ++p)
      system.parameters[p].initial = theta[static_cast<Eigen::Index>(p)];
    write_matrix_model(system, folder);
  }
  carry_load_cases(loaded.source, folder);
}

}  // namespace twindeck::model_io
