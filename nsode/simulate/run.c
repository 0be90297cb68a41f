/* The step loop of a run, compiled together with the model. STEP is the step function of the
   method. Every step function is declared static before the model defines it, and so it is
   (C99 6.2.2): the one in use inlines here, which halves its time, and the others vanish. */
#include "scene.c"

#include <string.h>

/* A splitting whose forces are the same at the end of a step and at the start of the next
   computes them once: CARRIED. They stand in k. */
#ifdef CARRIED
#define BEGIN(t, x, u, p, k) rates(t, x, u, p, k)
#define ADVANCE(t, h, x, u, p, k) onward(t, h, x, u, p, k)
#else
#define BEGIN(t, x, u, p, k) ((void)(k), scene_OK)
#define ADVANCE(t, h, x, u, p, k) STEP(t, h, x, u, p)
#endif

/* Takes steps first, first + 1, ..., first + count - 1; step i starts at t0 + i*h and its
   inputs stand at u + (i - first)*stride. Every `every`-th state is written to xs and its
   outputs to ys. Returns the status of the step that failed; done tells how many did not. */
int scene_run(real t0, real h, long long first, long long count, long long every,
              real *state, const real *u, long long stride, const real *parameters,
              real *xs, real *ys, long long *done)
{
    /* Arrays of its own let the compiler see that nothing else changes them: a third less time. */
    real x[scene_NX + 1], p[scene_NP + 1], k[scene_NX + 1];
    memcpy(x, state, scene_NX*sizeof *x);
    memcpy(p, parameters, scene_NP*sizeof *p);
    const long long last = first + count;
    long long i = first;
    int status = BEGIN(t0 + (real)first*h, x, u, p, k);
    while (i < last && !status) {
        const long long row = (i/every + 1)*every;
        const long long stop = row < last ? row : last;
        while (i < stop) {
            status = ADVANCE(t0 + (real)i*h, h, x, u + (i - first)*stride, p, k);
            if (status) {
                break;
            }
            ++i;
        }
        if (!status && i == row) {
            memcpy(xs, x, scene_NX*sizeof *x);
            status = scene_out(t0 + (real)i*h, x, u + (i - first)*stride, p, ys);
            xs += scene_NX;
            ys += scene_NY;
        }
    }
    memcpy(state, x, scene_NX*sizeof *x);
    *done = i - first;
    return status;
}
