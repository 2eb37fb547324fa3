/* Model exchange: the host's own Runge-Kutta loop arrives where co-simulation does. */
#include "exchange.h"
#include "parts.h"
#include "rotor.h"

#include <math.h>
#include <stdlib.h>

/* Steps over a span of half a second. */
enum { STEPS = 1000 };
static const double SPAN = 0.5;

/* The difference to co-simulation, in parts of the larger of a value's size and 1; measured 2.6e-6
   (free_top). */
static const double BOUND = 1e-5;
/* The tolerance of co-simulation. */
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

void model_exchange(void)
{
    if (!has_model_exchange()) {
        return;
    }
    fmi2ValueReference *outputs;
    size_t count = smooth_outputs(&outputs);
    fmi2Real *expected = allocated(count, sizeof *expected), *values = allocated(count, sizeof *values);
    fmi2Real *nominals = allocated(states.count, sizeof *nominals);
    const struct variable *chart = variable("state.chart");
    fmi2Integer first = 0, last = 0;
    reference(outputs, count, expected);
    struct rotor rotor = new_exchange();
    DONE(&rotor, GetNominalsOfContinuousStates, nominals, states.count);
    DONE(&rotor, GetInteger, &chart->reference, 1, &first);
    int events = integrate(&rotor, time_at(0), SPAN / STEPS, STEPS);
    DONE(&rotor, GetInteger, &chart->reference, 1, &last);
    CHECK(first == last || events > 0, "the chart went from %d to %d without an event", first, last);
    DONE(&rotor, GetReal, outputs, count, values);
    DONE_PLAIN(&rotor, Terminate);
    free_rotor(&rotor);
    for (size_t i = 0; i < count; i++) {
        double difference = fabs(values[i] - expected[i]) / fmax(1.0, fabs(expected[i]));
        CHECK(difference <= BOUND, "the variable %u differs by %g from co-simulation", outputs[i], difference);
    }
    free(nominals);
    free(values);
    free(expected);
    free(outputs);
}
