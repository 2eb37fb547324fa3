/* What single calls of the FMU take, as a C host sees them: the least of many repeats, each of many calls.

       fmi_calls SHEET LIBRARY             one line a measurement: KEY|WHAT|TARGET [ns]|TIME [ns]|FUNCTIONS
       fmi_calls SHEET LIBRARY KEY CALLS   just so many calls, for a tool that counts instructions within FUNCTIONS

   A target of 0 is none. */
#include "library.h"
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
static double start, own_step;

static void fail(const char *what)
{
    fprintf(stderr, "fmi_calls: %s\n", what);
    exit(2);
}

static void must(fmi2Status status, const char *what)
{
    if (status != fmi2OK) {
        fail(what);
    }
}

static void quiet(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                  fmi2String message, ...)
{
    (void)environment;
    (void)instance;
    (void)category;
    fprintf(stderr, "%d %s\n", status, message);
}

static fmi2Component instantiate(fmi2Type type)
{
    static const fmi2CallbackFunctions callbacks = {quiet, NULL, NULL, NULL, NULL};
    fmi2Component made =
        fmi.Instantiate("rotor", type, attribute("fmiModelDescription.guid"), NULL, &callbacks, fmi2False, fmi2False);
    if (made == NULL) {
        fail("fmi2Instantiate");
    }
    return made;
}

static void initialize(fmi2Component component)
{
    must(fmi.SetupExperiment(component, fmi2False, 0.0, 0.0, fmi2False, 0.0), "fmi2SetupExperiment");
    must(fmi.EnterInitializationMode(component), "fmi2EnterInitializationMode");
    must(fmi.ExitInitializationMode(component), "fmi2ExitInitializationMode");
}

static void read_ten(void)
{
    fmi2Real values[READ];
    must(fmi.GetReal(rotor, read_references, READ, values), "fmi2GetReal");
}

/* The bodies: `n` calls each. */

static void get_real(int n)
{
    fmi2Real values[READ];
    for (int i = 0; i < n; i++) {
        fmi.GetReal(rotor, read_references, READ, values);
    }
}

static void get_state(int n)
{
    for (int i = 0; i < n; i++) {
        fmi.GetFMUstate(rotor, &scratch);
    }
}

static void set_state(int n)
{
    for (int i = 0; i < n; i++) {
        fmi.SetFMUstate(rotor, at_start);
    }
}

static void make_and_free(int n)
{
    for (int i = 0; i < n; i++) {
        fmi.FreeInstance(instantiate(fmi2CoSimulation));
    }
}

/* Steps within one of the solver's own. */
static void step_unread(int n)
{
    double h = 0.5 * own_step / MOST_CALLS;
    for (int i = 0; i < n; i++) {
        fmi.DoStep(rotor, start + i * h, h, fmi2True);
    }
}

static void step_and_read(int n)
{
    fmi2Real values[READ];
    double h = 0.5 * own_step / MOST_CALLS;
    for (int i = 0; i < n; i++) {
        fmi.DoStep(rotor, start + i * h, h, fmi2True);
        fmi.GetReal(rotor, read_references, READ, values);
    }
}

/* Steps of the default experiment: the solver works, too. */
static void step_of_experiment(int n)
{
    fmi2Real values[READ];
    double h = number("DefaultExperiment.stepSize");
    for (int i = 0; i < n; i++) {
        fmi.DoStep(rotor, start + i * h, h, fmi2True);
        fmi.GetReal(rotor, read_references, READ, values);
    }
}

static void serialize(int n)
{
    for (int i = 0; i < n; i++) {
        fmi.SerializeFMUstate(rotor, at_start, bytes, size);
    }
}

static void deserialize(int n)
{
    for (int i = 0; i < n; i++) {
        fmi2FMUstate state = NULL;
        fmi.DeSerializeFMUstate(rotor, bytes, size, &state);
        fmi.FreeFMUstate(rotor, &state);
    }
}

/* With the states set anew each time, or the derivatives would stand ready. */
static void derivatives(int n)
{
    for (int i = 0; i < n; i++) {
        fmi.SetContinuousStates(exchange, states_now, states.count);
        fmi.GetDerivatives(exchange, rates, states.count);
    }
}

/* Of all derivatives, along one state. */
static void directional_derivative(int n)
{
    const fmi2Real one = 1.0;
    for (int i = 0; i < n; i++) {
        fmi.SetContinuousStates(exchange, states_now, states.count);
        fmi.GetDirectionalDerivative(exchange, states.derivatives, states.count,
                                     &states.references[i % (int)states.count], 1, &one, rates);
    }
}

/* What stands before a repeat and is not measured. */

static void nothing(void)
{
}

static void back(void)
{
    must(fmi.SetFMUstate(rotor, at_start), "fmi2SetFMUstate");
}

static void back_and_read(void)
{
    back();
    read_ten();
}

enum needs { ALWAYS, STATES, BYTES, EXCHANGE, DIRECTIONAL };

