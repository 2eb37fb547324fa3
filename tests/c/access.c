/* Every variable through every getter and setter: those of its own type work, the others are refused and write nothing.
 */
#include "parts.h"
#include "rotor.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char TYPES[] = "RIBS";

union value {
    fmi2Real real;
    fmi2Integer integer;
    fmi2Boolean boolean;
    fmi2String string;
};

static fmi2Status get(struct rotor *rotor, char type, const fmi2ValueReference *references, size_t n, void *values)
{
    rotor->journal->count = 0;
    switch (type) {
    case 'R':
        return fmi.GetReal(rotor->component, references, n, values);
    case 'I':
        return fmi.GetInteger(rotor->component, references, n, values);
    case 'B':
        return fmi.GetBoolean(rotor->component, references, n, values);
    default:
        return fmi.GetString(rotor->component, references, n, values);
    }
}

static fmi2Status set(struct rotor *rotor, char type, const fmi2ValueReference *references, size_t n,
                      const void *values)
{
    rotor->journal->count = 0;
    switch (type) {
    case 'R':
        return fmi.SetReal(rotor->component, references, n, values);
    case 'I':
        return fmi.SetInteger(rotor->component, references, n, values);
    case 'B':
        return fmi.SetBoolean(rotor->component, references, n, values);
    default:
        return fmi.SetString(rotor->component, references, n, values);
    }
}

static const char *getter(char type)
{
    return type == 'R'   ? "fmi2GetReal"
           : type == 'I' ? "fmi2GetInteger"
           : type == 'B' ? "fmi2GetBoolean"
                         : "fmi2GetString";
}

static const char *setter(char type)
{
    return type == 'R'   ? "fmi2SetReal"
           : type == 'I' ? "fmi2SetInteger"
           : type == 'B' ? "fmi2SetBoolean"
                         : "fmi2SetString";
}

/* Each variable alone by each getter, and after a good one in the same call: what is refused writes nothing. */
static void read_each(struct rotor *rotor)
{
    for (size_t i = 0; i < variable_count; i++) {
        for (const char *type = TYPES; *type != '\0'; type++) {
            union value value, untouched;
            memset(&value, 0x5a, sizeof value);
            untouched = value;
            fmi2Status status = get(rotor, *type, &variables[i].reference, 1, &value);
            if (*type == variables[i].type) {
                was_done(rotor, status, getter(*type), __FILE__, __LINE__);
                CHECK(*type != 'R' || isfinite(value.real), "%s is %g", variables[i].name, value.real);
            } else {
                was_refused(rotor, status, getter(*type), __FILE__, __LINE__);
                CHECK(memcmp(&value, &untouched, sizeof value) == 0, "%s of %s writes", getter(*type),
                      variables[i].name);
            }
        }
    }
    for (const char *type = TYPES; *type != '\0'; type++) {
        fmi2ValueReference *own, pair[2];
        size_t count = references_of(*type, NULL, &own);
        union value values[2], untouched[2];
        memset(values, 0x5a, sizeof values);
        memcpy(untouched, values, sizeof values);
        pair[0] = count == 0 ? NO_VARIABLE : own[0];
        pair[1] = NO_VARIABLE;
        was_refused(rotor, get(rotor, *type, pair, 2, values), getter(*type), __FILE__, __LINE__);
        CHECK(memcmp(values, untouched, sizeof values) == 0, "%s writes before it refuses", getter(*type));
        was_done(rotor, get(rotor, *type, pair, 0, values), getter(*type), __FILE__, __LINE__);
        free(own);
    }
}

/* All Reals in one call are those of as many calls. */
static void read_together(struct rotor *rotor)
{
    fmi2Real *together = new_trace(1);
    read_reals(rotor, together);
    for (size_t i = 0; i < real_count; i++) {
        fmi2Real alone = NAN;
        DONE(rotor, GetReal, &reals[i], 1, &alone);
        CHECK(same_bits(&alone, &together[i], 1), "the variable %u is %.17g alone and %.17g among others", reals[i],
              alone, together[i]);
    }
    free(together);
}

