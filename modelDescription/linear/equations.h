/* The equations, dx/dt = A x + B (u - u0), y = y0 + C x + D (u - u0), and their motion over a step in closed form.

   Included once, by linear.c: all is static, so that several such models can be linked into one program. */
#ifndef EQUATIONS_H
#define EQUATIONS_H

#include "matrices.h"

#include <float.h>
#include <math.h>
#include <string.h>

struct square {
    double at[STATES][STATES];
};

/* What a step of one size does, with A constant: e^(A h) - 1, the integral of e^(A s), and that of e^(A (h - s)) s, s
 * from 0 to h. */
struct flow {
    double step; /* h [s]; 0 before the first step */
    struct square grown, held, ramp;
};

/* A row of A and B, or of C and D, times these columns. */
static double product(size_t row, const double columns[COLUMNS])
{
    double sum = 0.0;
    for (size_t j = 0; j < COLUMNS; j++) {
        sum += MATRIX[row][j] * columns[j];
    }
    return sum;
}

/* x and u - u0, from x and u. */
static void deviate(const double known[COLUMNS], double deviation[COLUMNS])
{
    for (size_t j = 0; j < COLUMNS; j++) {
        deviation[j] = known[j] - STEADY[j];
    }
}

/* factor a b, and this much more on the diagonal. */
static struct square multiplied(const struct square *a, const struct square *b, double factor, double diagonal)
{
    struct square result;
    for (size_t i = 0; i < STATES; i++) {
        for (size_t j = 0; j < STATES; j++) {
            double sum = 0.0;
            for (size_t k = 0; k < STATES; k++) {
                sum += a->at[i][k] * b->at[k][j];
            }
            result.at[i][j] = factor * sum + (i == j ? diagonal : 0.0);
        }
    }
    return result;
}

/* The largest sum of a row of |A| [1/s], each state in its nominal. */
static double norm(void)
{
    double largest = 0.0;
    for (size_t i = 0; i < STATES; i++) {
        double sum = 0.0;
        for (size_t j = 0; j < STATES; j++) {
            sum += fabs(MATRIX[i][j]) * (NOMINAL[j] / NOMINAL[i]);
        }
        largest = sum > largest ? sum : largest;
    }
    return largest;
}

/* Beyond this power of A h, where |A h| <= 1/2, a power series adds less than rounding does. */
enum { LAST = 16 };

/* The flow over a step [s]: the exponential of the matrix that A, held inputs and their rates make together, block by
   block. It is a power series over the step halved n times, doubled n times. What is doubled is e^(A h) - 1: e^(A h)
   itself would lose the digits of slow motions beside fast ones. */
static struct flow flow_over(double step)
{
    struct flow flow = {.step = step};
    struct square a, series = {{{0.0}}};
    int doublings = 0;
    double h = step;
    for (double rate = norm(); rate * h > 0.5; h *= 0.5) {
        doublings++;
    }
    for (size_t i = 0; i < STATES; i++) {
        memcpy(a.at[i], MATRIX[i], sizeof a.at[i]);
        series.at[i][i] = 1.0;
    }
    /* ramp = h^2/2 (1 + A h/3 (1 + A h/4 (...))), held = h + A ramp, grown = A held */
    for (int power = LAST; power > 2; power--) {
        series = multiplied(&a, &series, h / power, 1.0);
    }
    for (size_t i = 0; i < STATES; i++) {
        for (size_t j = 0; j < STATES; j++) {
            flow.ramp.at[i][j] = 0.5 * h * h * series.at[i][j];
        }
    }
    flow.held = multiplied(&a, &flow.ramp, 1.0, h);
    flow.grown = multiplied(&a, &flow.held, 1.0, 0.0);
    for (; doublings > 0; doublings--, h *= 2.0) {
        /* Over 2 h: ramp (2 + grown) + h held, held (2 + grown), grown (2 + grown) */
        struct square more = flow.grown, ramp;
        for (size_t i = 0; i < STATES; i++) {
            more.at[i][i] += 2.0;
        }
        ramp = multiplied(&more, &flow.ramp, 1.0, 0.0);
        for (size_t i = 0; i < STATES; i++) {
            for (size_t j = 0; j < STATES; j++) {
                flow.ramp.at[i][j] = ramp.at[i][j] + h * flow.held.at[i][j];
            }
        }
        flow.held = multiplied(&more, &flow.held, 1.0, 0.0);
        flow.grown = multiplied(&more, &flow.grown, 1.0, 0.0);
    }
    return flow;
}

/* States and inputs over the step of a flow, while the inputs go on with these rates; those of states are 0. */
static void advance(const struct flow *flow, double known[COLUMNS], const double rates[COLUMNS])
{
    double inputs[COLUMNS], pushed[STATES], ramped[STATES], x[STATES];
    deviate(known, inputs);
    memcpy(x, known, sizeof x);
    memset(inputs, 0, sizeof x);
    for (size_t i = 0; i < STATES; i++) {
        pushed[i] = product(i, inputs);
        ramped[i] = product(i, rates);
    }
    /* x(h) = x + grown x + held B (u - u0) + ramp B du/dt */
    for (size_t i = 0; i < STATES; i++) {
        double gain = 0.0;
        for (size_t j = 0; j < STATES; j++) {
            gain += flow->grown.at[i][j] * x[j] + flow->held.at[i][j] * pushed[j] + flow->ramp.at[i][j] * ramped[j];
        }
        known[i] += gain;
    }
    for (size_t j = STATES; j < COLUMNS; j++) {
        known[j] += flow->step * rates[j];
    }
}

#endif
