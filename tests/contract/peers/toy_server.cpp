// A made-up library for process_test.cpp, which does what a ray's origin asks for.
#include "contract/peers/server.h"

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <thread>

#include <unistd.h>

namespace raywise::contract {
namespace {

class ToyScene : public Scene {
public:
    explicit ToyScene(const std::vector<Mesh>& meshes) : meshes_(meshes) {}

    // A hit at tmin, with the first vertex's y and z as u and v.
    Answer closest(const Ray& ray) override {
        if (ray.origin.x == 1.0) throw Inexpressible("no words for it");
        if (ray.origin.x == 2.0) throw std::runtime_error("it went wrong");
        if (ray.origin.x == 3.0) {
            std::fputs("toy.cpp:1: the toy: Assertion `true' failed.\n", stderr);
            std::abort();
        }
        if (ray.origin.x == 4.0) std::this_thread::sleep_for(std::chrono::hours(1));
        if (ray.origin.x == 5.0) std::_Exit(9);
        Answer answer;
        if (ray.origin.x == 6.0) return answer;
        answer.hit = true;
        answer.t = ray.tmin;
        answer.u = meshes_.at(0).vertices.at(0).y;
        answer.v = meshes_.at(0).vertices.at(0).z;
        answer.geometry = static_cast<std::uint32_t>(meshes_.size());
        answer.primitive = meshes_.at(0).triangles.at(0)[2];
        return answer;
    }
    bool any(const Ray& ray) override { return ray.origin.x > 0.0; }
    void all(const Ray& ray, std::vector<Answer>& answers) override { answers.assign(3, closest(ray)); }
    void closest_batch(const std::vector<Ray>& rays, std::vector<Answer>& answers) override {
        answers.clear();
        for (const Ray& ray : rays) answers.push_back(closest(ray));
    }

private:
    const std::vector<Mesh>& meshes_;
};

class Toy : public Library {
public:
    std::string name() const override { return "toy"; }
    Capabilities capabilities() const override {
        Capabilities capabilities;
        capabilities.has_batch = true;
        capabilities.orders_ties = false;
        capabilities.decides_exactly = false;
        capabilities.counts_crossings = false;
        capabilities.t_tolerance = 0.25;
        return capabilities;
    }
    std::unique_ptr<Scene> build(const std::vector<Mesh>& meshes) override {
        if (meshes.empty()) throw Refusal("not-finite", "nothing\nat all");
        return std::make_unique<ToyScene>(meshes);
    }
};

} // namespace
} // namespace raywise::contract

int main() {
    raywise::contract::Toy toy;
    raywise::contract::serve(toy, "1.2.3", STDIN_FILENO, STDOUT_FILENO);
}
