// Workspaces of batches.
#include "guard.h"
#include "handles.h"

using namespace raywise::capi;

extern "C" {

std::int32_t rw_batch_workspace_create(rw_batch_workspace** workspace) {
    return guard([&] {
        rw_batch_workspace*& out = required(workspace, "workspace"); // before anything is made
        out = new rw_batch_workspace;
    });
}

std::int32_t rw_batch_workspace_release(rw_batch_workspace* workspace) {
    return guard([&] { delete workspace; });
}

} // extern "C"
