/* What single calls of the FMU take, as a C host sees them: the least of many repeats, each of many calls.

       fmi_calls SHEET LIBRARY             one line a measurement: KEY|WHAT|TARGET [ns]|TIME [ns]|FUNCTIONS
       fmi_calls SHEET LIBRARY KEY CALLS   just so many calls, for a tool that counts instructions within FUNCTIONS

   A target of 0 is none. */
#include "instance.h"
#include "sheet.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* The rotor has moved this far before anything is measured [s]. */
static const double MOVED = 0.5;
/* A repeat takes about so long [ns], and the least of so many is told. */
static const double REPEAT = 1e6;
enum { REPEATS = 200, MOST_CALLS = 10000, READ = 10 };

/* In co-simulation and in model exchange. */
static fmi2Component rotor, exchange;
/* The state at the start of a step of the solver's own, at the time `start` [s], and one to be written over. */
static fmi2FMUstate at_start, scratch;
static fmi2ValueReference read_references[READ];
static fmi2Real *states_now, *rates;
static fmi2Byte *bytes;
static size_t size;
static double start, own_step, experiment_step;

/* The bodies: `n` calls each, the `i`th of them. */
#define BODY(name, ...) \
    static void name(int n) \
    { \
        for (int i = 0; i < n; i++) { \
            __VA_ARGS__; \
        } \
    }

static fmi2Real ten[READ];

static void step(int i, double h)
{
    fmi.DoStep(rotor, start + i * h, h, fmi2True);
}

static void step_and_look(int i, double h)
{
    step(i, h);
    fmi.GetReal(rotor, read_references, READ, ten);
}

static void read_state(void)
{
    fmi2FMUstate state = NULL;
    fmi.DeSerializeFMUstate(rotor, bytes, size, &state);
    fmi.FreeFMUstate(rotor, &state);
}

/* Of all derivatives, along one state. */
static void along(int i)
{
    const fmi2Real one = 1.0;
    const fmi2ValueReference *known = &states.references[i % (int)states.count];
    fmi.GetDirectionalDerivative(exchange, states.derivatives, states.count, known, 1, &one, rates);
}

BODY(get_real, fmi.GetReal(rotor, read_references, READ, ten))
BODY(get_state, fmi.GetFMUstate(rotor, &scratch))
BODY(set_state, fmi.SetFMUstate(rotor, at_start))
BODY(make_and_free, fmi.FreeInstance(instantiate(fmi2CoSimulation)))
/* Steps within one of the solver's own. */
BODY(step_unread, step(i, 0.5 * own_step / MOST_CALLS))
BODY(step_and_read, step_and_look(i, 0.5 * own_step / MOST_CALLS))
/* Steps of the default experiment: the solver works, too. */
BODY(step_of_experiment, step_and_look(i, experiment_step))
BODY(serialize, fmi.SerializeFMUstate(rotor, at_start, bytes, size))
BODY(deserialize, read_state())
/* With the states set anew each time, or the derivatives would stand ready. */
BODY(derivatives, fmi.SetContinuousStates(exchange, states_now, states.count);
     fmi.GetDerivatives(exchange, rates, states.count))
BODY(directional_derivative, fmi.SetContinuousStates(exchange, states_now, states.count); along(i))

/* What stands before a repeat and is not measured. */

static void nothing(void)
{
}

static void back(void)
{
    MUST(SetFMUstate, rotor, at_start);
}

static void back_and_read(void)
{
    back();
    MUST(GetReal, rotor, read_references, READ, ten);
}

static const struct measurement {
    const char *key, *what;
    double target;
    void (*before)(void);
    void (*body)(int);
    const char *functions;
} MEASUREMENTS[] = {
    {"get_real", "fmi2GetReal, 10 variables at hand", 20.0, back_and_read, get_real, "fmi2GetReal"},
    {"get_state", "fmi2GetFMUstate, into a state used again", 150.0, back_and_read, get_state, "fmi2GetFMUstate"},
    {"set_state", "fmi2SetFMUstate", 150.0, back_and_read, set_state, "fmi2SetFMUstate"},
    {"make_and_free", "fmi2Instantiate and fmi2FreeInstance", 20000.0, nothing, make_and_free,
     "fmi2Instantiate fmi2FreeInstance"},
    {"step_unread", "fmi2DoStep, unread, within the solver's step", 20.0, back, step_unread, "fmi2DoStep"},
    {"step_and_read", "fmi2DoStep and fmi2GetReal, 10 variables, within the solver's step", 0.0, back, step_and_read,
     "fmi2DoStep fmi2GetReal"},
    {"step_of_experiment", "fmi2DoStep and fmi2GetReal, 10 variables, the default experiment's step", 0.0, back,
     step_of_experiment, "fmi2DoStep fmi2GetReal"},
    {"serialize", "fmi2SerializeFMUstate", 0.0, back, serialize, "fmi2SerializeFMUstate"},
    {"deserialize", "fmi2DeSerializeFMUstate and fmi2FreeFMUstate", 0.0, back, deserialize,
     "fmi2DeSerializeFMUstate fmi2FreeFMUstate"},
    {"derivatives", "fmi2SetContinuousStates and fmi2GetDerivatives", 0.0, nothing, derivatives,
     "fmi2SetContinuousStates fmi2GetDerivatives"},
    {"directional", "fmi2SetContinuousStates and fmi2GetDirectionalDerivative, one seed", 0.0, nothing,
     directional_derivative, "fmi2SetContinuousStates fmi2GetDirectionalDerivative"},
};

