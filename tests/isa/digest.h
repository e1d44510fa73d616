/* What a program of one instruction set does once its machine is known to have it. */
#ifndef RAYWISE_TESTS_ISA_DIGEST_H
#define RAYWISE_TESTS_ISA_DIGEST_H

#ifdef __cplusplus
extern "C" {
#endif

struct digest_options {
    const char *inputs; /* a file of isa_write_inputs */
    const char *output; /* where the lines go; NULL: nowhere */
    const char *expect; /* lines to compare with; NULL: none */
    int each_ray;       /* a line for each ray */
};

/* Answers all rays with every structure. Returns an exit code: 0; 1 when a line differs or a file cannot be used. */
int run_digest(const struct digest_options *options);

#ifdef __cplusplus
}
#endif

#endif
