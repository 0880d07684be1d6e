// SPDX-FileCopyrightText: 2026 the semslam authors
// SPDX-License-Identifier: BSD-3-Clause
#include "semslam/optim/pose_graph.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include <gtest/gtest.h>

#include "semslam/base/random.h"

#include "optim/relative_pose.h"

namespace semslam {
namespace {

using internal::Matrix6d;

Vector6d RandomTwist(double angle, double distance, Random& random) {
  Vector6d twist;
  for (int i = 0; i < 6; ++i) twist[i] = (i < 3 ? angle : distance) * random.Gaussian();
  return twist;
}

TEST(RelativePose, JacobiansAreThoseOfNumericDifferences) {
  Random random(1);
  for (int round = 0; round < 50; ++round) {
    const Rigid3 T_world_i = Retract(Rigid3{}, RandomTwist(1, 2, random));
    const Rigid3 T_world_j = Retract(Rigid3{}, RandomTwist(1, 2, random));
    // From no error at all to a large one.
    const Rigid3 measured =
        Retract(T_world_i.Inverse() * T_world_j, RandomTwist(0.01 * round, 0.02 * round, random));
    const auto term = internal::LinearizeRelativePose(T_world_i, T_world_j, measured);
    constexpr double kStep = 1e-6;
    for (int k = 0; k < 6; ++k) {
      const Vector6d step = kStep * Vector6d::Unit(k);
      const auto at = [&](const Vector6d& delta_i, const Vector6d& delta_j) {
        return internal::RelativePoseResidual(Retract(T_world_i, delta_i),
                                              Retract(T_world_j, delta_j), measured);
      };
      const Vector6d zero = Vector6d::Zero();
      const Vector6d numeric_i = (at(step, zero) - at(-step, zero)) / (2 * kStep);
      const Vector6d numeric_j = (at(zero, step) - at(zero, -step)) / (2 * kStep);
      EXPECT_LT((term.jacobian_i.col(k) - numeric_i).norm(), 1e-6) << "round " << round;
      EXPECT_LT((term.jacobian_j.col(k) - numeric_j).norm(), 1e-6) << "round " << round;
    }
  }
}

// A camera that goes round a circle, outward looking.
std::vector<Rigid3> Circle(int num_poses, double radius) {
  std::vector<Rigid3> poses;
  for (int i = 0; i < num_poses; ++i) {
    const double angle = 2 * std::numbers::pi * i / num_poses;
    poses.push_back(
        {ExpSO3({0, angle, 0}), radius * Eigen::Vector3d(std::sin(angle), 0, std::cos(angle) - 1)});
  }
  return poses;
}

// Odometry around the circle, with an error in each step, and an exact loop edge.
PoseGraph DriftingCircle(const std::vector<Rigid3>& truth, const Vector6d& error) {
  PoseGraph graph;
  graph.T_world_node.push_back(truth[0]);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    const Rigid3 step = Retract(truth[i - 1].Inverse() * truth[i], error);
    graph.edges.push_back({static_cast<int>(i) - 1, static_cast<int>(i), step});
    graph.T_world_node.push_back(graph.T_world_node.back() * step);
  }
  graph.is_fixed.assign(truth.size(), 0);
  graph.is_fixed[0] = 1;
  graph.edges.push_back({static_cast<int>(truth.size()) - 1, 0, truth.back().Inverse() * truth[0]});
  return graph;
}

double LargestError(const std::vector<Rigid3>& truth, const std::vector<Rigid3>& poses) {
  double largest = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    largest = std::max(largest, (truth[i].translation - poses[i].translation).norm());
  }
  return largest;
}

TEST(OptimizePoseGraph, ADriftedCircleIsClosed) {
  const std::vector<Rigid3> truth = Circle(100, 2);
  Vector6d error;
  error << 0, 0.003, 0, 0.003, 0, 0.001;  // A third of a radian and half a metre in all.
  const PoseGraph graph = DriftingCircle(truth, error);
  const double before = LargestError(truth, graph.T_world_node);
  ASSERT_GT(before, 0.3) << "the test drifts";
  const PoseGraphSolution solution = OptimizePoseGraph(graph);
  const double gap = (solution.T_world_node.back().translation - truth.back().translation).norm();
  EXPECT_LT(gap, 0.01) << "the ends meet";
  EXPECT_LT(LargestError(truth, solution.T_world_node), before / 4);
  EXPECT_LT(solution.final_cost, solution.initial_cost / 10);
  EXPECT_EQ(solution.T_world_node[0].ToMatrix(), truth[0].ToMatrix()) << "fixed";
}