static void prepare_co_simulation(void)
{
    static const char *const names[READ] = {"r_c.x",   "r_c.y",     "r_c.z",  "phi",    "gamma.y",
                                            "gamma.z", "omega_phi", "axis.x", "axis.y", "axis.z"};
    const fmi2ValueReference steps_reference = variable("solver.steps")->reference;
    fmi2Real steps, steps_before;
    for (int i = 0; i < READ; i++) {
        read_references[i] = variable(names[i])->reference;
    }
    rotor = instantiate(fmi2CoSimulation);
    initialize(rotor);
    MUST(DoStep, rotor, 0.0, MOVED, fmi2True);
    must(fmi.GetReal(rotor, &variable("solver.next_step")->reference, 1, &own_step), "solver.next_step");
    must(fmi.GetReal(rotor, &steps_reference, 1, &steps), "solver.steps");
    /* On to where the solver has just begun a step: nearly all of it lies ahead. */
    start = MOVED;
    do {
        steps_before = steps;
        MUST(DoStep, rotor, start, own_step / 64.0, fmi2True);
        start += own_step / 64.0;
        must(fmi.GetReal(rotor, &steps_reference, 1, &steps), "solver.steps");
    } while (steps == steps_before);
    MUST(GetFMUstate, rotor, &at_start);
    MUST(GetFMUstate, rotor, &scratch);
    MUST(SerializedFMUstateSize, rotor, at_start, &size);
    bytes = malloc(size);
    MUST(SerializeFMUstate, rotor, at_start, bytes, size);
}

static void prepare_model_exchange(void)
{
    fmi2EventInfo info = {.newDiscreteStatesNeeded = fmi2True};
    exchange = instantiate(fmi2ModelExchange);
    initialize(exchange);
    while (info.newDiscreteStatesNeeded) {
        MUST(NewDiscreteStates, exchange, &info);
    }
    MUST(EnterContinuousTimeMode, exchange);
    states_now = malloc(states.count * sizeof *states_now);
    rates = malloc(states.count * sizeof *rates);
    MUST(GetContinuousStates, exchange, states_now, states.count);
}

/* The time of `n` calls [ns]. */
static double timed(const struct measurement *it, int n)
{
    struct timespec from, to;
    it->before();
    clock_gettime(CLOCK_MONOTONIC, &from);
    it->body(n);
    clock_gettime(CLOCK_MONOTONIC, &to);
    return 1e9 * (double)(to.tv_sec - from.tv_sec) + (double)(to.tv_nsec - from.tv_nsec);
}

static void measure(const struct measurement *it)
{
    double first = fmax(timed(it, 16) / 16.0, 1.0), least = INFINITY;
    int n = (int)fmin(fmax(REPEAT / first, 16.0), MOST_CALLS);
    for (int i = 0; i < REPEATS; i++) {
        least = fmin(least, timed(it, n) / n);
    }
    printf("%s|%s|%g|%.1f|%s\n", it->key, it->what, it->target, least, it->functions);
    fflush(stdout);
}

int main(int count, char **arguments)
{
    const char *only = count == 5 ? arguments[3] : NULL;
    if (count != 3 && count != 5) {
        must(fmi2Error, "usage: fmi_calls SHEET LIBRARY [KEY CALLS]");
    }
    read_sheet(arguments[1]);
    load_library(arguments[2]);
    experiment_step = number("DefaultExperiment.stepSize");
    prepare_co_simulation();
    prepare_model_exchange();
    for (size_t i = 0; i < sizeof MEASUREMENTS / sizeof *MEASUREMENTS; i++) {
        const struct measurement *it = &MEASUREMENTS[i];
        if (only == NULL) {
            measure(it);
        } else if (strcmp(only, it->key) == 0) {
            it->before();
            it->body(atoi(arguments[4]));
        }
    }
    return 0;
}
