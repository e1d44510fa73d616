// The memory of batches that a sequence of calls keeps from one to the next, whatever they ask and of which scene.
#pragma once

#include "fuzz/failure.h"
#include "raywise/raywise.h"

namespace raywise::fuzz {

class Workspace {
public:
    Workspace() { Outcome("batch_workspace_create").check(rw_batch_workspace_create(&handle_)); }
    ~Workspace() { Outcome("batch_workspace_release").check(rw_batch_workspace_release(handle_)); }
    Workspace(const Workspace&) = delete;
    Workspace& operator=(const Workspace&) = delete;

    rw_batch_workspace* get() const { return handle_; }

private:
    rw_batch_workspace* handle_ = nullptr;
};

} // namespace raywise::fuzz
