// The answers of every structure as one line of hexadecimal digits for each scene: equal lines, equal bits.
#include "isa/digest.h"

#include "accel/accel.h"
#include "isa/inputs.h"

#include <algorithm>
#include <cinttypes>
#include <cstring>
#include <exception>
#include <fstream>
#include <string_view>

namespace raywise::isa {
namespace {

// FNV-1a, 64 bits: the same number on every machine.
class Digest {
public:
    void add(const void* data, std::size_t bytes) {
        const auto* byte = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < bytes; ++i) value_ = (value_ ^ byte[i]) * 0x100000001B3u;
    }
    void add(double x) { add(&x, sizeof x); }
    void add(std::uint32_t x) { add(&x, sizeof x); }
    void add(const Vec3& v) {
        for (int axis = 0; axis < 3; ++axis) add(v[axis]);
    }
    std::uint64_t value() const { return value_; }

private:
    std::uint64_t value_ = 0xCBF29CE484222325u;
};

// Where the lines go to and what they are compared with.
class Lines {
public:
    explicit Lines(const digest_options& options) {
        if (options.output != nullptr) open(output_, options.output);
        if (options.expect != nullptr) open(expected_, options.expect);
    }

    void add(const std::string& line) {
        if (output_.is_open()) output_ << line << '\n';
        ++count_;
        std::string expected;
        if (!expected_.is_open() || differs_) return;
        if (!std::getline(expected_, expected)) expected = "(no further line)";
        compare(line, expected);
    }

    // Whether all went well.
    bool finish() {
        std::string expected;
        if (expected_.is_open() && !differs_ && std::getline(expected_, expected))
            compare("(no further line)", expected);
        if (output_.is_open()) {
            output_.close();
            if (!output_) throw std::runtime_error("the output cannot be written");
        }
        std::printf("%zu lines%s\n", count_, differs_ ? "" : expected_.is_open() ? ", all as expected" : "");
        return !differs_;
    }

private:
    template <class Stream>
    static void open(Stream& stream, const char* path) {
        stream.open(path);
        if (!stream) throw std::runtime_error(std::string(path) + " cannot be opened");
    }
    void compare(const std::string& line, const std::string& expected) {
        if (line == expected) return;
        differs_ = true;
        std::fprintf(stderr, "the first line that differs is %zu\n  expected: %s\n  instead:  %s\n", count_,
                     expected.c_str(), line.c_str());
    }

    std::ofstream output_;
    std::ifstream expected_;
    std::size_t count_ = 0;
    bool differs_ = false;
};

bool fits_float32(const InputScene& scene) {
    return std::all_of(scene.vertices.begin(), scene.vertices.end(), [](const auto& vertex) {
        return std::all_of(vertex.begin(), vertex.end(),
                           [](double x) { return static_cast<double>(static_cast<float>(x)) == x; });
    });
}

// As float32 where that holds the numbers, so that both ways of reading a vertex are run.
Primitives primitives_of(const InputScene& scene) {
    std::vector<float> floats;
    TriangleArrays arrays;
    arrays.vertex_count = scene.vertices.size();
    arrays.triangle_count = scene.triangles.size();
    if (fits_float32(scene)) {
        for (const auto& vertex : scene.vertices) {
            for (const double x : vertex) floats.push_back(static_cast<float>(x));
        }
        arrays.vertices = {reinterpret_cast<const std::byte*>(floats.data()), 3 * sizeof(float), sizeof(float),
                           Scalar::float32};
    } else {
        arrays.vertices = {reinterpret_cast<const std::byte*>(scene.vertices.data()), 3 * sizeof(double),
                           sizeof(double), Scalar::float64};
    }
    static const std::byte none{};
    const void* indices = scene.triangles.empty() ? &none : static_cast<const void*>(scene.triangles.data());
    arrays.indices = {static_cast<const std::byte*>(indices), 3 * sizeof(std::uint32_t), sizeof(std::uint32_t),
                      Scalar::uint32};
    return Primitives({std::make_shared<const TriangleMesh>(arrays, true, false)});
}

Vec3 vector_of(const double (&numbers)[3]) { return {numbers[0], numbers[1], numbers[2]}; }

// One structure over one scene, asked everything.
class Asked {
public:
    Asked(const Primitives& primitives, Structure structure, const InputView* view) : primitives_(primitives) {
        std::optional<ViewFrame> frame;
        if (view != nullptr) {
            frame = ViewFrame{view->along_direction != 0 ? ViewFrame::Kind::direction : ViewFrame::Kind::point,
                              vector_of(view->origin), vector_of(view->direction), view->half_angle};
        }
        accel_ = build(structure, BuildInput{primitives, {}, frame, parallel_, progress_});
    }

