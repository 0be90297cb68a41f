/* Times the generated RK4 step and the hand-written one in turns; one line for each round:
   nanoseconds a step of the one, of the other; then the largest difference of the states.
   HAND_P says where in p0 stands what the hand-written step wants. */
#define _POSIX_C_SOURCE 199309L
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>
#include HEADER

#define JOIN_(a, b) a##b
#define JOIN(a, b) JOIN_(a, b)
#define OF(name) JOIN(PREFIX, name)

enum { ROUNDS = 41 };
void hand_step_rk4(double t, double h, double *x, const double *u, const double *p);

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

int main(void)
{
    const double h = STEP, *p = OF(_p0), none[1] = { 0 };
    const int order[] = { HAND_P };
    double hand_p[sizeof order / sizeof *order];
    for (size_t i = 0; i < sizeof order / sizeof *order; i++) hand_p[i] = p[order[i]];
    double start[OF(_NX)], x[OF(_NX)], y[OF(_NX)], difference = 0;
    OF(_init)(p, start);
    for (int round = 0; round < ROUNDS; round++) {
        memcpy(x, start, sizeof x);
        memcpy(y, start, sizeof y);
        const double begin = now();
        for (long k = 0; k < STEPS; k++)
            if (OF(_step_rk4)((double)k * h, h, x, none, p)) return 1;
        const double middle = now();
        for (long k = 0; k < STEPS; k++) hand_step_rk4((double)k * h, h, y, none, hand_p);
        const double end = now();
        printf("%.17g %.17g\n", (middle - begin) / STEPS, (end - middle) / STEPS);
    }
    for (int i = 0; i < OF(_NX); i++) difference = fmax(difference, fabs(x[i] - y[i]));
    printf("%.17g\n", difference);
    return 0;
}
