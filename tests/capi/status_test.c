/* Every status has a text of its own, and unknown ones have one too. */
#include "testing.h"

int main(void) {
    int32_t i, j;
    uint32_t major = 99, minor = 99, patch = 99;
    use_all_helpers();
    CHECK(RW_STATUS_COUNT == RW_ERROR_IN_USE + 1);
    for (i = 0; i < RW_STATUS_COUNT; ++i) {
        const char *text = rw_status_text(i);
        CHECK(text != NULL && strlen(text) >= 5);
        CHECK(text == rw_status_text(i));
        for (j = 0; j < i; ++j) CHECK(strcmp(text, rw_status_text(j)) != 0);
    }
    for (i = -3; i <= RW_STATUS_COUNT + 2; ++i) {
        const char *text = rw_status_text(i);
        CHECK(text != NULL && text[0] != '\0');
        if (i < 0 || i >= RW_STATUS_COUNT) {
            for (j = 0; j < RW_STATUS_COUNT; ++j) CHECK(strcmp(text, rw_status_text(j)) != 0);
        }
    }
    CHECK(rw_status_text(INT32_MIN) != NULL && rw_status_text(INT32_MAX) != NULL);

    CHECK(rw_last_error_message() != NULL && rw_last_error_message()[0] == '\0');
    CHECK_OK(rw_version(&major, &minor, &patch));
    CHECK(major == RW_VERSION_MAJOR && minor == RW_VERSION_MINOR && patch == RW_VERSION_PATCH);
    CHECK_OK(rw_version(NULL, NULL, NULL));
    CHECK_ERROR(rw_abi_version(NULL), RW_ERROR_INVALID_ARGUMENT, "abi|NULL");
    /* A call that succeeds leaves the message as it was. */
    CHECK_OK(rw_version(&major, NULL, NULL));
    CHECK(strstr(rw_last_error_message(), "abi") != NULL);
    return finish("status");
}
