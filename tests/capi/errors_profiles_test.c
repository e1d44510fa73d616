/* Profiles that cannot be used: the status that says why, a message that names the file and the member, and a profile all the
 * same. */
#include "errors_testing.h"

static char text[65536]; /* of the profile in use, as JSON */

/* Loads a file that cannot be used. */
static void refused(const char *path, int32_t status, const char *parts) {
    rw_profile *p = NULL;
    rw_profile_info info;
    CHECK_ERROR(rw_profile_load(path, &p), status, parts);
    if (!CHECK(p != NULL)) return;
    memset(&info, 0, sizeof info);
    info.struct_size = sizeof info;
    CHECK_OK(rw_profile_inspect(p, &info));
    CHECK(info.source == RW_PROFILE_SOURCE_GENERIC && info.status == status && strcmp(info.machine, "generic") == 0);
    CHECK(info.path != NULL && info.path[0] == '\0' && info.date != NULL && info.tool != NULL);
    rw_profile_release(p);
}

/* The text with its first `old` replaced; where that ends in ": ", together with the value behind it. */
static const char *with(const char *old, const char *replacement) {
    static char changed[sizeof text + 4096];
    const char *at = strstr(text, old), *rest;
    if (at == NULL) {
        fprintf(stderr, "the profile has no %s\n", old);
        exit(1);
    }
    rest = at + strlen(old);
    if (rest[-1] == ' ') rest += strcspn(rest, ",\n");
    snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - text), text, replacement, rest);
    return changed;
}

static const struct change {
    const char *old, *replacement;
    int32_t status;
    const char *parts;
} changes[] = {
    {"raywise-profile/2", "raywise-profile/1", RW_PROFILE_SCHEMA, "schema|raywise-profile/2"},
    {"\"epoch\": ", "\"epoch\": 9", RW_PROFILE_EPOCH, "epoch"},
    {"\"vendor\": \"", "\"vendor\": \"another ", RW_PROFILE_MACHINE, "machine.vendor|another|this machine"},
    {"\"vendor\"", "\"seller\"", RW_PROFILE_MALFORMED, "machine.vendor|missing"},
    {"\"vendor\": ", "\"vendor\": \"x\", \"vendor\": \"y\"", RW_PROFILE_MALFORMED, "vendor|twice"},
    {"\"vendor\": ", "\"extra\": 1, \"vendor\": \"y\"", RW_PROFILE_MALFORMED, "unexpected member|extra|machine"},
    {"\"vendor\": ", "\"vendor\": 7", RW_PROFILE_MALFORMED, "vendor|text"},
    {"\"family\": ", "\"family\": -1", RW_PROFILE_RANGE, "machine.family|whole number"},
    {"\"family\": ", "\"family\": \"x\"", RW_PROFILE_MALFORMED, "machine.family|whole number"},
    {"\"virtualised\": ", "\"virtualised\": 1", RW_PROFILE_MALFORMED, "virtualised|true or false"},
    {"\"fixed\": ", "\"fixed\": -1", RW_PROFILE_RANGE, "structures.linear_scan.build_ns.fixed|between"},
    {"\"fixed\": ", "\"fixed\": 1e999", RW_PROFILE_RANGE, "number"},
    {"\"fixed\": ", "\"fixed\": \"1\"", RW_PROFILE_MALFORMED, "structures.linear_scan.build_ns.fixed|number"},
    {"\"N\": ", "\"M\": 1", RW_PROFILE_MALFORMED, "structures.linear_scan.build_ns.per_unit.N|missing"},
    {"\"date\": \"", "\"date\": \"\\u0007", RW_PROFILE_MALFORMED, "date|control character"},
    {"\"machine\": {", "\"machine\": [[[[[[[[[1]]]]]]]]], \"old\": {", RW_PROFILE_MALFORMED, "nested"},
};

static void changed_members(void) {
    size_t i;
    char parts[200], longer[2000];
    for (i = 0; i < sizeof changes / sizeof changes[0]; ++i) {
        snprintf(parts, sizeof parts, "p.json|%s", changes[i].parts);
        refused(file_with("p.json", with(changes[i].old, changes[i].replacement)), changes[i].status, parts);
    }
    memset(longer, 'x', sizeof longer);
    memcpy(longer, "\"tool\": \"", 9);
    longer[sizeof longer - 1] = '\0';
    refused(file_with("p.json", with("\"tool\": \"", longer)), RW_PROFILE_MALFORMED, "provenance.tool|more than");
    {
        /* What costs nothing at all is not believed: both constants of a time are zero. */
        char both[256];
        const char *fixed = strstr(text, "\"fixed\": "), *end = strchr(fixed, '}');
        while (end[-1] == ' ' || end[-1] == '\n') --end;
        snprintf(both, sizeof both, "%.*s", (int)(end - fixed), fixed);
        refused(file_with("p.json", with(both, "\"fixed\": 0, \"per_unit\": {\"N\": 0")), RW_PROFILE_RANGE,
                "structures.linear_scan.build_ns|zero");
    }
}

static void damaged_files(void) {
    static const char zero[] = "{}\0{}";
    char path[600];
    char *large = (char *)calloc(1, (1u << 20) + 2);
    uint64_t size = strlen(text), i;
    if (large == NULL) exit(1);
    refused("/nowhere/profile.json", RW_PROFILE_NOT_FOUND, "/nowhere/profile.json");
    snprintf(path, sizeof path, "%s/folder.json", folder);
    if (mkdir(path, 0700) != 0) exit(1);
    refused(path, RW_PROFILE_UNREADABLE, "folder.json|plain file");
    rmdir(path);
    if (symlink("/proc/self/mem", path) != 0) exit(1);
    refused(path, RW_PROFILE_UNREADABLE, "folder.json|cannot be read");
    remove(path);
    memset(large, ' ', (1u << 20) + 1);
    refused(file_with("p.json", large), RW_PROFILE_UNREADABLE, "p.json|1 MiB");
    free(large);
    refused(file_with("p.json", ""), RW_PROFILE_MALFORMED, "p.json");
    refused(file_with("p.json", "{\"schema\": "), RW_PROFILE_MALFORMED, "p.json");
    refused(file_with("p.json", "[1, 2, 3]"), RW_PROFILE_MALFORMED, "p.json");
    refused(file_of("p.json", zero, sizeof zero), RW_PROFILE_MALFORMED, "p.json|zero byte");

    /* The library's own text, cut off anywhere, is never taken for a profile and never a crash. */
    for (i = 1; i + 3 < size; i += 97) {
        refused(file_of("p.json", text, (size_t)i), RW_PROFILE_MALFORMED, "p.json");
    }
}

int main(void) {
    uint64_t needed = 0;
    set_up();
    NEED_OK(rw_profile_text(profile, RW_FORMAT_JSON, text, sizeof text, &needed));
    changed_members();
    damaged_files();
    return tear_down("errors of profiles");
}
