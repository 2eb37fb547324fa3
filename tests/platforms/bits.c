/* The bits of an FMU's trajectory, by each method that is named: a line with its hash, as tests/bits.rs reckons it.

       bits SHEET LIBRARY METHOD... */
#include "library.h"
#include "sheet.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Communication points lie this far apart [s], exact in binary. */
static const double STEP = 1.0 / 64.0;
enum { STEPS = 128 };

static void say(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                fmi2String message, ...)
{
    (void)environment, (void)instance, (void)status, (void)category;
    fprintf(stderr, "%s\n", message);
}

static void expect_ok(fmi2Status status, const char *call)
{
    if (status != fmi2OK) {
        fprintf(stderr, "%s: status %d\n", call, status);
        exit(1);
    }
}

#define CALL(function, ...) expect_ok(fmi.function(__VA_ARGS__), #function)

static int by_number(const void *a, const void *b)
{
    fmi2ValueReference first = *(const fmi2ValueReference *)a, second = *(const fmi2ValueReference *)b;
    return (first > second) - (first < second);
}

/* FNV-1a, 64 bits, over the little-endian bytes of `count` numbers. */
static uint64_t hash_on(uint64_t hash, const fmi2Real *values, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        uint64_t bits;
        memcpy(&bits, &values[i], sizeof bits);
        for (int byte = 0; byte < 8; byte++) {
            hash = (hash ^ (bits >> 8 * byte & 0xff)) * UINT64_C(0x100000001b3);
        }
    }
    return hash;
}

static uint64_t hash_of_run(fmi2Integer method, const fmi2ValueReference *reals, size_t count)
{
    const fmi2CallbackFunctions callbacks = {say, calloc, free, NULL, NULL};
    fmi2Component rotor = fmi.Instantiate("bits", fmi2CoSimulation, attribute("fmiModelDescription.guid"), NULL,
                                          &callbacks, fmi2False, fmi2False);
    if (rotor == NULL) {
        exit(1);
    }
    CALL(SetInteger, rotor, &variable("solver.method")->reference, 1, &method);
    CALL(SetupExperiment, rotor, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    CALL(EnterInitializationMode, rotor);
    CALL(ExitInitializationMode, rotor);
    uint64_t hash = UINT64_C(0xcbf29ce484222325);
    fmi2Real *values = malloc(count * sizeof *values);
    for (int i = 0; i <= STEPS; i++) {
        if (i > 0) {
            CALL(DoStep, rotor, (i - 1) * STEP, STEP, fmi2True);
        }
        CALL(GetReal, rotor, reals, count, values);
        hash = hash_on(hash, values, count);
    }
    free(values);
    fmi.FreeInstance(rotor);
    return hash;
}

int main(int count, char **arguments)
{
    if (count < 4) {
        fprintf(stderr, "usage: bits SHEET LIBRARY METHOD...\n");
        return 2;
    }
    read_sheet(arguments[1]);
    load_library(arguments[2]);
    fmi2ValueReference *reals;
    size_t real_count = references_of('R', NULL, &reals);
    qsort(reals, real_count, sizeof *reals, by_number);
    for (int i = 3; i < count; i++) {
        printf("%016" PRIx64 "\n", hash_of_run(atoi(arguments[i]), reals, real_count));
    }
    free(reals);
    return 0;
}
