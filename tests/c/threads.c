/* 64 instances on 8 threads: each instance goes from thread to thread, is freed by another than made it, and has the
   bits of an instance alone. */
#include "exchange.h"
#include "parts.h"
#include "rotor.h"

#include <pthread.h>
#include <stdlib.h>

enum { THREADS = 8, INSTANCES = 64, STEPS = 25 };

/* A step of the host's own [s]. */
static const double SHORT = 1e-7;

static struct rotor rotors[INSTANCES];
static fmi2Real *traces[INSTANCES];
static pthread_barrier_t barrier;

static bool is_exchange(int which)
{
    return which % 4 == 3;
}

/* Each instance has a motion of its own; every fourth is one for model exchange. */
static struct rotor started(int which)
{
    const struct variable *spin = variable("start.omega.x");
    fmi2Real value = spin->start + 0.5 * which;
    struct rotor rotor = new_rotor(is_exchange(which) ? fmi2ModelExchange : fmi2CoSimulation);
    DONE(&rotor, SetReal, &spin->reference, 1, &value);
    initialize(&rotor);
    if (is_exchange(which)) {
        enter_continuous_time(&rotor);
    }
    return rotor;
}

/* A step, and all Reals at its end. */
static void advance(struct rotor *rotor, int which, int step, fmi2Real *trace)
{
    trace += (size_t)step * real_count;
    if (is_exchange(which)) {
        /* So short that it does no harm in any scene. */
        integrate(rotor, time_at(0) + step * SHORT, SHORT, 1);
        read_reals(rotor, trace);
    } else {
        run(rotor, step, 1, trace);
    }
}

/* From one step to the next a thread hands its instances on. */
static void *go_round(void *pointer)
{
    int thread = (int)((struct rotor *)pointer - rotors);
    for (int i = thread; i < INSTANCES; i += THREADS) {
        rotors[i] = started(i);
    }
    for (int step = 0; step <= STEPS; step++) {
        pthread_barrier_wait(&barrier);
        for (int i = (thread + step + 1) % THREADS; i < INSTANCES; i += THREADS) {
            if (step < STEPS) {
                advance(&rotors[i], i, step, traces[i]);
            } else {
                free_rotor(&rotors[i]);
            }
        }
    }
    return NULL;
}

void threads(void)
{
    pthread_t thread[THREADS];
    fmi2Real *alone = new_trace(STEPS);
    for (int i = 0; i < INSTANCES; i++) {
        traces[i] = new_trace(STEPS);
    }
    pthread_barrier_init(&barrier, NULL, THREADS);
    for (int i = 0; i < THREADS; i++) {
        if (!CHECK(pthread_create(&thread[i], NULL, go_round, &rotors[i]) == 0, "thread %d does not start", i)) {
            /* The others would wait for it for ever. */
            exit(1);
        }
    }
    for (int i = 0; i < THREADS; i++) {
        pthread_join(thread[i], NULL);
    }
    pthread_barrier_destroy(&barrier);
    for (int i = 0; i < INSTANCES; i++) {
        struct rotor rotor = started(i);
        for (int step = 0; step < STEPS; step++) {
            advance(&rotor, i, step, alone);
        }
        free_rotor(&rotor);
        CHECK(same_bits(alone, traces[i], STEPS * real_count), "instance %d has other bits among others than alone", i);
        free(traces[i]);
    }
    free(alone);
}
