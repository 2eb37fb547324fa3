/* Model exchange: the host's own Runge-Kutta loop arrives where co-simulation does, with the order that it has. */
#include "exchange.h"
#include "parts.h"
#include "rotor.h"
#include "saved.h"

#include <math.h>
#include <stdlib.h>

/* Steps over a span of half a second, and twice as many. */
enum { STEPS = 500 };
static const double SPAN = 0.5;

/* The difference to co-simulation at the finer step, in parts of the larger of a value's size and 1; measured 2.6e-6
   (free_top). */
static const double BOUND = 1e-5;
/* Twice the steps: 16 times the accuracy (measured 16 to 18), unless what is left is the error of co-simulation
   (measured 3e-10 in tumbling), whose tolerance is tight. */
static const double LEAST_GAIN = 12.0;
static const double ROUNDING = 1e-9;
static const double TIGHT = 1e-13;

/* An instance after event mode. */
static struct rotor new_exchange(void)
{
    struct rotor rotor = new_rotor(fmi2ModelExchange);
    DONE(&rotor, SetupExperiment, fmi2False, 0.0, time_at(0), fmi2False, 0.0);
    DONE_PLAIN(&rotor, EnterInitializationMode);
    set_line(&rotor, time_at(0));
    DONE_PLAIN(&rotor, ExitInitializationMode);
    enter_continuous_time(&rotor);
    return rotor;
}

/* What co-simulation has at the end of the span, under the same input. */
static void reference(const fmi2ValueReference *outputs, size_t output_count, fmi2Real *values)
{
    enum { COMMUNICATIONS = 10 };
    fmi2ValueReference *inputs;
    size_t count = references_of('R', "input", &inputs);
    const fmi2Integer one = 1;
    fmi2Real rate = input_rate();
    struct rotor rotor = new_rotor(fmi2CoSimulation);
    DONE(&rotor, SetupExperiment, fmi2True, TIGHT, time_at(0), fmi2False, 0.0);
    DONE_PLAIN(&rotor, EnterInitializationMode);
    set_line(&rotor, time_at(0));
    DONE_PLAIN(&rotor, ExitInitializationMode);
    for (int i = 0; i < COMMUNICATIONS; i++) {
        double t = time_at(0) + SPAN * i / COMMUNICATIONS;
        set_line(&rotor, t);
        for (size_t j = 0; j < count && rate != 0.0; j++) {
            DONE(&rotor, SetRealInputDerivatives, &inputs[j], 1, &one, &rate);
        }
        DONE(&rotor, DoStep, t, SPAN / COMMUNICATIONS, fmi2True);
    }
    DONE(&rotor, GetReal, outputs, output_count, values);
    free_rotor(&rotor);
    free(inputs);
}

static double difference(int steps, const fmi2ValueReference *outputs, size_t count, const fmi2Real *expected)
{
    double largest = 0.0;
    fmi2Real *values = allocated(count, sizeof *values);
    const struct variable *chart = variable("state.chart");
    fmi2Integer first = 0, last = 0;
    struct rotor rotor = new_exchange();
    DONE(&rotor, GetInteger, &chart->reference, 1, &first);
    int events = integrate(&rotor, time_at(0), SPAN / steps, steps);
    DONE(&rotor, GetInteger, &chart->reference, 1, &last);
    CHECK(first == last || events > 0, "the chart went from %d to %d without an event", first, last);
    DONE(&rotor, GetReal, outputs, count, values);
    DONE_PLAIN(&rotor, Terminate);
    free_rotor(&rotor);
    for (size_t i = 0; i < count; i++) {
        CHECK(isfinite(values[i]), "the variable %u is %g", outputs[i], values[i]);
        largest = fmax(largest, fabs(values[i] - expected[i]) / fmax(1.0, fabs(expected[i])));
    }
    free(values);
    return largest;
}

static void against_co_simulation(void)
{
    fmi2ValueReference *outputs;
    size_t count = smooth_outputs(&outputs);
    fmi2Real *expected = allocated(count, sizeof *expected);
    reference(outputs, count, expected);
    double coarse = difference(STEPS, outputs, count, expected), fine = difference(2 * STEPS, outputs, count, expected);
    CHECK(fine <= BOUND, "model exchange differs by %g from co-simulation", fine);
    CHECK(coarse >= LEAST_GAIN * fine || fine < ROUNDING, "twice the steps take the difference from %g to %g only",
          coarse, fine);
    free(expected);
    free(outputs);
}

/* The lists of states are those of the XML, whichever way they are read. */
static void lists(void)
{
    size_t n = states.count;
    fmi2Real *x = allocated(n + 1, sizeof *x), *y = allocated(n + 1, sizeof *y);
    struct rotor rotor = new_exchange();
    DONE(&rotor, GetContinuousStates, x, n);
    DONE(&rotor, GetReal, states.references, n, y);
    CHECK(same_bits(x, y, n), "states read as variables have other values");
    DONE(&rotor, GetDerivatives, x, n);
    DONE(&rotor, GetReal, states.derivatives, n, y);
    CHECK(same_bits(x, y, n), "derivatives read as variables have other values");
    DONE(&rotor, GetNominalsOfContinuousStates, x, n);
    for (size_t i = 0; i < n; i++) {
        CHECK(x[i] > 0.0 && isfinite(x[i]), "a nominal value of %g", x[i]);
    }
    DONE(&rotor, GetContinuousStates, y, n);
    for (size_t wrong = 0; wrong <= n + 1; wrong += wrong == n - 1 ? 2 : 1) {
        REFUSED(&rotor, GetContinuousStates, x, wrong);
        REFUSED(&rotor, SetContinuousStates, x, wrong);
        REFUSED(&rotor, GetDerivatives, x, wrong);
        REFUSED(&rotor, GetNominalsOfContinuousStates, x, wrong);
    }
    DONE(&rotor, GetContinuousStates, x, n);
    CHECK(same_bits(x, y, n), "lists of a wrong length change the states");
    free_rotor(&rotor);
    free(x);
    free(y);
}

