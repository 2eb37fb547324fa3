/* Model exchange as a host does it: events, and a Runge-Kutta loop. */
#ifndef EXCHANGE_H
#define EXCHANGE_H

#include "rotor.h"

#include <stdbool.h>

/* From event mode, events iterated until no more are needed, to continuous-time mode. */
void enter_continuous_time(struct rotor *rotor);

/* Integrates with the classical method of order four from `start` [s] over `count` steps of `h` [s], with
   the inputs of set_inputs, and leaves the instance there. It must be in continuous-time mode. How many events there
   were. */
int integrate(struct rotor *rotor, double start, double h, int count);

#endif
