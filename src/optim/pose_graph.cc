// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/optim/pose_graph.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "semslam/base/check.h"

#include "optim/damping.h"
#include "optim/relative_pose.h"

namespace semslam {
namespace {

using internal::Matrix6d;
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr int kFixed = -1;

// Consecutive numbers for the nodes that move.
std::vector<int> NumberFreeNodes(const PoseGraph& graph) {
  std::vector<int> number(graph.T_world_node.size());
  const bool any_fixed =
      std::find(graph.is_fixed.begin(), graph.is_fixed.end(), 1) != graph.is_fixed.end();
  int next = 0;
  for (std::size_t i = 0; i < number.size(); ++i) {
    const bool is_fixed = graph.is_fixed[i] != 0 || (!any_fixed && i == 0);
    number[i] = is_fixed ? kFixed : next++;
  }
  return number;
}

void CheckGraph(const PoseGraph& graph) {
  const auto num_nodes = static_cast<int>(graph.T_world_node.size());
  SEMSLAM_CHECK(graph.is_fixed.size() == graph.T_world_node.size())
      << graph.is_fixed.size() << " flags, " << num_nodes << " nodes";
  for (const PoseGraph::Edge& edge : graph.edges) {
    SEMSLAM_CHECK(edge.from >= 0 && edge.from < num_nodes && edge.to >= 0 && edge.to < num_nodes &&
                  edge.from != edge.to)
        << "edge " << edge.from << " - " << edge.to;
    SEMSLAM_CHECK(std::isfinite(edge.weight) && edge.weight > 0) << edge.weight;
  }
}

double Cost(const PoseGraph& graph, const std::vector<Rigid3>& T_world_node) {
  double cost = 0;
  for (const PoseGraph::Edge& edge : graph.edges) {
    cost += edge.weight * internal::RelativePoseResidual(T_world_node[edge.from],
                                                         T_world_node[edge.to], edge.T_from_to)
                              .squaredNorm();
  }
  return cost;
}

// The normal equations H dx = -g of all edges.
class NormalEquations {
 public:
  explicit NormalEquations(std::vector<int> number) : number_(std::move(number)) {
    int num_free = 0;
    for (const int n : number_) num_free = std::max(num_free, n + 1);
    size_ = Eigen::Index{6} * num_free;
  }
  Eigen::Index size() const { return size_; }
  const Eigen::VectorXd& gradient() const { return gradient_; }
  const Eigen::VectorXd& diagonal() const { return diagonal_; }

  void Linearize(const PoseGraph& graph, const std::vector<Rigid3>& T_world_node) {
    gradient_ = Eigen::VectorXd::Zero(size_);
    triplets_.clear();
    for (const PoseGraph::Edge& edge : graph.edges) {
      const auto term = internal::LinearizeRelativePose(T_world_node[edge.from],
                                                        T_world_node[edge.to], edge.T_from_to);
      const int i = number_[edge.from];
      const int j = number_[edge.to];
      if (i != kFixed) AddGradient(i, edge.weight * term.jacobian_i.transpose() * term.residual);
      if (j != kFixed) AddGradient(j, edge.weight * term.jacobian_j.transpose() * term.residual);
      AddBlock(i, i, edge.weight * term.jacobian_i.transpose() * term.jacobian_i);
      AddBlock(j, j, edge.weight * term.jacobian_j.transpose() * term.jacobian_j);
      // Only the lower triangle is read.
      const Matrix6d mixed = edge.weight * term.jacobian_i.transpose() * term.jacobian_j;
      i > j ? AddBlock(i, j, mixed) : AddBlock(j, i, mixed.transpose());
    }
    for (Eigen::Index i = 0; i < size_; ++i) triplets_.emplace_back(i, i, 0.0);
    hessian_.resize(size_, size_);
    hessian_.setFromTriplets(triplets_.begin(), triplets_.end());
    diagonal_ = hessian_.diagonal();
  }

