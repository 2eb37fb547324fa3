#include "rotor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A communication step is no longer than this [s]: under a checker everything takes fifty times as long. */
static const double LONGEST = 0.1;

fmi2ValueReference *reals;
size_t real_count;

struct rotor new_rotor(fmi2Type type)
{
    struct rotor rotor = {NULL, allocated(1, sizeof *rotor.journal)};
    /* The FMU may keep neither the struct nor the strings: all are spoilt and freed after the call. */
    fmi2CallbackFunctions *callbacks = allocated(1, sizeof *callbacks);
    char *name = allocated(8, 1), *guid = allocated(64, 1), *place = allocated(32, 1);
    callbacks->logger = write_journal;
    callbacks->allocateMemory = calloc;
    callbacks->freeMemory = free;
    callbacks->componentEnvironment = rotor.journal;
    strcpy(name, "rotor");
    strncpy(guid, attribute("fmiModelDescription.guid"), 63);
    strcpy(place, "file:///nowhere/resources");
    rotor.component = fmi.Instantiate(name, type, guid, place, callbacks, fmi2False, fmi2False);
    CHECK(rotor.component != NULL, "fmi2Instantiate: %s", rotor.journal->message);
    memset(callbacks, 0xa5, sizeof *callbacks);
    memset(name, 0xa5, 8);
    memset(guid, 0xa5, 64);
    memset(place, 0xa5, 32);
    free(callbacks);
    free(name);
    free(guid);
    free(place);
    if (rotor.component == NULL) {
        exit(1);
    }
    return rotor;
}

void free_rotor(struct rotor *rotor)
{
    fmi.FreeInstance(rotor->component);
    free(rotor->journal);
    rotor->component = NULL;
    rotor->journal = NULL;
}

void initialize(struct rotor *rotor)
{
    DONE(rotor, SetupExperiment, fmi2False, 0.0, time_at(0), fmi2False, 0.0);
    DONE_PLAIN(rotor, EnterInitializationMode);
    set_inputs(rotor, time_at(0));
    DONE_PLAIN(rotor, ExitInitializationMode);
}

struct rotor started_rotor(void)
{
    struct rotor rotor = new_rotor(fmi2CoSimulation);
    initialize(&rotor);
    return rotor;
}

double communication_step(void)
{
    return fmin(number("DefaultExperiment.stepSize"), LONGEST);
}

double time_at(int i)
{
    return number("DefaultExperiment.startTime") + i * communication_step();
}

void find_reals(void)
{
    real_count = references_of('R', NULL, &reals);
}

void read_reals(struct rotor *rotor, fmi2Real *values)
{
    DONE(rotor, GetReal, reals, real_count, values);
}

bool same_bits(const fmi2Real *a, const fmi2Real *b, size_t count)
{
    return memcmp(a, b, count * sizeof *a) == 0;
}

void set_inputs(struct rotor *rotor, double t)
{
    fmi2ValueReference *inputs;
    size_t count = references_of('R', "input", &inputs);
    /* A saw tooth, different for each input, without a mathematical library. */
    for (size_t i = 0; i < count; i++) {
        double x = t * (1.0 + 0.25 * (double)i);
        fmi2Real value = 0.2 * (x - (double)(long)x) - 0.05;
        DONE(rotor, SetReal, &inputs[i], 1, &value);
    }
    free(inputs);
}

void run(struct rotor *rotor, int first, int count, fmi2Real *trace)
{
    fmi2Real *values = new_trace(1);
    for (int i = 0; i < count; i++) {
        double t = time_at(first + i);
        set_inputs(rotor, t);
        DONE(rotor, DoStep, t, time_at(first + i + 1) - t, fmi2True);
        read_reals(rotor, trace == NULL ? values : trace + (size_t)i * real_count);
    }
    free(values);
}

fmi2Real *new_trace(int count)
{
    return allocated((size_t)count * real_count, sizeof(fmi2Real));
}

bool was_refused(struct rotor *rotor, fmi2Status status, const char *function, const char *file, int line)
{
    struct journal *journal = rotor->journal;
    bool logged = journal->count == 1 && journal->status == fmi2Error &&
                  strncmp(journal->message, function, strlen(function)) == 0 &&
                  strcmp(journal->category, "logStatusError") == 0;
    return check_that(status == fmi2Error && logged, file, line,
                      "%s must be refused with one line in the log; it returned %d and logged %d lines%s%s", function,
                      status, journal->count, journal->count == 0 ? "" : ": ",
                      journal->count == 0 ? "" : journal->message);
}

bool was_done(struct rotor *rotor, fmi2Status status, const char *function, const char *file, int line)
{
    /* A warning may be logged by a call that is done. */
    return check_that(status == fmi2OK, file, line, "%s returned %d: %s", function, status,
                      rotor->journal->count == 0 ? "without a word" : rotor->journal->message);
}
