/* 64 instances on 8 threads, each thread going round among its own: the bits are those of an instance alone. */
#include "parts.h"
#include "rotor.h"

#include <pthread.h>
#include <stdlib.h>

enum { THREADS = 8, EACH = 8, STEPS = 25 };

/* Each instance has a motion of its own. */
static struct rotor started(int which)
{
    const struct variable *spin = variable("start.omega.x");
    fmi2Real value = spin->start + 0.5 * which;
    struct rotor rotor = new_rotor(fmi2CoSimulation);
    DONE(&rotor, SetReal, &spin->reference, 1, &value);
    initialize(&rotor);
    return rotor;
}

struct work {
    int thread;
    fmi2Real *traces[EACH];
};

static void *go_round(void *pointer)
{
    struct work *work = pointer;
    struct rotor rotors[EACH];
    for (int i = 0; i < EACH; i++) {
        rotors[i] = started(work->thread * EACH + i);
    }
    for (int step = 0; step < STEPS; step++) {
        for (int i = 0; i < EACH; i++) {
            run(&rotors[i], step, 1, work->traces[i] + (size_t)step * real_count);
        }
    }
    for (int i = 0; i < EACH; i++) {
        free_rotor(&rotors[i]);
    }
    return NULL;
}

void threads(void)
{
    pthread_t thread[THREADS];
    struct work work[THREADS];
    fmi2Real *alone = new_trace(STEPS);
    for (int i = 0; i < THREADS; i++) {
        work[i].thread = i;
        for (int j = 0; j < EACH; j++) {
            work[i].traces[j] = new_trace(STEPS);
        }
        CHECK(pthread_create(&thread[i], NULL, go_round, &work[i]) == 0, "thread %d does not start", i);
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(thread[i], NULL);
    }
    for (int i = 0; i < THREADS * EACH; i++) {
        fmi2Real *trace = work[i / EACH].traces[i % EACH];
        struct rotor rotor = started(i);
        run(&rotor, 0, STEPS, alone);
        free_rotor(&rotor);
        CHECK(same_bits(alone, trace, STEPS * real_count), "instance %d has other bits among others than alone", i);
        free(trace);
    }
    free(alone);
}