static const struct measurement {
    const char *key, *what;
    double target;
    void (*before)(void);
    void (*body)(int);
    enum needs needs;
    const char *functions;
} MEASUREMENTS[] = {
    {"get_real", "fmi2GetReal, 10 variables at hand", 20.0, back_and_read, get_real, STATES, "fmi2GetReal"},
    {"get_state", "fmi2GetFMUstate, into a state used again", 150.0, back_and_read, get_state, STATES,
     "fmi2GetFMUstate"},
    {"set_state", "fmi2SetFMUstate", 150.0, back_and_read, set_state, STATES, "fmi2SetFMUstate"},
    {"make_and_free", "fmi2Instantiate and fmi2FreeInstance", 20000.0, nothing, make_and_free, ALWAYS,
     "fmi2Instantiate fmi2FreeInstance"},
    {"step_unread", "fmi2DoStep, unread, within the solver's step", 20.0, back, step_unread, STATES, "fmi2DoStep"},
    {"step_and_read", "fmi2DoStep and fmi2GetReal, 10 variables, within the solver's step", 0.0, back, step_and_read,
     STATES, "fmi2DoStep fmi2GetReal"},
    {"step_of_experiment", "fmi2DoStep and fmi2GetReal, 10 variables, the default experiment's step", 0.0, back,
     step_of_experiment, STATES, "fmi2DoStep fmi2GetReal"},
    {"serialize", "fmi2SerializeFMUstate", 0.0, back, serialize, BYTES, "fmi2SerializeFMUstate"},
    {"deserialize", "fmi2DeSerializeFMUstate and fmi2FreeFMUstate", 0.0, back, deserialize, BYTES,
     "fmi2DeSerializeFMUstate fmi2FreeFMUstate"},
    {"derivatives", "fmi2SetContinuousStates and fmi2GetDerivatives", 0.0, nothing, derivatives, EXCHANGE,
     "fmi2SetContinuousStates fmi2GetDerivatives"},
    {"directional", "fmi2SetContinuousStates and fmi2GetDirectionalDerivative, one seed", 0.0, nothing,
     directional_derivative, DIRECTIONAL, "fmi2SetContinuousStates fmi2GetDirectionalDerivative"},
};

static bool can_be_measured(enum needs needs)
{
    switch (needs) {
    case STATES:
        return claims("CoSimulation.canGetAndSetFMUstate");
    case BYTES:
        return claims("CoSimulation.canSerializeFMUstate");
    case EXCHANGE:
        return attribute("ModelExchange.modelIdentifier") != NULL;
    case DIRECTIONAL:
        return claims("ModelExchange.providesDirectionalDerivative");
    default:
        return true;
    }
}

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
    must(fmi.DoStep(rotor, 0.0, MOVED, fmi2True), "fmi2DoStep");
    must(fmi.GetReal(rotor, &variable("solver.next_step")->reference, 1, &own_step), "solver.next_step");
    must(fmi.GetReal(rotor, &steps_reference, 1, &steps), "solver.steps");
    /* On to where the solver has just begun a step: nearly all of it lies ahead. */
    start = MOVED;
    do {
        steps_before = steps;
        must(fmi.DoStep(rotor, start, own_step / 64.0, fmi2True), "fmi2DoStep");
        start += own_step / 64.0;
        must(fmi.GetReal(rotor, &steps_reference, 1, &steps), "solver.steps");
    } while (steps == steps_before);
    if (can_be_measured(STATES)) {
        must(fmi.GetFMUstate(rotor, &at_start), "fmi2GetFMUstate");
        must(fmi.GetFMUstate(rotor, &scratch), "fmi2GetFMUstate");
    }
    if (can_be_measured(BYTES)) {
        must(fmi.SerializedFMUstateSize(rotor, at_start, &size), "fmi2SerializedFMUstateSize");
        bytes = malloc(size);
        must(fmi.SerializeFMUstate(rotor, at_start, bytes, size), "fmi2SerializeFMUstate");
    }
}

static void prepare_model_exchange(void)
{
    fmi2EventInfo info = {.newDiscreteStatesNeeded = fmi2True};
    exchange = instantiate(fmi2ModelExchange);
    initialize(exchange);
    while (info.newDiscreteStatesNeeded) {
        must(fmi.NewDiscreteStates(exchange, &info), "fmi2NewDiscreteStates");
    }
    must(fmi.EnterContinuousTimeMode(exchange), "fmi2EnterContinuousTimeMode");
    states_now = malloc(states.count * sizeof *states_now);
    rates = malloc(states.count * sizeof *rates);
    must(fmi.GetContinuousStates(exchange, states_now, states.count), "fmi2GetContinuousStates");
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
        fail("usage: fmi_calls SHEET LIBRARY [KEY CALLS]");
    }
    read_sheet(arguments[1]);
    load_library(arguments[2]);
    prepare_co_simulation();
    if (can_be_measured(EXCHANGE)) {
        prepare_model_exchange();
    }
    for (size_t i = 0; i < sizeof MEASUREMENTS / sizeof *MEASUREMENTS; i++) {
        const struct measurement *it = &MEASUREMENTS[i];
        if (!can_be_measured(it->needs)) {
            continue;
        }
        if (only == NULL) {
            measure(it);
        } else if (strcmp(only, it->key) == 0) {
            it->before();
            it->body(atoi(arguments[4]));
        }
    }
    return 0;
}
