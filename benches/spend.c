/* A run of an FMU, for a tool that counts instructions within fmi2DoStep:

       spend SHEET LIBRARY STEPS STEP [NAME=VALUE ...]

   sets what is named, takes so many communication steps of STEP seconds, and tells what the solver evaluated. */
#include "instance.h"
#include "sheet.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static fmi2Component rotor;

/* NAME=VALUE, whatever its type. */
static void set(char *given)
{
    char *value = strchr(given, '=');
    if (value == NULL) {
        must(fmi2Error, "NAME=VALUE is needed");
    }
    *value++ = '\0';
    const struct variable *it = variable(given);
    if (it == NULL) {
        must(fmi2Error, given);
    }
    fmi2Real real = strtod(value, NULL);
    fmi2Integer integer = (fmi2Integer)real;
    if (it->type == 'R') {
        must(fmi.SetReal(rotor, &it->reference, 1, &real), given);
    } else if (it->type == 'B') {
        must(fmi.SetBoolean(rotor, &it->reference, 1, &integer), given);
    } else {
        must(fmi.SetInteger(rotor, &it->reference, 1, &integer), given);
    }
}

int main(int count, char **arguments)
{
    if (count < 5) {
        must(fmi2Error, "usage: spend SHEET LIBRARY STEPS STEP [NAME=VALUE ...]");
    }
    read_sheet(arguments[1]);
    load_library(arguments[2]);
    int steps = atoi(arguments[3]);
    double step = strtod(arguments[4], NULL);
    rotor = instantiate(fmi2CoSimulation);
    for (int i = 5; i < count; i++) {
        set(arguments[i]);
    }
    initialize(rotor);
    for (int i = 0; i < steps; i++) {
        MUST(DoStep, rotor, i * step, step, fmi2True);
    }
    fmi2Real evaluations;
    MUST(GetReal, rotor, &variable("solver.evaluations")->reference, 1, &evaluations);
    printf("%.0f\n", evaluations);
    fmi.FreeInstance(rotor);
    return 0;
}
