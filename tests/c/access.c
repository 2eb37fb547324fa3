/* Every variable through the getter and the setter of its type: it starts as the XML says, and keeps what is set where it may be
   set. What other types than its own are told, tests/interface/arguments.rs tests; here it is done once, with strings. */
#include "parts.h"
#include "rotor.h"

#include <math.h>

static void each_real(struct rotor *rotor, const struct variable *it, bool may_be_set)
{
    fmi2Real value, other = it->start + 0.125, found;
    DONE(rotor, GetReal, &it->reference, 1, &value);
    CHECK(isfinite(value), "%s is %g", it->name, value);
    if (may_be_set) {
        CHECK(same_bits(&value, &it->start, 1), "%s starts with %.17g, not %.17g", it->name, value, it->start);
        DONE(rotor, SetReal, &it->reference, 1, &other);
        DONE(rotor, GetReal, &it->reference, 1, &found);
        CHECK(same_bits(&found, &other, 1), "%s does not keep what is set", it->name);
        DONE(rotor, SetReal, &it->reference, 1, &value);
    }
}

/* fmi2Integer and fmi2Boolean are one type in C. */
#define EACH(type, function, another) \
    static void each_##type(struct rotor *rotor, const struct variable *it, bool may_be_set) \
    { \
        int value, other, found; \
        DONE(rotor, Get##function, &it->reference, 1, &value); \
        if (may_be_set) { \
            CHECK(value == it->start, "%s starts with %d, not %g", it->name, value, it->start); \
            other = another; \
            DONE(rotor, Set##function, &it->reference, 1, &other); \
            DONE(rotor, Get##function, &it->reference, 1, &found); \
            CHECK(found == other, "%s does not keep what is set", it->name); \
            DONE(rotor, Set##function, &it->reference, 1, &value); \
        } \
    }
EACH(integer, Integer, value + 1)
EACH(boolean, Boolean, !value)

static void each(struct rotor *rotor, bool before_start)
{
    for (size_t i = 0; i < variable_count; i++) {
        const struct variable *it = &variables[i];
        fmi2String text = NULL, other = "text";
        (it->type == 'R' ? each_real : it->type == 'B' ? each_boolean : each_integer)(rotor, it,
                                                                                       before_start && it->has_start);
        REFUSED(rotor, GetString, &it->reference, 1, &text);
        CHECK(text == NULL, "fmi2GetString of %s writes", it->name);
        REFUSED(rotor, SetString, &it->reference, 1, &other);
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