/* The start values are those of the XML, and can be set and read back. */
static void starts(struct rotor *rotor)
{
    for (size_t i = 0; i < variable_count; i++) {
        const struct variable *it = &variables[i];
        if (!it->has_start) {
            continue;
        }
        union value value, other;
        was_done(rotor, get(rotor, it->type, &it->reference, 1, &value), getter(it->type), __FILE__, __LINE__);
        double start = it->type == 'R' ? value.real : value.integer;
        CHECK(same_bits(&start, &it->start, 1), "%s starts with %.17g, not %.17g", it->name, start, it->start);
        if (it->type == 'R') {
            other.real = it->start + 0.125;
        } else {
            other.integer = it->type == 'B' ? !value.boolean : value.integer + 1;
        }
        was_done(rotor, set(rotor, it->type, &it->reference, 1, &other), setter(it->type), __FILE__, __LINE__);
        union value found = value;
        was_done(rotor, get(rotor, it->type, &it->reference, 1, &found), getter(it->type), __FILE__, __LINE__);
        CHECK(it->type == 'R' ? same_bits(&found.real, &other.real, 1) : found.integer == other.integer,
              "%s does not keep what is set", it->name);
        was_done(rotor, set(rotor, it->type, &it->reference, 1, &value), setter(it->type), __FILE__, __LINE__);
    }
}

/* What must not be set now is refused, with a good one before it too; then nothing is changed. */
static void refuse_each(struct rotor *rotor, bool before_start)
{
    fmi2Real *before = new_trace(1), *after = new_trace(1);
    read_reals(rotor, before);
    for (size_t i = 0; i < variable_count; i++) {
        const struct variable *it = &variables[i];
        bool settable =
            strcmp(it->causality, "input") == 0 || (before_start && strcmp(it->causality, "parameter") == 0);
        for (const char *type = TYPES; *type != '\0'; type++) {
            union value values[2];
            const fmi2ValueReference pair[2] = {it->reference, NO_VARIABLE};
            memset(values, 0, sizeof values);
            if (*type == 'R') {
                values[0].real = 0.25;
            } else if (*type == 'S') {
                values[0].string = values[1].string = "text";
            }
            if (!settable || *type != it->type) {
                was_refused(rotor, set(rotor, *type, pair, 1, values), setter(*type), __FILE__, __LINE__);
            }
            was_refused(rotor, set(rotor, *type, pair, 2, values), setter(*type), __FILE__, __LINE__);
        }
    }
    read_reals(rotor, after);
    CHECK(same_bits(before, after, real_count), "what is refused changes something");
    free(before);
    free(after);
}

/* A value that is no number is refused by the setter of an input, and the old one kept. */
static void bad_inputs(struct rotor *rotor)
{
    const double bad[] = {NAN, INFINITY, -INFINITY};
    fmi2ValueReference *inputs;
    size_t count = references_of('R', "input", &inputs);
    for (size_t i = 0; i < count; i++) {
        fmi2Real before = 0.0, old = 0.0625, value = 0.0;
        DONE(rotor, GetReal, &inputs[i], 1, &before);
        DONE(rotor, SetReal, &inputs[i], 1, &old);
        for (size_t j = 0; j < sizeof bad / sizeof *bad; j++) {
            REFUSED(rotor, SetReal, &inputs[i], 1, &bad[j]);
            DONE(rotor, GetReal, &inputs[i], 1, &value);
            CHECK(value == old, "an input refused is %g all the same", value);
        }
        DONE(rotor, SetReal, &inputs[i], 1, &before);
    }
    free(inputs);
}

/* A parameter that cannot be is named when initialization ends, and can be mended. */
static void bad_parameter(void)
{
    struct rotor rotor = new_rotor(fmi2CoSimulation);
    const struct variable *mass = variable("rotor.m");
    fmi2Real wrong = -1.0;
    DONE(&rotor, SetReal, &mass->reference, 1, &wrong);
    DONE_PLAIN(&rotor, EnterInitializationMode);
    REFUSED_PLAIN(&rotor, ExitInitializationMode);
    CHECK(strstr(rotor.journal->message, "rotor.m = -1") != NULL, "who is to blame? %s", rotor.journal->message);
    DONE(&rotor, SetReal, &mass->reference, 1, &mass->start);
    DONE_PLAIN(&rotor, ExitInitializationMode);
    free_rotor(&rotor);
}

void access_variables(void)
{
    struct rotor rotor = new_rotor(fmi2CoSimulation);
    starts(&rotor);
    read_each(&rotor);
    refuse_each(&rotor, true);
    bad_inputs(&rotor);
    DONE_PLAIN(&rotor, EnterInitializationMode);
    starts(&rotor);
    read_each(&rotor);
    refuse_each(&rotor, true);
    bad_inputs(&rotor);
    DONE_PLAIN(&rotor, ExitInitializationMode);
    for (int i = 0; i < 3; i++) {
        read_each(&rotor);
        read_together(&rotor);
        refuse_each(&rotor, false);
        bad_inputs(&rotor);
        run(&rotor, i, 1, NULL);
    }
    DONE_PLAIN(&rotor, Terminate);
    read_each(&rotor);
    read_together(&rotor);
    free_rotor(&rotor);
    bad_parameter();
}