TEST(OptimizePoseGraph, ConvergesToTheTruthFromFarAwayWhenTheEdgesAreExact) {
  const std::vector<Rigid3> truth = Circle(60, 3);
  PoseGraph graph = DriftingCircle(truth, Vector6d::Zero());
  for (int i = 0; i < 50; i += 7) {  // Chords too.
    graph.edges.push_back({i + 5, i, truth[i + 5].Inverse() * truth[i]});
  }
  Random random(3);
  for (std::size_t i = 1; i < truth.size(); ++i) {
    graph.T_world_node[i] = Retract(graph.T_world_node[i], RandomTwist(0.2, 0.5, random));
  }
  const PoseGraphSolution solution = OptimizePoseGraph(graph);
  EXPECT_LT(solution.final_cost, 1e-10);
  EXPECT_LT(LargestError(truth, solution.T_world_node), 1e-4);
}

TEST(OptimizePoseGraph, AHeavyEdgeGivesWayLess) {
  // Two edges between the same nodes contradict each other.
  PoseGraph graph{.T_world_node = {Rigid3(), Rigid3()}, .is_fixed = {1, 0}};
  graph.edges.push_back({0, 1, {Eigen::Quaterniond::Identity(), {1, 0, 0}}, 3});
  graph.edges.push_back({0, 1, {Eigen::Quaterniond::Identity(), {2, 0, 0}}, 1});
  EXPECT_NEAR(OptimizePoseGraph(graph).T_world_node[1].translation.x(), 1.25, 1e-6);
}

TEST(OptimizePoseGraph, NodesWithoutEdgesStayAndWithoutFixedNodesTheFirstDoes) {
  PoseGraph graph;
  graph.T_world_node = {Rigid3(), {Eigen::Quaterniond::Identity(), {1, 1, 1}}, Rigid3()};
  graph.is_fixed = {0, 0, 0};
  graph.edges.push_back({2, 0, {Eigen::Quaterniond::Identity(), {-1, 0, 0}}});
  const PoseGraphSolution solution = OptimizePoseGraph(graph);
  EXPECT_EQ(solution.T_world_node[0].ToMatrix(), Rigid3().ToMatrix());
  EXPECT_LT((solution.T_world_node[1].translation - Eigen::Vector3d(1, 1, 1)).norm(), 1e-12);
  EXPECT_LT((solution.T_world_node[2].translation - Eigen::Vector3d(1, 0, 0)).norm(), 1e-6);
  EXPECT_EQ(OptimizePoseGraph({}).T_world_node.size(), 0u);
}

TEST(OptimizePoseGraph, GivesTheSameBitsTwice) {
  const PoseGraph graph = DriftingCircle(Circle(80, 2), Vector6d::Constant(0.002));
  const PoseGraphSolution a = OptimizePoseGraph(graph);
  const PoseGraphSolution b = OptimizePoseGraph(graph);
  for (std::size_t i = 0; i < a.T_world_node.size(); ++i) {
    EXPECT_EQ(a.T_world_node[i].ToMatrix(), b.T_world_node[i].ToMatrix());
  }
}

TEST(OptimizePoseGraph, RefusesEdgesToNowhere) {
  PoseGraph graph{.T_world_node = {Rigid3(), Rigid3()}, .is_fixed = {1, 0}};
  graph.edges.push_back({0, 2, Rigid3()});
  EXPECT_THROW(OptimizePoseGraph(graph), std::logic_error);
  graph.edges = {{1, 1, Rigid3()}};
  EXPECT_THROW(OptimizePoseGraph(graph), std::logic_error);
  graph.edges = {{0, 1, Rigid3(), 0}};
  EXPECT_THROW(OptimizePoseGraph(graph), std::logic_error);
  graph.edges.clear();
  graph.is_fixed.clear();
  EXPECT_THROW(OptimizePoseGraph(graph), std::logic_error);
}

}  // namespace
}  // namespace semslam
