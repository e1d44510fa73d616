// The header is C++ as well.
#include "raywise/raywise.h"

int main() {
    uint32_t abi = 0;
    return rw_abi_version(&abi) == RW_OK && abi == RW_ABI_VERSION ? 0 : 1;
}
