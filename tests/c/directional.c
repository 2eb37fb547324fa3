/* Directional derivatives: in model exchange of derivatives and outputs with respect to states and inputs, in
   co-simulation of outputs with respect to inputs; each against central differences, and linear in the seed. */
#include "exchange.h"
#include "parts.h"
#include "rotor.h"

#include <math.h>
#include <stdlib.h>

/* Difference in parts of the nominal value of what is varied, and how far the derivative may be off: in parts of its
   size, and of the value's size, which rounds. */
static const double STEP = 1e-5;
static const double BOUND = 1e-6;

struct problem {
    struct rotor *rotor;
    fmi2ValueReference *unknowns, *knowns;
    double *nominals;
    size_t unknown_count, known_count;
    /* How many of the knowns are states, which come first. */
    size_t state_count;
};

static struct problem new_problem(struct rotor *rotor, bool with_states)
{
    fmi2ValueReference *inputs, *outputs;
    size_t input_count = references_of('R', "input", &inputs), output_count = smooth_outputs(&outputs);
    size_t n = with_states ? states.count : 0;
    struct problem it = {.rotor = rotor, .state_count = n, .known_count = n + input_count};
    it.unknowns = allocated(n + output_count, sizeof *it.unknowns);
    it.knowns = allocated(it.known_count, sizeof *it.knowns);
    it.nominals = allocated(it.known_count, sizeof *it.nominals);
    for (size_t i = 0; i < n; i++) {
        it.unknowns[it.unknown_count++] = states.derivatives[i];
        it.knowns[i] = states.references[i];
    }
    if (n > 0) {
        DONE(rotor, GetNominalsOfContinuousStates, it.nominals, n);
    }
    for (size_t i = 0; i < input_count; i++) {
        it.knowns[n + i] = inputs[i];
        it.nominals[n + i] = 1.0;
    }
    for (size_t i = 0; i < output_count; i++) {
        it.unknowns[it.unknown_count++] = outputs[i];
    }
    free(inputs);
    free(outputs);
    return it;
}

static void free_problem(struct problem *it)
{
    free(it->unknowns);
    free(it->knowns);
    free(it->nominals);
}

/* Sets the known `j` to a value and reads the unknowns. */
static void unknowns_at(const struct problem *it, size_t j, double value, fmi2Real *y)
{
    fmi2Real *x = allocated(it->state_count, sizeof *x);
    if (j < it->state_count) {
        DONE(it->rotor, GetContinuousStates, x, it->state_count);
        x[j] = value;
        DONE(it->rotor, SetContinuousStates, x, it->state_count);
    } else {
        DONE(it->rotor, SetReal, &it->knowns[j], 1, &value);
    }
    DONE(it->rotor, GetReal, it->unknowns, it->unknown_count, y);
    free(x);
}

/* The derivative with respect to known `j` alone, against differences; it is added to `sum`. */
static void column(const struct problem *it, size_t j, fmi2Real *sum)
{
    size_t m = it->unknown_count;
    fmi2Real *before = allocated(m, sizeof *before), *above = allocated(m, sizeof *above);
    fmi2Real *below = allocated(m, sizeof *below), *found = allocated(m, sizeof *found), value, one = 1.0;
    double h = STEP * it->nominals[j];
    DONE(it->rotor, GetReal, &it->knowns[j], 1, &value);
    DONE(it->rotor, GetReal, it->unknowns, m, before);
    DONE(it->rotor, GetDirectionalDerivative, it->unknowns, m, &it->knowns[j], 1, &one, found);
    unknowns_at(it, j, value + h, above);
    unknowns_at(it, j, value - h, below);
    double width = (value + h) - (value - h);
    for (size_t i = 0; i < m; i++) {
        double change = (above[i] - below[i]) / width * it->nominals[j], off = found[i] * it->nominals[j] - change;
        CHECK(fabs(off) <= BOUND * fmax(1.0, fmax(fabs(change), fabs(before[i]))),
              "the variable %u by %u: %.12g, and %.12g by differences", it->unknowns[i], it->knowns[j], found[i],
              change / it->nominals[j]);
        sum[i] += found[i];
    }
    unknowns_at(it, j, value, above);
    CHECK(same_bits(before, above, m), "the way there and back changes something");
    free(before);
    free(above);
    free(below);
    free(found);
}

/* All columns, and all at once. */
static void compare(const struct problem *it)
{
    size_t m = it->unknown_count, n = it->known_count;
    fmi2Real *sum = allocated(m, sizeof *sum), *found = allocated(m, sizeof *found), *seed = allocated(n, sizeof *seed);
    for (size_t j = 0; j < n; j++) {
        column(it, j, sum);
        seed[j] = 1.0;
    }
    DONE(it->rotor, GetDirectionalDerivative, it->unknowns, m, it->knowns, n, seed, found);
    for (size_t i = 0; i < m; i++) {
        CHECK(fabs(found[i] - sum[i]) <= 1e-12 * fmax(1.0, fabs(sum[i])) * (double)(n + 1),
              "the variable %u: %.17g at once, %.17g one by one", it->unknowns[i], found[i], sum[i]);
    }
    free(sum);
    free(found);
    free(seed);
}

/* What is no unknown, no known or no number. */
static void wrong(struct rotor *rotor, fmi2ValueReference unknown, fmi2ValueReference known)
{
    const fmi2ValueReference mass = variable("rotor.m")->reference, none = NO_VARIABLE;
    fmi2Real one = 1.0, nan = NAN, found = 0.5;
    REFUSED(rotor, GetDirectionalDerivative, &none, 1, &known, 1, &one, &found);
    REFUSED(rotor, GetDirectionalDerivative, &mass, 1, &known, 1, &one, &found);
    REFUSED(rotor, GetDirectionalDerivative, &unknown, 1, &none, 1, &one, &found);
    REFUSED(rotor, GetDirectionalDerivative, &unknown, 1, &mass, 1, &one, &found);
    REFUSED(rotor, GetDirectionalDerivative, &unknown, 1, &unknown, 1, &one, &found);
    CHECK(found == 0.5, "what is refused writes");
    CHECK(fmi.GetDirectionalDerivative(rotor->component, &unknown, 1, &known, 1, &nan, &found) != fmi2OK ||
              isnan(found),
          "a seed that is no number gives %g", found);
}

static void in_model_exchange(void)
{
    enum { PLACES = 3, STEPS = 150 };
    const double h = 1e-3;
    struct rotor rotor = new_rotor(fmi2ModelExchange);
    initialize(&rotor);
    enter_continuous_time(&rotor);
    for (int i = 0; i < PLACES; i++) {
        struct problem it = new_problem(&rotor, true);
        compare(&it);
        wrong(&rotor, states.derivatives[0], states.references[0]);
        free_problem(&it);
        integrate(&rotor, time_at(0) + i * STEPS * h, h, STEPS);
    }
    free_rotor(&rotor);
}

static void in_co_simulation(void)
{
    struct rotor rotor = started_rotor();
    for (int i = 0; i < 3; i++) {
        struct problem it = new_problem(&rotor, false);
        compare(&it);
        if (it.known_count > 0) {
            wrong(&rotor, it.unknowns[0], it.knowns[0]);
        }
        free_problem(&it);
        run(&rotor, i, 1, NULL);
    }
    free_rotor(&rotor);
}

void directional(void)
{
    if (claims("ModelExchange.providesDirectionalDerivative")) {
        in_model_exchange();
    }
    if (claims("CoSimulation.providesDirectionalDerivative")) {
        in_co_simulation();
    }
}
