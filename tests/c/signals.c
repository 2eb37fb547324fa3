/* Derivatives of inputs, with which a step follows a signal exactly, and of outputs, against differences. */
#include "parts.h"
#include "rotor.h"

#include <math.h>
#include <stdlib.h>

/* A signal of order two in the time since the start [s]; its value and derivatives. */
static const double SIGNAL[3] = {0.1, -0.8, 1.5};

static void signal_at(double t, fmi2Real derivatives[3])
{
    t -= time_at(0);
    derivatives[0] = SIGNAL[0] + t * (SIGNAL[1] + t * SIGNAL[2]);
    derivatives[1] = SIGNAL[1] + 2.0 * t * SIGNAL[2];
    derivatives[2] = 2.0 * SIGNAL[2];
}

/* Half a second in `steps` steps, each told the signal with its derivatives up to `order`: where it ends. */
static void follow(int steps, int order, fmi2Real *end)
{
    const double span = 0.5;
    fmi2ValueReference *inputs;
    size_t count = references_of('R', "input", &inputs);
    const fmi2Integer orders[2] = {1, 2};
    struct rotor rotor = started_rotor();
    for (int i = 0; i < steps; i++) {
        double t = time_at(0) + span * i / steps;
        fmi2Real signal[3];
        signal_at(t, signal);
        for (size_t j = 0; j < count; j++) {
            const fmi2ValueReference twice[2] = {inputs[j], inputs[j]};
            DONE(&rotor, SetReal, &inputs[j], 1, signal);
            DONE(&rotor, SetRealInputDerivatives, twice, (size_t)order, orders, signal + 1);
        }
        DONE(&rotor, DoStep, t, span / steps, fmi2True);
    }
    read_reals(&rotor, end);
    free_rotor(&rotor);
    free(inputs);
}

/* The difference of two ends in the motion's angle. */
static double difference(const fmi2Real *a, const fmi2Real *b)
{
    for (size_t i = 0; i < real_count; i++) {
        if (reals[i] == variable("phi")->reference) {
            return fabs(a[i] - b[i]);
        }
    }
    return NAN;
}

/* How far phi [rad] may depend on the steps with both derivatives; measured 2e-14, and 4e-4 with one, 4e-3 held. */
static const double EXACT = 1e-10;

/* With both derivatives the end does not depend on the steps; with less, it does. */
static void input_derivatives(void)
{
    fmi2Real *exact = new_trace(1), *other = new_trace(1);
    follow(1, 2, exact);
    follow(64, 2, other);
    double second = difference(exact, other);
    follow(16, 1, other);
    double first = difference(exact, other);
    follow(16, 0, other);
    double held = difference(exact, other);
    CHECK(second <= EXACT, "with both derivatives phi depends on the steps by %g", second);
    CHECK(first > 1e3 * EXACT && held > 2.0 * first, "phi is off by %g held, %g with one derivative, %g with two", held,
          first, second);
    free(exact);
    free(other);
}

static void wrong_input_derivatives(const fmi2ValueReference *input)
{
    const fmi2Integer orders[] = {0, -1, 3, 100}, one = 1;
    const fmi2ValueReference output = variable("phi")->reference, none = NO_VARIABLE;
    const fmi2Real bad[] = {NAN, INFINITY}, value = 0.5;
    fmi2Real *straight = new_trace(1), *disturbed = new_trace(1);
    struct rotor rotor = started_rotor();
    run(&rotor, 0, 1, straight);
    free_rotor(&rotor);
    rotor = started_rotor();
    for (size_t i = 0; i < sizeof orders / sizeof *orders; i++) {
        REFUSED(&rotor, SetRealInputDerivatives, input, 1, &orders[i], &value);
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        REFUSED(&rotor, SetRealInputDerivatives, input, 1, &one, &bad[i]);
    }
    REFUSED(&rotor, SetRealInputDerivatives, &output, 1, &one, &value);
    REFUSED(&rotor, SetRealInputDerivatives, &none, 1, &one, &value);
    run(&rotor, 0, 1, disturbed);
    CHECK(same_bits(straight, disturbed, real_count), "refused derivatives change the run");
    free_rotor(&rotor);
    free(straight);
    free(disturbed);
}

/* dy/dt in the middle of two short steps is their difference quotient. */
static void output_derivatives(void)
{
    const double h = 1e-5, bound = 1e-4;
    const fmi2Integer one = 1;
    fmi2ValueReference *outputs;
    size_t count = smooth_outputs(&outputs);
    fmi2Integer *orders = allocated(count, sizeof *orders);
    fmi2Real *before = allocated(count, sizeof *before), *after = allocated(count, sizeof *after);
    fmi2Real *rates = allocated(count, sizeof *rates);
    for (size_t i = 0; i < count; i++) {
        orders[i] = 1;
    }
    struct rotor rotor = started_rotor();
    run(&rotor, 0, 10, NULL);
    double t = time_at(10);
    DONE(&rotor, GetReal, outputs, count, before);
    DONE(&rotor, DoStep, t, h, fmi2True);
    DONE(&rotor, GetRealOutputDerivatives, outputs, count, orders, rates);
    DONE(&rotor, DoStep, t + h, h, fmi2True);
    DONE(&rotor, GetReal, outputs, count, after);
    for (size_t i = 0; i < count; i++) {
        double quotient = (after[i] - before[i]) / (2.0 * h), scale = fmax(1.0, fmax(fabs(quotient), fabs(after[i])));
        CHECK(fabs(rates[i] - quotient) <= bound * scale, "the derivative of %u is %.12g, and %.12g by differences",
              outputs[i], rates[i], quotient);
    }
    const struct variable *mass = variable("rotor.m");
    const fmi2Integer wrong[] = {0, -1, 2};
    const fmi2ValueReference none = NO_VARIABLE;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        REFUSED(&rotor, GetRealOutputDerivatives, outputs, 1, &wrong[i], rates);
    }
    REFUSED(&rotor, GetRealOutputDerivatives, &mass->reference, 1, &one, rates);
    REFUSED(&rotor, GetRealOutputDerivatives, &none, 1, &one, rates);
    free_rotor(&rotor);
    free(outputs);
    free(orders);
    free(before);
    free(after);
    free(rates);
}

void signals(void)
{
    fmi2ValueReference *inputs;
    size_t count = references_of('R', "input", &inputs);
    if (count > 0 && claims("CoSimulation.canInterpolateInputs")) {
        input_derivatives();
        wrong_input_derivatives(inputs);
    }
    free(inputs);
    if (number("CoSimulation.maxOutputDerivativeOrder") >= 1.0) {
        output_derivatives();
    }
}