  // The step with something added to the diagonal; nothing if that is not positive definite.
  std::optional<Eigen::VectorXd> Solve(const Eigen::VectorXd& added) {
    SparseMatrix damped = hessian_;
    for (Eigen::Index i = 0; i < size_; ++i) damped.coeffRef(i, i) += added[i];
    if (!is_analyzed_) solver_.analyzePattern(damped);  // It is the same every time.
    is_analyzed_ = true;
    solver_.factorize(damped);
    if (solver_.info() != Eigen::Success) return std::nullopt;
    const Eigen::VectorXd step = solver_.solve(-gradient_);
    if (!step.allFinite()) return std::nullopt;
    return step;
  }

  std::vector<Rigid3> Moved(const std::vector<Rigid3>& T_world_node,
                            const Eigen::VectorXd& step) const {
    std::vector<Rigid3> moved = T_world_node;
    for (std::size_t i = 0; i < moved.size(); ++i) {
      if (number_[i] == kFixed) continue;
      moved[i] = Retract(moved[i], step.segment<6>(Eigen::Index{6} * number_[i]));
    }
    return moved;
  }

 private:
  void AddGradient(int node, const Vector6d& g) {
    gradient_.segment<6>(Eigen::Index{6} * node) += g;
  }
  void AddBlock(int row, int column, const Matrix6d& block) {
    if (row == kFixed || column == kFixed) return;
    for (int r = 0; r < 6; ++r) {
      for (int c = 0; c < 6; ++c) {
        triplets_.emplace_back(6 * row + r, 6 * column + c, block(r, c));
      }
    }
  }

  std::vector<int> number_;  // One a node.
  Eigen::Index size_ = 0;
  std::vector<Eigen::Triplet<double>> triplets_;
  SparseMatrix hessian_;
  Eigen::VectorXd diagonal_;
  Eigen::VectorXd gradient_;
  Eigen::SimplicialLDLT<SparseMatrix> solver_;
  bool is_analyzed_ = false;
};

}  // namespace

void PoseGraphOptions::Validate() const {
  SEMSLAM_CHECK(max_iterations >= 0) << max_iterations;
  SEMSLAM_CHECK(relative_tolerance >= 0) << relative_tolerance;
}

PoseGraphSolution OptimizePoseGraph(const PoseGraph& graph, const PoseGraphOptions& options) {
  options.Validate();
  CheckGraph(graph);
  PoseGraphSolution solution{.T_world_node = graph.T_world_node};
  solution.initial_cost = Cost(graph, solution.T_world_node);
  solution.final_cost = solution.initial_cost;
  NormalEquations equations(NumberFreeNodes(graph));
  if (equations.size() == 0 || graph.edges.empty()) return solution;

  internal::Damping damping;
  equations.Linearize(graph, solution.T_world_node);
  while (solution.num_iterations < options.max_iterations && !damping.exhausted()) {
    ++solution.num_iterations;
    Eigen::VectorXd added(equations.size());
    for (Eigen::Index i = 0; i < added.size(); ++i) added[i] = damping.Of(equations.diagonal()[i]);
    const std::optional<Eigen::VectorXd> step = equations.Solve(added);
    if (!step) {
      damping.StepRejected();
      continue;
    }
    const double predicted = step->dot(added.cwiseProduct(*step) - equations.gradient());
    if (!(predicted > 0)) break;  // At the minimum, to the last digit.
    std::vector<Rigid3> trial = equations.Moved(solution.T_world_node, *step);
    const double trial_cost = Cost(graph, trial);
    const double decrease = solution.final_cost - trial_cost;
    if (!(decrease > 0)) {
      // A step that promised nothing and brought nothing: this is the minimum.
      if (predicted <= options.relative_tolerance * solution.final_cost) break;
      damping.StepRejected();
      continue;
    }
    const bool converged = decrease <= options.relative_tolerance * solution.final_cost;
    damping.StepTaken(decrease, predicted);
    solution.T_world_node = std::move(trial);
    solution.final_cost = trial_cost;
    if (converged) break;
    equations.Linearize(graph, solution.T_world_node);
  }
  return solution;
}

}  // namespace semslam
