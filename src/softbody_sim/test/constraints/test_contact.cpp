#include <gtest/gtest.h>

#include "constraints/contact_detection.h"
#include "constraints/target_energy.h"
#include "fem/fem_elasticity.h"
#include "fixtures/test_meshes.h"

namespace softbody {
namespace {

using testing::randomPoints;

std::vector<Obstacle> someObstacles() {
  return {Obstacle::plane(), Obstacle::sphere(0.02), Obstacle::capsule(0.01, 0.05),
          Obstacle::box({0.04, 0.06, 0.02}, 0.004)};
}

TEST(Obstacle, NormalIsTheGradientOfTheDistanceAndPointsToTheSurface) {
  std::mt19937 random(1);
  for (const Obstacle& obstacle : someObstacles()) {
    for (int k = 0; k < 200; ++k) {
      const Eigen::Vector3d point = randomPoints(1, 0.06, &random).transpose();
      const SurfaceDistance surface = distanceTo(obstacle, point);
      EXPECT_NEAR(surface.normal.norm(), 1.0, 1e-12);
      EXPECT_NEAR(distanceTo(obstacle, point - surface.distance * surface.normal).distance, 0.0, 1e-12);
      const Eigen::Vector3d move = 1e-8 * randomPoints(1, 1.0, &random).transpose();
      const double change = distanceTo(obstacle, point + move).distance - surface.distance;
      EXPECT_NEAR(change, surface.normal.dot(move), 1e-13);
    }
  }
  EXPECT_THROW(Obstacle::box({0.1, 0.1, 0.1}, 0.06), std::invalid_argument);
}

TEST(ContactPoints, CoverTheWholeSurface) {
  const TetTopology topology = testing::sponge();
  for (double spacing : {1.0, 0.01, 0.004}) {
    const std::vector<ContactPoint> points = sampleContactPoints(topology, spacing);
    double area = 0.0;
    std::vector<int> vertices;
    for (const ContactPoint& point : points) {
      area += point.area;
      EXPECT_NEAR(point.place.barycentric.sum(), 1.0, 1e-12);
      EXPECT_GE(point.place.barycentric.minCoeff(), 0.0);
      Eigen::Index k = 0;
      if (point.place.barycentric.maxCoeff(&k) > 1.0 - 1e-12)
        vertices.push_back(topology.tets(point.place.tet, k));
    }
    EXPECT_NEAR(area, 2.0 * (0.2 * 0.1 + 0.1 * 0.03 + 0.2 * 0.03), 1e-12);
    std::sort(vertices.begin(), vertices.end());
    EXPECT_TRUE(std::adjacent_find(vertices.begin(), vertices.end()) == vertices.end());
    EXPECT_EQ(vertices.size(), 132u);
  }
}

TEST(FindContacts, StopsAPointBeforeAnObstacleThatPassedThroughIt) {
  const TetTopology topology = testing::sponge();
  const std::vector<ContactPoint> points = sampleContactPoints(topology, 0.02);
  Obstacle ball = Obstacle::sphere(0.003);
  for (const ContactPoint& point : points) {
    const Eigen::Vector3d place = positionOf(point.place, topology.rest_vertices, topology.tets);
    const Eigen::Isometry3d before(Eigen::Translation3d(place + Eigen::Vector3d(0.05, 0.0, 0.0)));
    ball.pose = Eigen::Translation3d(place - Eigen::Vector3d(0.05, 0.0, 0.0));
    std::vector<Contact> contacts;
    findContacts({point}, topology.tets, topology.rest_vertices, topology.rest_vertices, {ball}, {before},
                 0.001, &contacts);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_LT((contacts[0].normal + Eigen::Vector3d::UnitX()).norm(), 1e-6);
    EXPECT_LT((contacts[0].position - (ball.pose.translation() - 0.003 * Eigen::Vector3d::UnitX())).norm(),
              1e-6);
  }
}

/// The contacts of one point of the sponge with an obstacle that has moved, in the frame of the point at the
/// end.
std::vector<Contact> contactsOfPath(Obstacle obstacle, const Eigen::Vector3d& from,
                                    const Eigen::Vector3d& to) {
  const TetTopology topology = testing::sponge();
  const ContactPoint point = sampleContactPoints(topology, 0.02).front();
  const Eigen::Vector3d place = positionOf(point.place, topology.rest_vertices, topology.tets);
  obstacle.pose = Eigen::Translation3d(place - to);
  std::vector<Contact> contacts;
  findContacts({point}, topology.tets, topology.rest_vertices, topology.rest_vertices, {obstacle},
               {Eigen::Isometry3d(Eigen::Translation3d(place - from))}, 0.001, &contacts);
  return contacts;
}

TEST(FindContacts, StopsAPointThatABallGrazes) {
  for (const double share : {0.1, 0.5, 0.8, 0.99}) {
    const double radius = 0.01, height = share * radius, half = radius * std::sqrt(1.0 - share * share);
    const auto contacts = contactsOfPath(Obstacle::sphere(radius), {0.05, 0.0, height}, {-0.05, 0.0, height});
    ASSERT_EQ(contacts.size(), 1u) << share;
    EXPECT_LT((contacts[0].normal - Eigen::Vector3d(half, 0.0, height) / radius).norm(), 1e-4) << share;
  }
}

TEST(FindContacts, FollowsAPointThatSlidesRoundAnObstacle) {
  const double radius = 0.01, depth = 1e-4;
  for (const double angle : {0.1, 0.4, 0.8}) {
    const Eigen::Vector3d normal(std::cos(angle), std::sin(angle), 0.0);
    const auto contacts =
        contactsOfPath(Obstacle::sphere(radius), {radius + depth, 0.0, 0.0}, (radius - depth) * normal);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_LT((contacts[0].normal - normal).norm(), 1e-9);
  }
}

TEST(FindContacts, KeepsAPointOnItsSideOfAPlate) {
  const Obstacle plate = Obstacle::box({0.1, 0.1, 0.004}, 0.0);
  for (const double start : {0.003, 0.0015}) {  // outside and inside
    for (const double end : {0.0005, -0.0005, -0.003}) {
      const auto contacts = contactsOfPath(plate, {0.0, 0.0, start}, {0.001, 0.0, end});
      ASSERT_EQ(contacts.size(), 1u);
      EXPECT_LT((contacts[0].normal - Eigen::Vector3d::UnitZ()).norm(), 1e-9) << start << ", " << end;
    }
  }
}

TEST(KeepEarlierContacts, AddsContactsThatWereNotFoundAgainInOrder) {
  const auto contact = [](int obstacle, int point, double height) {
    return Contact{point, obstacle, Eigen::Vector3d(0.0, 0.0, height), Eigen::Vector3d::UnitZ()};
  };
  std::vector<Contact> now{contact(0, 3, 1.0), contact(1, 2, 1.0)};
  keepEarlierContacts({contact(0, 1, 2.0), contact(0, 3, 2.0), contact(1, 0, 2.0), contact(2, 9, 2.0)}, &now);
  ASSERT_EQ(now.size(), 5u);
  EXPECT_TRUE(std::is_sorted(now.begin(), now.end(), isOrderedBefore));
  for (const Contact& found : now) {
    const bool again = found.point == 3 || found.point == 2;
    EXPECT_EQ(found.position.z(), again ? 1.0 : 2.0) << found.obstacle << ", " << found.point;
  }
}

/// Of contacts and their friction.
TEST(ContactSprings, GradientAndHessianMatchDifferences) {
  const TetTopology topology = testing::boxTopology({2, 2, 1}, {0.04, 0.04, 0.02});
  std::mt19937 random(5);
  TargetEnergy springs;
  for (const ContactPoint& point : sampleContactPoints(topology, 0.015)) {
    springs.addOneSided(point.place, topology.tets, randomPoints(1, 0.03, &random).transpose(),
                        randomPoints(1, 1.0, &random).transpose(), 300.0);
    springs.addFriction(point.place, topology.tets, randomPoints(1, 0.03, &random).transpose(),
                        randomPoints(1, 1.0, &random).transpose(), 300.0, 300.0 * 0.03);  // some slide
  }
  const Points& x = topology.rest_vertices;
  const auto gradientAt = [&](const Points& at) {
    Points gradient = Points::Zero(at.rows(), 3);
    springs.addTo(at, &gradient);
    return gradient;
  };
  const auto valueAt = [&](const Points& at) {
    Points unused = Points::Zero(at.rows(), 3);
    return springs.addTo(at, &unused);
  };
  BlockTetMatrix hessian(FemElasticity(topology, Elasticity::kCorotated, {1.0, 1.0}).groups(), x.rows());
  springs.addHessian(x, &hessian);
  EXPECT_GT(valueAt(x), 0.0);
  for (int k = 0; k < 10; ++k) {
    const Points move = 1e-7 * randomPoints(x.rows(), 1.0, &random);
    EXPECT_NEAR((valueAt(x + move) - valueAt(x - move)) / 2.0, gradientAt(x).cwiseProduct(move).sum(), 1e-14);
    const Points difference = (gradientAt(x + move) - gradientAt(x - move)) / 2.0;
    const Eigen::VectorXd product = hessian.lower().selfadjointView<Eigen::Lower>() *
                                    Eigen::Map<const Eigen::VectorXd>(move.data(), move.size());
    EXPECT_LT((Eigen::Map<const Eigen::VectorXd>(difference.data(), difference.size()) - product).norm(),
              1e-6 * product.norm());
  }
}

}  // namespace
}  // namespace softbody