/* What is no number gets in nowhere: the setter refuses it, or what follows from it is not given as if it were right.
 */
static void no_numbers(void)
{
    size_t n = states.count;
    fmi2Real *x = allocated(n, sizeof *x), *rate = allocated(n, sizeof *rate);
    struct rotor rotor = new_exchange();
    REFUSED(&rotor, SetTime, NAN);
    REFUSED(&rotor, SetTime, INFINITY);
    DONE(&rotor, GetContinuousStates, x, n);
    for (size_t i = 0; i < n; i++) {
        double right = x[i];
        x[i] = NAN;
        CHECK(fmi.SetContinuousStates(rotor.component, x, n) != fmi2OK ||
                  fmi.GetDerivatives(rotor.component, rate, n) != fmi2OK,
              "state %zu may be no number", i);
        x[i] = right;
        DONE(&rotor, SetContinuousStates, x, n);
        DONE(&rotor, GetDerivatives, rate, n);
    }
    free_rotor(&rotor);
    free(x);
    free(rate);
}

/* Calls in the wrong mode. */
static void modes(void)
{
    size_t n = states.count;
    fmi2Real *x = allocated(n, sizeof *x);
    fmi2Boolean enter, terminate;
    fmi2EventInfo info;
    fmi2Real value = 0.0;
    const struct variable *mass = variable("rotor.m");
    struct rotor rotor = new_rotor(fmi2ModelExchange);
    REFUSED_PLAIN(&rotor, EnterEventMode);
    REFUSED_PLAIN(&rotor, EnterContinuousTimeMode);
    REFUSED(&rotor, CompletedIntegratorStep, fmi2True, &enter, &terminate);
    REFUSED(&rotor, SetContinuousStates, x, n);
    REFUSED(&rotor, NewDiscreteStates, &info);
    initialize(&rotor);
    REFUSED_PLAIN(&rotor, EnterInitializationMode);
    REFUSED(&rotor, CompletedIntegratorStep, fmi2True, &enter, &terminate);
    REFUSED(&rotor, DoStep, time_at(0), 0.01, fmi2True);
    REFUSED(&rotor, SetContinuousStates, x, n);
    enter_continuous_time(&rotor);
    REFUSED(&rotor, NewDiscreteStates, &info);
    REFUSED_PLAIN(&rotor, EnterContinuousTimeMode);
    REFUSED(&rotor, DoStep, time_at(0), 0.01, fmi2True);
    REFUSED(&rotor, SetReal, &mass->reference, 1, &mass->start);
    if (n > 0) {
        REFUSED(&rotor, SetReal, states.references, 1, &value);
        REFUSED(&rotor, SetReal, states.derivatives, 1, &value);
    }
    REFUSED(&rotor, GetRealStatus, fmi2LastSuccessfulTime, &value);
    DONE_PLAIN(&rotor, EnterEventMode);
    REFUSED_PLAIN(&rotor, EnterEventMode);
    enter_continuous_time(&rotor);
    DONE_PLAIN(&rotor, Terminate);
    REFUSED_PLAIN(&rotor, EnterEventMode);
    DONE_PLAIN(&rotor, Reset);
    initialize(&rotor);
    enter_continuous_time(&rotor);
    free_rotor(&rotor);
    free(x);
}

/* A state saved on the way, also as bytes, goes on with the same bits; one of the other kind is refused. */
static void saved_on_the_way(void)
{
    enum { BEFORE = 200, AFTER = 300 };
    const double h = SPAN / STEPS, middle = time_at(0) + BEFORE * h;
    fmi2Real *straight = new_trace(1), *again = new_trace(1);
    fmi2FMUstate state = NULL;
    struct rotor rotor = new_exchange();
    integrate(&rotor, time_at(0), h, BEFORE);
    DONE(&rotor, GetFMUstate, &state);
    integrate(&rotor, middle, h, AFTER);
    read_reals(&rotor, straight);
    DONE(&rotor, SetFMUstate, state);
    integrate(&rotor, middle, h, AFTER);
    read_reals(&rotor, again);
    CHECK(same_bits(straight, again, real_count), "what follows a saved state has other bits");
    if (claims("ModelExchange.canSerializeFMUstate")) {
        DONE(&rotor, SetFMUstate, state);
        struct saved saved = save(&rotor);
        struct rotor other = new_rotor(fmi2ModelExchange);
        restore(&other, saved);
        integrate(&other, middle, h, AFTER);
        read_reals(&other, again);
        CHECK(same_bits(straight, again, real_count), "what follows the bytes has other bits");
        free_rotor(&other);
        /* The bytes of the other kind: they are refused, or the state that they make. */
        fmi2FMUstate foreign = NULL;
        other = new_rotor(fmi2CoSimulation);
        if (fmi.DeSerializeFMUstate(other.component, saved.bytes, saved.size, &foreign) == fmi2OK) {
            REFUSED(&other, SetFMUstate, foreign);
            DONE(&other, FreeFMUstate, &foreign);
        }
        initialize(&other);
        free_rotor(&other);
        free(saved.bytes);
    }
    DONE(&rotor, FreeFMUstate, &state);
    free_rotor(&rotor);
    free(straight);
    free(again);
}

void model_exchange(void)
{
    if (!has_model_exchange()) {
        return;
    }
    CHECK(states.count > 0, "the XML lists no states");
    lists();
    no_numbers();
    modes();
    against_co_simulation();
    if (claims("ModelExchange.canGetAndSetFMUstate")) {
        saved_on_the_way();
    }
}
