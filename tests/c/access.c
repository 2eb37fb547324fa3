/* Every variable through every getter and setter: its own type reads it, and keeps what is set where it may be set; the
   other types are refused and write nothing. */
#include "parts.h"
#include "rotor.h"

#include <math.h>
#include <string.h>

static const struct type {
    char letter;
    const char *getter, *setter;
} TYPES[] = {
    {'R', "fmi2GetReal", "fmi2SetReal"},
    {'I', "fmi2GetInteger", "fmi2SetInteger"},
    {'B', "fmi2GetBoolean", "fmi2SetBoolean"},
    {'S', "fmi2GetString", "fmi2SetString"},
};
enum { TYPE_COUNT = sizeof TYPES / sizeof *TYPES };

union value {
    fmi2Real real;
    fmi2Integer integer;
    fmi2Boolean boolean;
    fmi2String string;
};

static fmi2Status get(struct rotor *rotor, char type, fmi2ValueReference reference, union value *value)
{
    rotor->journal->count = 0;
    switch (type) {
    case 'R':
        return fmi.GetReal(rotor->component, &reference, 1, &value->real);
    case 'I':
        return fmi.GetInteger(rotor->component, &reference, 1, &value->integer);
    case 'B':
        return fmi.GetBoolean(rotor->component, &reference, 1, &value->boolean);
    default:
        return fmi.GetString(rotor->component, &reference, 1, &value->string);
    }
}

static fmi2Status set(struct rotor *rotor, char type, fmi2ValueReference reference, const union value *value)
{
    rotor->journal->count = 0;
    switch (type) {
    case 'R':
        return fmi.SetReal(rotor->component, &reference, 1, &value->real);
    case 'I':
        return fmi.SetInteger(rotor->component, &reference, 1, &value->integer);
    case 'B':
        return fmi.SetBoolean(rotor->component, &reference, 1, &value->boolean);
    default:
        return fmi.SetString(rotor->component, &reference, 1, &value->string);
    }
}

/* The getter and the setter of another type than the variable's. */
static void refused(struct rotor *rotor, const struct variable *it, const struct type *type)
{
    union value value, untouched;
    memset(&value, 0x5a, sizeof value);
    untouched = value;
    was_refused(rotor, get(rotor, type->letter, it->reference, &value), type->getter, __FILE__, __LINE__);
    CHECK(memcmp(&value, &untouched, sizeof value) == 0, "%s of %s writes", type->getter, it->name);
    value.string = "text";
    was_refused(rotor, set(rotor, type->letter, it->reference, &value), type->setter, __FILE__, __LINE__);
}

/* Sets another value than the one at the start, reads it, and sets the old one again. */
static void changed(struct rotor *rotor, const struct variable *it, const struct type *type, union value value)
{
    union value other, found;
    double start = it->type == 'R' ? value.real : value.integer;
    CHECK(same_bits(&start, &it->start, 1), "%s starts with %.17g, not %.17g", it->name, start, it->start);
    memset(&other, 0, sizeof other);
    if (it->type == 'R') {
        other.real = it->start + 0.125;
    } else {
        other.integer = it->type == 'B' ? !value.boolean : value.integer + 1;
    }
    found = value;
    was_done(rotor, set(rotor, it->type, it->reference, &other), type->setter, __FILE__, __LINE__);
    was_done(rotor, get(rotor, it->type, it->reference, &found), type->getter, __FILE__, __LINE__);
    CHECK(it->type == 'R' ? same_bits(&found.real, &other.real, 1) : found.integer == other.integer,
          "%s does not keep what is set", it->name);
    was_done(rotor, set(rotor, it->type, it->reference, &value), type->setter, __FILE__, __LINE__);
}

/* Where `before_start`, what has a start value has still that of the XML. */
static void each(struct rotor *rotor, bool before_start)
{
    for (size_t i = 0; i < variable_count; i++) {
        const struct variable *it = &variables[i];
        for (size_t j = 0; j < TYPE_COUNT; j++) {
            const struct type *type = &TYPES[j];
            union value value;
            if (type->letter != it->type) {
                refused(rotor, it, type);
                continue;
            }
            was_done(rotor, get(rotor, it->type, it->reference, &value), type->getter, __FILE__, __LINE__);
            CHECK(it->type != 'R' || isfinite(value.real), "%s is %g", it->name, value.real);
            if (before_start && it->has_start) {
                changed(rotor, it, type, value);
            } else if (strcmp(it->causality, "input") != 0) {
                was_refused(rotor, set(rotor, it->type, it->reference, &value), type->setter, __FILE__, __LINE__);
            }
        }
    }
}

void access_variables(void)
{
    struct rotor rotor = new_rotor(fmi2CoSimulation);
    each(&rotor, true);
    DONE_PLAIN(&rotor, EnterInitializationMode);
    each(&rotor, true);
    DONE_PLAIN(&rotor, ExitInitializationMode);
    run(&rotor, 0, 1, NULL);
    each(&rotor, false);
    DONE_PLAIN(&rotor, Terminate);
    free_rotor(&rotor);
}
