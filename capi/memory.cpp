// Memory that is kept for scenes to come.
#include "base/page_pool.h"
#include "guard.h"
#include "handles.h"
#include "raywise/raywise.h"

using namespace raywise::capi;

extern "C" {

std::int32_t rw_memory_keep(std::uint64_t bytes) {
    return guard([&] { raywise::keep_pages(bytes); });
}

std::int32_t rw_memory_kept(std::uint64_t* bytes) {
    return guard([&] { required(bytes, "bytes") = raywise::page_pool_figures().kept; });
}

} // extern "C"
