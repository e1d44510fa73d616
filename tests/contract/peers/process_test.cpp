// A library in another process: what crosses over, and that its crashes and its endless loops do not.
#include "contract/peers/peer_process.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace raywise::contract {
namespace {

using namespace std::chrono_literals;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// patience: long enough for a busy machine, but for the one test that waits for it to run out.
PeerProcess toy(std::chrono::milliseconds patience = 60s) {
    return {{RAYWISE_TOY_SERVER}, {patience}, "toy_server.log"};
}

std::vector<Mesh> one_mesh() {
    Mesh mesh;
    mesh.vertices = {{1.0, -0.0, nan}};
    mesh.triangles = {{0, 0, 0xFFFFFFFFu}};
    return {mesh};
}

Ray ray_from(double x) {
    Ray ray;
    ray.origin.x = x;
    ray.direction.z = 1.0;
    return ray;
}

std::string failure_of(Scene& scene, const Ray& ray) {
    try {
        scene.closest(ray);
    } catch (const std::exception& error) {
        return error.what();
    }
    return "none";
}

TEST(PeerProcess, TellsWhatTheLibraryTellsOfItself) {
    const PeerProcess peer = toy();
    EXPECT_EQ(peer.name(), "toy");
    EXPECT_EQ(peer.version(), "1.2.3");
    EXPECT_TRUE(peer.capabilities().has_any);
    EXPECT_TRUE(peer.capabilities().has_batch);
    EXPECT_FALSE(peer.capabilities().orders_ties);
    EXPECT_FALSE(peer.capabilities().decides_exactly);
    EXPECT_FALSE(peer.capabilities().counts_crossings);
    EXPECT_EQ(peer.capabilities().t_tolerance, 0.25);
}

TEST(PeerProcess, NumbersCrossBitForBit) {
    PeerProcess peer = toy();
    const auto meshes = one_mesh();
    const auto scene = peer.build(meshes);
    Ray ray = ray_from(0.0);
    ray.tmin = -std::numeric_limits<double>::infinity();
    const Answer answer = scene->closest(ray);
    EXPECT_TRUE(answer.hit);
    EXPECT_EQ(answer.t, ray.tmin);
    EXPECT_TRUE(answer.u == 0.0 && std::signbit(answer.u));
    EXPECT_TRUE(std::isnan(answer.v));
    EXPECT_EQ(answer.geometry, 1u);
    EXPECT_EQ(answer.primitive, 0xFFFFFFFFu);
}

TEST(PeerProcess, EveryCallIsAnswered) {
    PeerProcess peer = toy();
    const auto meshes = one_mesh();
    const auto scene = peer.build(meshes);
    EXPECT_FALSE(scene->closest(ray_from(6.0)).hit);
    EXPECT_TRUE(scene->any(ray_from(1.0)));
    EXPECT_FALSE(scene->any(ray_from(-1.0)));
    std::vector<Answer> answers;
    scene->all(ray_from(0.0), answers);
    EXPECT_EQ(answers.size(), 3u);
    scene->closest_batch({ray_from(0.0), ray_from(6.0)}, answers);
    ASSERT_EQ(answers.size(), 2u);
    EXPECT_TRUE(answers[0].hit);
    EXPECT_FALSE(answers[1].hit);
}

TEST(PeerProcess, ExceptionsCrossByKind) {
    PeerProcess peer = toy();
    try {
        peer.build({});
        FAIL() << "no refusal";
    } catch (const Refusal& refusal) {
        EXPECT_EQ(refusal.kind, "not-finite");
        EXPECT_STREQ(refusal.what(), "nothing\nat all");
    }
    const auto meshes = one_mesh();
    const auto scene = peer.build(meshes);
    EXPECT_THROW(scene->closest(ray_from(1.0)), Inexpressible);
    EXPECT_THROW(scene->closest(ray_from(2.0)), PeerFailure);
    EXPECT_EQ(failure_of(*scene, ray_from(2.0)), "error: it went wrong");
    EXPECT_TRUE(scene->closest(ray_from(0.0)).hit) << "the process goes on";
}

TEST(PeerProcess, ACrashIsNamedAndTheNextSceneWorks) {
    PeerProcess peer = toy();
    const auto meshes = one_mesh();
    const auto scene = peer.build(meshes);
    EXPECT_EQ(failure_of(*scene, ray_from(3.0)),
              std::string("crashed: ") + strsignal(SIGABRT) + " (Assertion `true' failed.)");
    EXPECT_THROW(scene->closest(ray_from(0.0)), ChildLost) << "the old scene is gone";
    EXPECT_TRUE(peer.build(meshes)->closest(ray_from(0.0)).hit);
}

TEST(PeerProcess, AnExitIsNamed) {
    PeerProcess peer = toy();
    const auto meshes = one_mesh();
    EXPECT_EQ(failure_of(*peer.build(meshes), ray_from(5.0)), "the process ended with status 9");
}

TEST(PeerProcess, AnEndlessLoopIsEnded) {
    PeerProcess peer = toy(2s);
    const auto meshes = one_mesh();
    EXPECT_EQ(failure_of(*peer.build(meshes), ray_from(4.0)), "no answer within the time limit");
    EXPECT_TRUE(peer.build(meshes)->closest(ray_from(0.0)).hit);
}

TEST(PeerProcess, AMeshLargerThanThePipeArrives) {
    PeerProcess peer = toy();
    auto meshes = one_mesh();
    meshes[0].vertices.resize(100'000, Vec3(1.0));
    EXPECT_TRUE(peer.build(meshes)->closest(ray_from(0.0)).hit);
}

TEST(PeerProcess, AProgramThatIsNotThereIsAnError) {
    EXPECT_THROW(PeerProcess({"/no/such/program"}, {60s}, "toy_server.log"), ChildLost);
}

} // namespace
} // namespace raywise::contract
