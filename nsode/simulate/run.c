/* The step loop of a run, compiled together with the model so that the steps inline its
   equations. STEPS lists the step function of each method. */
#include "scene.c"

#include <string.h>

typedef int stepper(real t, real h, real *x, const real *u, const real *p);

static stepper *const steppers[] = { STEPS };

/* Takes steps first, first + 1, ..., first + count - 1; step i starts at t0 + i*h and its
   inputs stand at u + (i - first)*stride. Every `every`-th state is written to xs and its
   outputs to ys. Returns the status of the step that failed; done tells how many did not. */
int scene_run(int method, real t0, real h, long long first, long long count, long long every,
              real *x, const real *u, long long stride, const real *p,
              real *xs, real *ys, long long *done)
{
    stepper *const step = steppers[method];
    const long long last = first + count;
    long long i = first;
    int status = scene_OK;
    while (i < last && !status) {
        const long long row = (i/every + 1)*every;
        const long long stop = row < last ? row : last;
        while (i < stop) {
            status = step(t0 + (real)i*h, h, x, u + (i - first)*stride, p);
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
    *done = i - first;
    return status;
}
