/* A host in plain C that does with the FMU whatever a host can do, well or badly.

       host SHEET LIBRARY [--cycles N] [--steps N] [--no-memory] [--without PART]...

   Each check that fails prints one line; then the program ends with 1. What a call must do is asked of it in Rust
   (`cargo test`); here each is made from C, with checkers looking on. */
#include "check.h"
#include "library.h"
#include "parts.h"
#include "rotor.h"
#include "sheet.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct options options = {.cycles = 1000, .steps = 1000, .memory = true};

static void usage(void)
{
    fprintf(stderr, "usage: host SHEET LIBRARY [--cycles N] [--steps N] [--no-memory] [--without PART]...\n");
    exit(2);
}

/* The parts that are left out. */
static const char *without[8];
static size_t without_count = 0;

static void one_part(const char *name, void (*part)(void))
{
    for (size_t i = 0; i < without_count; i++) {
        if (strcmp(name, without[i]) == 0) {
            return;
        }
    }
    int before = failed_checks();
    part();
    if (failed_checks() != before) {
        printf("%s: %d checks failed\n", name, failed_checks() - before);
    }
}

int main(int count, char **arguments)
{
    if (count < 3) {
        usage();
    }
    for (int i = 3; i < count; i++) {
        bool has_value = i + 1 < count;
        if (strcmp(arguments[i], "--cycles") == 0 && has_value) {
            options.cycles = atoi(arguments[++i]);
        } else if (strcmp(arguments[i], "--steps") == 0 && has_value) {
            options.steps = atoi(arguments[++i]);
        } else if (strcmp(arguments[i], "--no-memory") == 0) {
            options.memory = false;
        } else if (strcmp(arguments[i], "--without") == 0 && has_value &&
                   without_count < sizeof without / sizeof *without) {
            without[without_count++] = arguments[++i];
        } else {
            usage();
        }
    }
    read_sheet(arguments[1]);
    load_library(arguments[2]);
    find_reals();
#define RUN(name) one_part(#name, name);
    PARTS(RUN)
#undef RUN
    printf("%s: %ld checks, %d failed\n", attribute("fmiModelDescription.modelName"), all_checks(), failed_checks());
    return failed_checks() == 0 ? 0 : 1;
}
