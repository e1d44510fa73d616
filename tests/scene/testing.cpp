#include "scene/testing.h"

#include <gtest/gtest.h>

#include <cstring>
#include <random>
#include <utility>

namespace raywise::testing {

TriangleArrays Soup::arrays() const {
    TriangleArrays arrays;
    arrays.vertices = {reinterpret_cast<const std::byte*>(vertices.data()), 12, 4, Scalar::float32};
    arrays.vertex_count = vertices.size() / 3;
    arrays.triangle_count = vertices.size() / 9;
    return arrays;
}

Soup make_soup(std::uint32_t triangles, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> center(-0.9f, 0.9f);
    std::uniform_real_distribution<float> offset(-0.1f, 0.1f);
    Soup soup;
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const float c[3] = {center(random), center(random), center(random)};
        for (int k = 0; k < 9; ++k) soup.vertices.push_back(c[k % 3] + offset(random));
    }
    return soup;
}

Progress::Callback expect_within_ends(double& last) {
    return [&last](double fraction, const char* stage) {
        EXPECT_GE(fraction, 0.0);
        EXPECT_LE(fraction, 1.0);
        EXPECT_NE(stage, nullptr);
        last = fraction;
        return false;
    };
}

std::vector<Ray> make_chords(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    const auto on_sphere = [&] { return 2.0 * glm::normalize(Vec3(normal(random), normal(random), normal(random))); };
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        ray.origin = on_sphere();
        ray.direction = on_sphere() - ray.origin;
    }
    return rays;
}

std::shared_ptr<const Profile> make_profile(const std::function<void(MachineConstants&)>& change) {
    Profile profile = generic_profile();
    for (const Structure structure : all_structures()) profile.constants.structures[structure] = {};
    change(profile.constants);
    return std::make_shared<const Profile>(std::move(profile));
}

std::shared_ptr<Scene> make_scene(const Soup& soup, std::shared_ptr<const Profile> profile,
                                  const std::function<void(Scene&)>& prepare) {
    auto scene = std::make_shared<Scene>(std::move(profile));
    scene->add_triangles(soup.arrays(), true, false);
    if (prepare) prepare(*scene);
    Progress progress;
    scene->commit(Parallel(1), progress);
    return scene;
}

bool same_bits(const Hit& a, const Hit& b) {
    return std::memcmp(&a.t, &b.t, sizeof a.t) == 0 && std::memcmp(&a.u, &b.u, sizeof a.u) == 0 &&
           std::memcmp(&a.v, &b.v, sizeof a.v) == 0 && a.instance == b.instance && a.geometry == b.geometry &&
           a.primitive == b.primitive;
}

} // namespace raywise::testing
