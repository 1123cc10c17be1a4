#include "fe/assembly_pattern.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/lists.hpp"

namespace twindeck::fe {

namespace {

void keep_each_once(std::vector<std::vector<int>>& lists) {
  for (std::vector<int>& list : lists) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

/// For every node, the nodes whose free degrees of freedom move it: itself, the end of its chain of links, what it is tied to.
std::vector<std::vector<int>> carriers_of(const Model& model, const DofMap& map) {
  std::vector<std::vector<int>> carriers(model.nodes.size());
  for (std::size_t full = 0; full < map.rows.size(); ++full)
    for (const DofMap::Entry& entry : map.rows[full]) carriers[full / 6].push_back(map.node_of[slot(entry.dof)]);
  keep_each_once(carriers);
  return carriers;
}

/// Neighbours (self included) of every node with free degrees of freedom, by anything that couples two nodes.
std::vector<std::vector<int>> couple_nodes(const Model& model, const DofMap& map) {
  std::vector<std::vector<int>> neighbours(model.nodes.size());
  const auto carriers = carriers_of(model, map);
  const auto couple = [&](const std::vector<int>& nodes) {
    for (const int first : nodes)
      for (const int second : nodes)
        for (const int a : carriers[slot(first)])
          neighbours[slot(a)].insert(neighbours[slot(a)].end(), carriers[slot(second)].begin(), carriers[slot(second)].end());
  };
  for (int node = 0; node < static_cast<int>(model.nodes.size()); ++node) couple({node});
  for (const Element& element : model.elements) couple(element.nodes);
  for (const Spring& spring : model.springs)
    if (spring.node2 >= 0) couple({spring.node, spring.node2});
  for (const MatrixElement& element : model.matrix_elements) couple(each_of(element.dofs, &MatrixElement::Dof::node));
  keep_each_once(neighbours);
  return neighbours;
}

}  // namespace

linalg::SparseMatrix make_pattern(const Model& model, const DofMap& map) {
  const int n = static_cast<int>(map.dofs.size());
  std::vector<std::vector<int>> dofs_of(model.nodes.size());  // free degrees of freedom of a node, ascending
  for (int dof = 0; dof < n; ++dof) dofs_of[slot(map.node_of[slot(dof)])].push_back(dof);
  const auto neighbours = couple_nodes(model, map);

  linalg::SparseMatrix pattern(n, n);
  std::vector<int> outer{0}, inner;
  for (int column = 0; column < n; ++column) {
    for (const int node : neighbours[slot(map.node_of[slot(column)])])
      for (const int row : dofs_of[slot(node)])
        if (row >= column) inner.push_back(row);
    outer.push_back(static_cast<int>(inner.size()));
  }
  // Nodes and their degrees of freedom are numbered in the same order, so rows ascend within a column already.
  pattern.resizeNonZeros(static_cast<Eigen::Index>(inner.size()));
  std::copy(outer.begin(), outer.end(), pattern.outerIndexPtr());
  std::copy(inner.begin(), inner.end(), pattern.innerIndexPtr());
  std::fill_n(pattern.valuePtr(), inner.size(), 0.0);
  return pattern;
}

Scatter::Scatter(const linalg::SparseMatrix& pattern, const DofMap& map)
    : pattern_(pattern), map_(map), sum_(static_cast<std::size_t>(pattern.nonZeros()), 0.0), is_touched_(sum_.size(), 0) {}

int Scatter::position(int row, int column, int after) const {
  const int* inner = pattern_.innerIndexPtr();
  const int last = pattern_.outerIndexPtr()[column + 1];
  // Rows come one after another more often than not.
  if (after >= 0 && after + 1 < last && inner[after + 1] == row) return after + 1;
  const int* found = std::lower_bound(inner + pattern_.outerIndexPtr()[column], inner + last, row);
  TWINDECK_ASSERT(found != inner + last && *found == row);
  return static_cast<int>(found - inner);
}

void Scatter::add(const ElementMatrix& element) {
  for (std::size_t j = 0; j < element.dofs.size(); ++j)
    for (const DofMap::Entry& column : map_.rows[slot(element.dofs[j])]) {
      int p = -1;  // position of the entry before, in this column
      for (std::size_t i = 0; i < element.dofs.size(); ++i) {
        const double k = element.matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
        if (k == 0.0) continue;
        for (const DofMap::Entry& row : map_.rows[slot(element.dofs[i])]) {
          if (row.dof < column.dof) continue;
          p = position(row.dof, column.dof, p);
          if (!is_touched_[slot(p)]) {
            is_touched_[slot(p)] = 1;
            touched_.push_back(p);
          }
          sum_[slot(p)] += row.factor * column.factor * k;
        }
      }
    }
}

void Scatter::take(Term& term) {
  if (touched_.size() > sum_.size() / 16) {  // many: reading through the marks is quicker than sorting
    touched_.clear();
    for (std::size_t p = 0; p < sum_.size(); ++p)
      if (is_touched_[p]) touched_.push_back(static_cast<int>(p));
  } else {
    std::sort(touched_.begin(), touched_.end());
  }
  term.position.reserve(touched_.size());
  term.value.reserve(touched_.size());
  for (const int p : touched_) {
    if (sum_[slot(p)] != 0.0) {
      term.position.push_back(p);
      term.value.push_back(sum_[slot(p)]);
    }
    sum_[slot(p)] = 0.0;
    is_touched_[slot(p)] = 0;
  }
  touched_.clear();
}

}  // namespace twindeck::fe
