#include "bench/scenes/nff.h"

#include "bench/scenes/polygon.h"
#include "scenes/shapes.h"

#include <fstream>
#include <sstream>
#include <stdexcept>

namespace raywise::bench {
namespace {

using workloads::Mesh;

constexpr std::uint64_t triangles_of_sphere = 80;
constexpr std::uint32_t sides_of_cone = 20;
constexpr double degree = 0.017453292519943295;

class Reader {
public:
    explicit Reader(const std::string& path) : path_(path), file_(path) {
        if (!file_) throw std::runtime_error(path + " cannot be read");
    }

    Mesh read(std::vector<std::uint32_t>* primitive_of) {
        std::string line;
        std::uint32_t primitives = 0;
        while (next(line)) {
            const std::uint64_t before = mesh_.triangle_count();
            std::istringstream words(line);
            std::string word;
            words >> word;
            if (word == "from")
                camera_.eye = vector(words);
            else if (word == "at")
                camera_.target = vector(words);
            else if (word == "angle")
                camera_.vertical_angle = degree * number(words);
            else if (word == "l")
                light(words);
            else if (word == "p" || word == "pp")
                polygon(words, word == "pp");
            else if (word == "s")
                sphere(words);
            else if (word == "c")
                cone(words);
            else if (word != "b" && word != "v" && word != "up" && word != "hither" && word != "resolution" &&
                     word != "f")
                fail("'" + word + "' is not known");
            if (primitive_of == nullptr || mesh_.triangle_count() == before) continue;
            primitive_of->resize(mesh_.triangle_count(), primitives++);
        }
        mesh_.camera = camera_;
        return std::move(mesh_);
    }

private:
    [[noreturn]] void fail(const std::string& what) const {
        throw std::runtime_error(path_ + ", line " + std::to_string(line_) + ": " + what);
    }

    bool next(std::string& line) {
        while (std::getline(file_, line)) {
            ++line_;
            if (line.find_first_not_of(" \t\r") != std::string::npos && line[0] != '#') return true;
        }
        return false;
    }

    double number(std::istream& words) const {
        double value = 0.0;
        if (!(words >> value)) fail("a number is missing");
        return value;
    }

    Vec3 vector(std::istream& words) const {
        const double x = number(words), y = number(words), z = number(words);
        return {x, y, z};
    }

    void light(std::istream& words) {
        const Vec3 place = vector(words);
        if (!mesh_.light) mesh_.light = place;
    }

    void polygon(std::istream& words, bool with_normals) {
        const double count = number(words);
        if (!(count >= 3.0 && count <= 1e6)) fail("no such polygon");
        std::vector<Vec3> corners;
        std::string line;
        while (corners.size() < static_cast<std::size_t>(count)) {
            if (!next(line)) fail("a polygon breaks off");
            std::istringstream corner(line);
            corners.push_back(vector(corner));
            if (with_normals) vector(corner);
        }
        std::uint32_t first = 0;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const std::uint32_t vertex = workloads::add_vertex(mesh_, corners[i]);
            if (i == 0) first = vertex;
        }
        for (const auto& triangle : triangulate(corners))
            workloads::add_triangle(mesh_, first + triangle[0], first + triangle[1], first + triangle[2]);
    }

    void sphere(std::istream& words) {
        const Vec3 centre = vector(words);
        workloads::add_sphere(mesh_, centre, number(words), triangles_of_sphere);
    }

    void cone(std::istream& words) {
        const Vec3 base = vector(words);
        const double base_radius = number(words);
        const Vec3 apex = vector(words);
        const double apex_radius = number(words);
        const Vec3 axis = apex - base;
        const double length = std::sqrt(glm::dot(axis, axis));
        if (!(length > 0.0)) fail("a cone without length");
        const workloads::Frame frame(axis / length);
        std::uint32_t first = 0;
        for (std::uint32_t i = 0; i < sides_of_cone; ++i) {
            const Vec2 around = workloads::on_circle(static_cast<double>(i) / sides_of_cone);
            const Vec3 out = frame * Vec3(around, 0.0);
            const std::uint32_t vertex = workloads::add_vertex(mesh_, base + out * base_radius);
            if (i == 0) first = vertex;
            workloads::add_vertex(mesh_, apex + out * apex_radius);
        }
        for (std::uint32_t i = 0; i < sides_of_cone; ++i) {
            const std::uint32_t a = first + 2 * i, b = first + 2 * ((i + 1) % sides_of_cone);
            workloads::add_triangle(mesh_, a, b, b + 1);
            workloads::add_triangle(mesh_, a, b + 1, a + 1);
        }
    }

    std::string path_;
    std::ifstream file_;
    std::size_t line_ = 0;
    Mesh mesh_;
    workloads::Camera camera_{Vec3(0.0), Vec3(0.0), 0.7};
};

} // namespace

Mesh load_nff(const std::string& path, std::vector<std::uint32_t>* primitive_of) {
    return Reader(path).read(primitive_of);
}

} // namespace raywise::bench
