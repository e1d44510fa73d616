// One call of every kind the library has, with right answers known: for tests of what is left behind when very many are made.
#pragma once

#include "testing.h"

#include <functional>
#include <string>
#include <vector>

// Files to load, in a folder of their own that is deleted with the object.
class CallFiles {
public:
    CallFiles();
    ~CallFiles();
    CallFiles(const CallFiles&) = delete;
    CallFiles& operator=(const CallFiles&) = delete;

    const std::vector<std::string>& meshes() const { return meshes_; }
    const std::string& profile() const { return profile_; }

private:
    std::string write(const char* name, const std::string& text);

    std::string folder_;
    std::vector<std::string> meshes_;
    std::string profile_;
};

// What one thread of the host asks, and where the answers go.
class Caller {
public:
    // Made with the caller's thread alone.
    Caller(const CallFiles& files, uint64_t triangles, uint64_t rays);
    ~Caller();
    Caller(const Caller&) = delete;
    Caller& operator=(const Caller&) = delete;

    // Each makes one call, or one of each function that makes, fills and releases a handle, on at most so many threads of the
    // library (0: as many as it likes); false when a status or an answer is not what it is to be.
    bool batch_closest(uint32_t threads);
    bool batch_any(uint32_t threads);
    bool batch_all(uint32_t threads);
    bool batch_of_view(uint32_t threads);
    bool single_closest(uint32_t);
    bool single_any(uint32_t);
    bool single_all(uint32_t);
    bool single_with_skips(uint32_t);
    bool commit(const char* structure, int32_t effort, uint32_t threads);
    bool refit(uint32_t threads);
    bool view(uint32_t threads);
    bool once_closest(uint32_t threads);
    bool once_any(uint32_t threads);
    bool load_profile(uint32_t);
    bool load_mesh(const std::string& path);
    bool explain(uint32_t);
    bool fail(uint32_t);

private:
    bool batch_closest_of(const rw_scene* scene, uint32_t threads);
    bool hits_are_right() const;
    bool flags_are_right() const;
    const rw_ray& next_ray();
    const rw_hit& right_hit() const; // of the ray next_ray() gave last

    const CallFiles& files_;
    soup soup_;
    rw_triangles mesh_;
    rw_scene* scene_ = nullptr;
    rw_scene* view_ = nullptr;
    std::vector<rw_ray> rays_;
    std::vector<rw_hit> right_; // from single calls, of a linear scan
    size_t next_ = 0;
    rw_rays batch_;
    std::vector<double> t_;
    std::vector<uint8_t> flags_;
    std::vector<uint64_t> offsets_;
    std::vector<char> text_;
};

struct Call {
    std::string name;
    long weight; // how many are made of it in a short test, so that all take about the same time
    std::function<bool(Caller&, uint32_t threads)> make;
};

// All kinds.
std::vector<Call> all_calls(const CallFiles& files);
