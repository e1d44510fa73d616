#include "api.h"

#include <dlfcn.h>
#include <stdio.h>
#include <string.h>

/* Never run, and no symbol of the library is referred to: sizeof does not evaluate its operand. But the compiler
 * checks the assignments, so a table entry whose arguments differ from the header's declaration does not compile. */
#define API_CHECK(result, name, arguments) (void)sizeof(api->name = rw_##name);

static bool resolve(void *library, const char *name, void *function, size_t size) {
    void *symbol = dlsym(library, name);
    if (symbol == NULL) {
        fprintf(stderr, "raywise-demo: the library has no function %s; it is older than this program\n", name);
        return false;
    }
    /* ISO C has no conversion from an object pointer to a function pointer; POSIX promises that the bytes agree. */
    memcpy(function, &symbol, size);
    return true;
}

bool api_open(struct api *api, const char *path) {
    API_FUNCTIONS(API_CHECK)
    memset(api, 0, sizeof *api);
    const char *name = path != NULL ? path : "libraywise.so.1";
    api->library = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (api->library == NULL) {
        fprintf(stderr, "raywise-demo: cannot open the library: %s\n", dlerror());
        if (path == NULL) fprintf(stderr, "  name it with --library PATH, or add its folder to LD_LIBRARY_PATH\n");
        return false;
    }

    bool complete = true;
#define API_RESOLVE(result, name, arguments) \
    complete = resolve(api->library, "rw_" #name, &api->name, sizeof api->name) && complete;
    API_FUNCTIONS(API_RESOLVE)
#undef API_RESOLVE
    if (!complete) {
        api_close(api);
        return false;
    }

    uint32_t abi = 0;
    if (!api_ok(api, api->abi_version(&abi), "rw_abi_version")) {
        api_close(api);
        return false;
    }
    if (abi != RW_ABI_VERSION) {
        fprintf(stderr, "raywise-demo: the library speaks interface version %u, this program version %u\n",
                (unsigned)abi, (unsigned)RW_ABI_VERSION);
        api_close(api);
        return false;
    }
    return true;
}

void api_close(struct api *api) {
    if (api->library != NULL) dlclose(api->library);
    memset(api, 0, sizeof *api);
}

bool api_ok(const struct api *api, int32_t status, const char *call) {
    if (status == RW_OK) return true;
    /* The message last: it is valid until the next raywise call only. */
    const char *text = api->status_text(status);
    const char *message = api->last_error_message();
    fprintf(stderr, "raywise-demo: %s: status %d, %s\n", call, (int)status, text);
    if (message[0] != '\0') fprintf(stderr, "  %s\n", message);
    return false;
}