    void ask(const InputRay& ray, Digest& digest) {
        const Ray asked{vector_of(ray.origin), ray.tmin, vector_of(ray.direction), ray.tmax};
        add(accel_->closest(asked, {}), digest);
        digest.add(accel_->any(asked, {}) ? 1u : 0u);
        hits_.clear();
        accel_->all(asked, {}, hits_);
        std::sort(hits_.begin(), hits_.end());
        digest.add(static_cast<std::uint32_t>(hits_.size()));
        for (const PrimitiveHit& hit : hits_) add(hit, digest);
        hit_count_ += hits_.size();
    }
    // The same rays together, as they are in batches.
    void ask_many(const std::vector<InputRay>& inputs, Digest& digest) {
        std::vector<Ray> rays;
        for (const InputRay& ray : inputs)
            rays.push_back({vector_of(ray.origin), ray.tmin, vector_of(ray.direction), ray.tmax});
        std::vector<PrimitiveHit> hits(rays.size());
        const auto found = std::make_unique<bool[]>(rays.size());
        const RayPacket all{rays.data(), nullptr, rays.size()};
        Scratch scratch;
        accel_->closest_many(all, hits.data(), scratch);
        accel_->any_many(all, found.get(), scratch);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            if (hits[i].is_hit()) add(hits[i], digest);
            digest.add(found[i] ? 1u : 0u);
            hit_count_ += hits[i].is_hit() ? 1 : 0;
        }
    }
    std::size_t hit_count() const { return hit_count_; }

private:
    void add(const PrimitiveHit& hit, Digest& digest) const {
        digest.add(hit.primitive);
        if (!hit.is_hit()) return;
        digest.add(hit.t);
        digest.add(hit.u);
        digest.add(hit.v);
        digest.add(unit_normal(primitives_.corners(hit.primitive)));
    }

    const Primitives& primitives_;
    Parallel parallel_{1};
    Progress progress_;
    std::unique_ptr<Accel> accel_;
    std::vector<PrimitiveHit> hits_;
    std::size_t hit_count_ = 0;
};

std::string line_of(const std::string& what, std::size_t hits, const Digest& digest) {
    char text[64];
    std::snprintf(text, sizeof text, " | %zu hits | %016" PRIx64, hits, digest.value());
    return what + text;
}

void ask_all(const InputScene& scene, const Primitives& primitives, Structure structure, const InputView* view,
             bool each_ray, Lines& lines) {
    const std::string what = scene.name + " | " + name_of(structure) +
                             (view == nullptr              ? ""
                              : view->along_direction != 0 ? " along a direction"
                                                           : " from a point");
    Asked asked(primitives, structure, view);
    Digest digest;
    for (std::size_t i = 0; i < scene.rays.size(); ++i) {
        if (!each_ray) {
            asked.ask(scene.rays[i], digest);
            continue;
        }
        Digest of_ray;
        const std::size_t before = asked.hit_count();
        asked.ask(scene.rays[i], of_ray);
        lines.add(line_of(what + " | ray " + std::to_string(i), asked.hit_count() - before, of_ray));
    }
    if (!each_ray) lines.add(line_of(what, asked.hit_count(), digest));
    Digest of_many;
    const std::size_t before = asked.hit_count();
    asked.ask_many(scene.rays, of_many);
    lines.add(line_of(what + " | many", asked.hit_count() - before, of_many));
}

bool is_projected(Structure structure) {
    constexpr std::string_view prefix = "projected_";
    return std::string_view(name_of(structure)).substr(0, prefix.size()) == prefix;
}

bool run(const digest_options& options) {
    InputFile file(options.inputs, "rb");
    Lines lines(options);
    for (InputScene scene; file.read(scene);) {
        const Primitives primitives = primitives_of(scene);
        for (const Structure structure : all_structures()) {
            ask_all(scene, primitives, structure, nullptr, options.each_ray != 0, lines);
            if (!is_projected(structure)) continue;
            for (const InputView& view : scene.views) {
                ask_all(scene, primitives, structure, &view, options.each_ray != 0, lines);
            }
        }
    }
    return lines.finish();
}

} // namespace
} // namespace raywise::isa

int run_digest(const digest_options* options) {
    try {
        return raywise::isa::run(*options) ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
