#include "steps/identification/exports.hpp"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <charconv>
#include <cmath>
#include <map>

#include "io/atomic.hpp"
#include "records/record.hpp"
#include "records/universal.hpp"
#include "records/write_universal.hpp"

namespace twindeck::steps {

using Eigen::Index;

namespace {

struct Point {
  std::string name;
  Eigen::Vector3d position_m;
  std::vector<std::size_t> channels;
};

std::vector<Point> points_of(const identification::ConditionResult& result) {
  std::vector<Point> points;
  std::map<std::string, std::size_t> at;
  for (std::size_t c = 0; c < result.channels.size(); ++c) {
    const records::CampaignChannel& channel = result.channels[c];
    if (!channel.position_m.allFinite() || !channel.direction.allFinite() || channel.direction.norm() == 0.0) continue;
    const auto [entry, is_new] = at.try_emplace(channel.point, points.size());
    if (is_new) points.push_back({channel.point, channel.position_m, {}});
    points[entry->second].channels.push_back(c);
  }
  return points;
}

/// Shortest vector u with d_c · u = value of each channel, in the sense of least squares; zero where the mode is not known.
Eigen::Vector3cd vector_at(const identification::ConditionResult& result, const Point& point, const Eigen::VectorXcd& shape) {
  std::vector<std::size_t> known;
  for (const std::size_t c : point.channels)
    if (!std::isnan(shape[static_cast<Index>(c)].real())) known.push_back(c);
  if (known.empty()) return Eigen::Vector3cd::Zero();
  Eigen::MatrixXd cosines(std::ssize(known), 3);
  Eigen::VectorXcd values(std::ssize(known));
  for (Index i = 0; i < values.size(); ++i) {
    const std::size_t c = known[static_cast<std::size_t>(i)];
    cosines.row(i) = result.channels[c].direction.normalized().transpose();
    values[i] = shape[static_cast<Index>(c)];
  }
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(cosines, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(1e-6);
  Eigen::Vector3cd vector;
  vector.real() = svd.solve(values.real());
  vector.imag() = svd.solve(values.imag());
  return vector;
}

/// Labels of nodes: the points' own names where all are numbers, otherwise 1, 2, …
std::vector<long> labels_of(const std::vector<Point>& points) {
  std::vector<long> labels;
  for (const Point& point : points) {
    long label = 0;
    const auto [end, error] = std::from_chars(point.name.data(), point.name.data() + point.name.size(), label);
    if (error != std::errc() || end != point.name.data() + point.name.size() || label <= 0) break;
    labels.push_back(label);
  }
  if (labels.size() == points.size()) return labels;
  labels.clear();
  for (std::size_t i = 0; i < points.size(); ++i) labels.push_back(static_cast<long>(i) + 1);
  return labels;
}

std::string array_of(const std::string& attributes, const std::string& body) {
  return fmt::format("<DataArray {} format=\"ascii\">\n{}</DataArray>\n", attributes, body);
}

std::string grid(const std::vector<Point>& points, const std::string& point_data) {
  std::string positions, connectivity, offsets, types;
  for (std::size_t i = 0; i < points.size(); ++i) {
    positions +=
        fmt::format("{:.9g} {:.9g} {:.9g}\n", points[i].position_m[0], points[i].position_m[1], points[i].position_m[2]);
    connectivity += fmt::format("{}\n", i);
    offsets += fmt::format("{}\n", i + 1);
    types += "1\n";
  }
  return fmt::format(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n<UnstructuredGrid>\n<Piece "
      "NumberOfPoints=\"{0}\" "
      "NumberOfCells=\"{0}\">\n<Points>\n{1}</Points>\n<Cells>\n{2}{3}{4}</Cells>\n<PointData>\n{5}</PointData>\n</Piece>\n</"
      "UnstructuredGrid>\n</VTKFile>\n",
      points.size(), array_of("type=\"Float64\" NumberOfComponents=\"3\"", positions),
      array_of("type=\"Int64\" Name=\"connectivity\"", connectivity), array_of("type=\"Int64\" Name=\"offsets\"", offsets),
      array_of("type=\"UInt8\" Name=\"types\"", types), point_data);
}

}  // namespace

void write_mode_exports(const identification::ConditionResult& result, const std::filesystem::path& folder) {
  const std::vector<Point> points = points_of(result);
  if (points.empty() || result.modes.empty()) return;
  const std::vector<long> labels = labels_of(points);
  records::UniversalData universal;
  universal.title = "modes, condition " + result.condition;
  for (std::size_t i = 0; i < points.size(); ++i) universal.nodes[labels[i]] = points[i].position_m;
  std::string fields;
  for (std::size_t m = 0; m < result.modes.size(); ++m) {
    const identification::MergedMode& mode = result.modes[m];
    records::NodalResult shape;
    shape.title = fmt::format("mode {}, {:.6g} Hz, damping {:.3g} %", m + 1, mode.frequency_Hz, 100.0 * mode.damping_ratio);
    shape.analysis = 3;
    shape.mode = static_cast<int>(m) + 1;
    shape.complex = true;
    shape.frequency_Hz = mode.frequency_Hz;
    shape.damping_ratio = mode.damping_ratio;
    shape.eigenvalue = identification::eigenvalue_of(mode.frequency_Hz, mode.damping_ratio);
    double largest = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      shape.values[labels[i]] = vector_at(result, points[i], mode.shape);
      largest = std::max(largest, shape.values[labels[i]].cwiseAbs().maxCoeff());
    }
    std::string body;
    for (std::size_t i = 0; i < points.size(); ++i) {
      Eigen::VectorXcd& vector = shape.values[labels[i]];
      vector /= std::max(largest, 1e-300);
      body += fmt::format("{:.9g} {:.9g} {:.9g}\n", vector[0].real(), vector[1].real(), vector[2].real());
    }
    fields += array_of(
        fmt::format("type=\"Float64\" Name=\"mode {} {:.4f} Hz\" NumberOfComponents=\"3\"", m + 1, mode.frequency_Hz), body);
    universal.results.push_back(std::move(shape));
  }
  records::write_universal(universal, folder / "modes.unv");
  io::write_file_atomically(folder / "modes.vtu", grid(points, fields));
}

}  // namespace twindeck::steps
