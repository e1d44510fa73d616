// Notices that memory was refused where nobody says so: C++ streams swallow std::bad_alloc and go on with a number that was
// not read, and so do readers that are built on them.
#pragma once

#include <new>

namespace raywise::io {

// From its making to its end, tells of the thread it was made on. One at a time in the process.
class AllocationWatch {
public:
    AllocationWatch();
    ~AllocationWatch();
    AllocationWatch(const AllocationWatch&) = delete;
    AllocationWatch& operator=(const AllocationWatch&) = delete;

    // Throws std::bad_alloc if operator new has failed since.
    void require_none_refused() const;

private:
    std::new_handler before_;
};

} // namespace raywise::io
