#include "io/allocation_watch.h"

#include <atomic>

namespace raywise::io {
namespace {

thread_local bool refused = false;
std::atomic<std::new_handler> host_handler{nullptr};

// operator new calls this when it finds no memory, and tries again when it returns. The host's handler keeps its say.
void note_refusal() {
    try {
        const std::new_handler host = host_handler;
        if (host == nullptr) throw std::bad_alloc();
        host();
    } catch (...) {
        refused = true;
        throw;
    }
}

} // namespace

AllocationWatch::AllocationWatch() : before_(std::get_new_handler()) {
    refused = false;
    host_handler = before_;
    std::set_new_handler(note_refusal);
}

AllocationWatch::~AllocationWatch() {
    // Unless the host has set another in the meantime.
    if (std::get_new_handler() == note_refusal) std::set_new_handler(before_);
}

void AllocationWatch::require_none_refused() const {
    if (refused) throw std::bad_alloc();
}

} // namespace raywise::io
