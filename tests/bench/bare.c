/* Times steps of a model in a bare loop, as a person would write it; nanoseconds a step. */
#define _POSIX_C_SOURCE 199309L
/* A static step inlines into its loop (C99 6.2.2). */
static int scene_step_rk4(double t, double h, double *x, const double *u, const double *p);
#include "scene.c"

#include <stdio.h>
#include <time.h>

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return 1e9 * (double)t.tv_sec + (double)t.tv_nsec;
}

int main(void)
{
    double p[] = { P }, h = STEP; /* the compiler must not know them: a run gets them as arguments */
    __asm__ volatile("" : "+m"(h) : "r"(p) : "memory");
    double x[scene_NX];
    for (int round = 0; round < ROUNDS; round++) {
        if (scene_init(p, x)) return 1;
        const double begin = now();
        for (long i = 0; i < STEPS; i++)
            if (scene_step_rk4((double)i * h, h, x, 0, p)) return 2;
        printf("%.17g\n", (now() - begin) / STEPS);
    }
    return 0;
}
