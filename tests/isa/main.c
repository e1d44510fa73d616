/* The command line of every isa_digest program. In C and compiled for the least processor, whatever the rest of the program
 * is compiled for: it has to run in order to say that the rest cannot, and C leaves no inline functions behind that the linker
 * could take for the rest's own. */
#include "isa/digest.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    exit_usage = 2,
    exit_skipped = 77
};

static const char usage[] =
    "usage: isa_digest_LEVEL INPUTS [--output FILE] [--expect FILE] [--each-ray] [--software-fma]\n"
    "Answers the rays of INPUTS, written by isa_write_inputs, with every structure.\n"
    "  --output FILE   write a line with a digest of the answers for each scene and structure\n"
    "  --expect FILE   compare the lines with these; a difference is a failure\n"
    "  --each-ray      a line for each ray, to find the one that differs\n"
    "  --software-fma  skip unless the C library's fma is done in software\n"
    "Exit codes: 0 all as expected, 1 not so, 2 usage, 77 skipped: this machine cannot.\n";

static int processor_has_level(void) {
#ifdef RW_ISA_NEEDS
    __builtin_cpu_init();
    return __builtin_cpu_supports(RW_ISA_NEEDS) != 0;
#else
    return 1;
#endif
}

/* The C library picks one of several fma when the program is loaded. Those that use the processor's instruction begin with it
 * (a three-byte VEX or a four-byte EVEX prefix), maybe behind a landing pad of four bytes. */
static int fma_is_software(void) {
#if defined(__x86_64__)
    double (*volatile chosen)(double, double, double) = fma;
    double (*const address)(double, double, double) = chosen;
    static const unsigned char landing_pad[4] = {0xF3, 0x0F, 0x1E, 0xFA};
    const unsigned char *code;
    memcpy(&code, &address, sizeof code);
    if (memcmp(code, landing_pad, sizeof landing_pad) == 0) code += sizeof landing_pad;
    return code[0] != 0xC4 && code[0] != 0x62;
#else
    return 0;
#endif
}

static int skip(const char *reason) {
    printf("skipped: %s\n", reason);
    return exit_skipped;
}

int main(int argc, char **argv) {
    struct digest_options options = {NULL, NULL, NULL, 0};
    int software_fma = 0;
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], "--help") == 0) {
            fputs(usage, stdout);
            return 0;
        }
        if (strcmp(argv[i], "--each-ray") == 0) {
            options.each_ray = 1;
        } else if (strcmp(argv[i], "--software-fma") == 0) {
            software_fma = 1;
        } else if (strcmp(argv[i], "--output") == 0 && i + 1 < argc) {
            options.output = argv[++i];
        } else if (strcmp(argv[i], "--expect") == 0 && i + 1 < argc) {
            options.expect = argv[++i];
        } else if (argv[i][0] != '-' && options.inputs == NULL) {
            options.inputs = argv[i];
        } else {
            fputs(usage, stderr);
            return exit_usage;
        }
    }
    if (options.inputs == NULL) {
        fputs(usage, stderr);
        return exit_usage;
    }
    if (!processor_has_level()) return skip("this processor does not have the instruction set");
    if (software_fma && !fma_is_software()) return skip("the C library's fma uses the processor's instruction");
    return run_digest(&options);
}
