/* The header is C99 and needs nothing before it. */
#include "raywise/raywise.h"
#include "raywise/raywise.h" /* twice does no harm */

int main(void) {
    uint32_t abi = 0;
    return rw_abi_version(&abi) == RW_OK && abi == RW_ABI_VERSION ? 0 : 1;
}
