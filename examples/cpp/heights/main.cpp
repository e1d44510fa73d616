// A C++ program that links libraywise: heights of a wavy sheet, asked with one vertical ray per point of a finer
// lattice, all in one batch, and compared with the sheet's own formula.
//
// Exit code: 0 right answers, 1 wrong ones, 2 a failing call.
#include <raywise/raywise.h>

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

void check(std::int32_t status) {
    if (status != RW_OK) throw std::runtime_error(std::string(rw_status_text(status)) + ": " + rw_last_error_message());
}

// A scene that gives itself back.
struct Release {
    void operator()(rw_scene* scene) const { rw_scene_release(scene); }
};
using Scene = std::unique_ptr<rw_scene, Release>;

Scene create_scene() {
    rw_scene* scene = nullptr;
    check(rw_scene_create(nullptr, &scene));
    return Scene(scene);
}

// A sheet that is bent along x only: between two columns of vertices it is a plane, so its height there is no secret.
constexpr int columns = 64;
constexpr int rows = 16;

double column_height(int column) { return std::sin(0.2 * column); }

struct Sheet {
    std::vector<float> vertices;
    std::vector<std::uint32_t> indices;
};

Sheet make_sheet() {
    Sheet sheet;
    for (int y = 0; y <= rows; ++y) {
        for (int x = 0; x <= columns; ++x) {
            const double vertex[] = {double(x), double(y), column_height(x)};
            for (const double value : vertex) sheet.vertices.push_back(static_cast<float>(value));
        }
    }
    for (std::uint32_t y = 0; y < rows; ++y) {
        for (std::uint32_t x = 0; x < columns; ++x) {
            const std::uint32_t a = y * (columns + 1) + x, b = a + 1, c = a + columns + 1, d = c + 1;
            for (const std::uint32_t corner : {a, b, d, a, d, c}) sheet.indices.push_back(corner);
        }
    }
    return sheet;
}

int count_wrong() {
    const Sheet sheet = make_sheet();
    rw_triangles triangles{};
    triangles.struct_size = sizeof triangles;
    triangles.vertex_count = sheet.vertices.size() / 3;
    triangles.vertices.data = sheet.vertices.data();
    triangles.triangle_count = sheet.indices.size() / 3;
    triangles.indices.data = sheet.indices.data();

    // Four rays a square, and one column of rays that misses the sheet on each side.
    std::vector<double> origins;
    for (int y = 0; y < 2 * rows; ++y) {
        for (int x = -1; x <= 2 * columns; ++x) {
            for (const double value : {0.5 * x + 0.25, 0.5 * y + 0.25, 10.0}) origins.push_back(value);
        }
    }
    const std::size_t count = origins.size() / 3;

    Scene scene = create_scene();
    check(rw_scene_add_triangles(scene.get(), &triangles, nullptr));
    rw_expected_rays expected{};
    expected.struct_size = sizeof expected;
    expected.count = count;
    check(rw_scene_set_expected_rays(scene.get(), &expected));
    check(rw_scene_commit(scene.get(), nullptr));

    const double down[3] = {0.0, 0.0, -1.0};
    rw_rays rays{};
    rays.struct_size = sizeof rays;
    rays.count = count;
    rays.origin.data = origins.data();
    rays.origin.type = RW_FLOAT64;
    rays.direction.data = down;
    rays.direction.stride = RW_REPEAT; // one direction for all
    rays.direction.type = RW_FLOAT64;
    std::vector<double> t(count);
    rw_hits hits{};
    hits.struct_size = sizeof hits;
    hits.t.data = t.data();
    hits.t.type = RW_FLOAT64;
    check(rw_scene_intersect_batch(scene.get(), &rays, &hits, nullptr));

    int wrong = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = origins[3 * i];
        double right = std::numeric_limits<double>::infinity();
        if (x > 0.0 && x < columns) {
            const int column = static_cast<int>(x);
            const double within = x - column;
            right = 10.0 - ((1.0 - within) * column_height(column) + within * column_height(column + 1));
        }
        // The vertices were rounded to float32, which moves a height of 1 by less than 1e-7.
        const bool same = std::isinf(right) ? std::isinf(t[i]) : std::fabs(t[i] - right) < 1e-6;
        wrong += same ? 0 : 1;
    }

    rw_scene_statistics statistics{};
    statistics.struct_size = sizeof statistics;
    check(rw_scene_get_statistics(scene.get(), &statistics));
    std::printf("%zu rays on %s, %d wrong\n", count, statistics.structure, wrong);
    return wrong;
}

} // namespace

int main() {
    try {
        return count_wrong() == 0 ? 0 : 1;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "heights: %s\n", error.what());
        return 2;
    }
}
