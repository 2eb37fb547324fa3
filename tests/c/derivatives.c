/* Derivatives of every kind are asked for, in both kinds of instance: those of inputs are taken, all others are finite. */
#include "exchange.h"
#include "parts.h"
#include "rotor.h"

#include <math.h>
#include <stdlib.h>

/* By each known alone, and by all at once. */
static void directional(struct rotor *rotor, const fmi2ValueReference *knowns, size_t n)
{
    fmi2ValueReference *outputs;
    size_t m = references_of('R', "output", &outputs);
    fmi2Real *seeds = allocated(n, sizeof *seeds), *found = allocated(m, sizeof *found);
    for (size_t j = 0; j < n; j++) {
        seeds[j] = 1.0;
        DONE(rotor, GetDirectionalDerivative, outputs, m, &knowns[j], 1, &seeds[j], found);
    }
    DONE(rotor, GetDirectionalDerivative, outputs, m, knowns, n, seeds, found);
    for (size_t i = 0; i < m; i++) {
        CHECK(isfinite(found[i]), "the derivative of %u is %g", outputs[i], found[i]);
    }
    free(seeds);
    free(found);
    free(outputs);
}

static void of_outputs(struct rotor *rotor)
{
    fmi2ValueReference *outputs;
    size_t count = references_of('R', "output", &outputs);
    fmi2Integer *orders = allocated(count, sizeof *orders);
    fmi2Real *rates = allocated(count, sizeof *rates);
    for (size_t i = 0; i < count; i++) {
        orders[i] = 1;
    }
    DONE(rotor, GetRealOutputDerivatives, outputs, count, orders, rates);
    for (size_t i = 0; i < count; i++) {
        CHECK(isfinite(rates[i]), "the rate of %u is %g", outputs[i], rates[i]);
    }
    free(orders);
    free(rates);
    free(outputs);
}

void derivatives(void)
{
    const fmi2Integer orders[2] = {1, 2};
    const fmi2Real sent[2] = {-0.8, 1.5};
    fmi2ValueReference *inputs;
    size_t count = references_of('R', "input", &inputs);
    struct rotor rotor = started_rotor();
    for (int i = 0; i < 3; i++) {
        for (size_t j = 0; j < count; j++) {
            const fmi2ValueReference twice[2] = {inputs[j], inputs[j]};
            DONE(&rotor, SetRealInputDerivatives, twice, 2, orders, sent);
        }
        of_outputs(&rotor);
        directional(&rotor, inputs, count);
        run(&rotor, i, 1, NULL);
    }
    free_rotor(&rotor);
    free(inputs);
    rotor = new_rotor(fmi2ModelExchange);
    initialize(&rotor);
    enter_continuous_time(&rotor);
    directional(&rotor, states.references, states.count);
    free_rotor(&rotor);
}
