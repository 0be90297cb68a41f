/* The loop of a run by an embedded pair, compiled together with the model. A, B, C, E and D
   hold the tableau, the weights of the error and of the dense output, STAGES their number. */
#include "scene.c"

#include <math.h>
#include <string.h>

static const real a[STAGES][STAGES] = { A }, c[] = { C }, weights_error[] = { E };
static const real weights_dense[] = { D };

/* One step, from x0 at t by h to x1, kept until all rows inside it are written. It outlives a
   call: how a run is cut into calls must not change its numbers. */
typedef struct {
    real t, h, next;
    real x0[scene_NX + 1], x1[scene_NX + 1], k[STAGES][scene_NX + 1];
} pair_step;

const long long scene_step_size = sizeof(pair_step);

/* The largest error of the step against what is tolerated; 1 is just right. */
static real trial(pair_step *s, const real *u, const real *p, const real *tolerance)
{
    real worst = 0;
    for (int i = 1; i < STAGES; ++i) {
        for (int n = 0; n < scene_NX; ++n) {
            real sum = 0;
            for (int j = 0; j < i; ++j) {
                sum += a[i][j]*s->k[j][n];
            }
            s->x1[n] = s->x0[n] + s->h*sum;
        }
        if (rates(s->t + c[i]*s->h, s->x1, u, p, s->k[i])) {
            return NAN;
        }
    }
    for (int n = 0; n < scene_NX; ++n) {
        real sum = 0;
        for (int j = 0; j < STAGES; ++j) {
            sum += weights_error[j]*s->k[j][n];
        }
        const real large = fabs(s->x0[n]) > fabs(s->x1[n]) ? fabs(s->x0[n]) : fabs(s->x1[n]);
        const real share = fabs(s->h*sum)/(tolerance[1] + tolerance[0]*large);
        if (!(share <= worst)) {
            worst = share;
        }
    }
    return worst;
}

/* Goes on from the end of a step; its end is met exactly if `limit` lies within reach. */
static int advance(pair_step *s, real limit, const real *u, const real *p,
                   const real *tolerance, int held)
{
    const real start = s->t + s->h;
    int rejected = 0;
    for (int n = 0; n < scene_NX; ++n) {
        s->x0[n] = fabs(s->x1[n]) < 1e-290 ? 0 : s->x1[n];
    }
    s->t = start;
    if (held) {
        memcpy(s->k[0], s->k[STAGES - 1], sizeof s->k[0]);
    }
    const int status = held && !CHECKED ? scene_OK : scene_rhs(start, s->x0, u, p, s->k[0]);
    if (status) {
        s->h = 0;
        return status;
    }
    for (;;) {
        s->h = start + 1.01*s->next >= limit ? limit - start : s->next;
        const real error = trial(s, u, p, tolerance);
        const real change = error > 0 ? 0.9*pow(error, -1.0/ORDER) : error == 0 ? 5 : 0.1;
        if (error <= 1) {
            const real most = rejected ? 1 : 5, factor = change < most ? change : most;
            s->next = s->h < s->next && factor >= 1 ? s->next : s->h*factor;
            return scene_OK;
        }
        rejected = 1;
        s->next = s->h*(change > 0.2 ? change : 0.2);
        if (!(fabs(s->next) > 1e-15*(fabs(start) + 1e-6))) {
            memcpy(s->x1, s->x0, sizeof s->x1);
            s->h = 0;
            return scene_NOT_FINITE;
        }
    }
}

static void interpolate(const pair_step *s, real t, real *x)
{
    const real r = s->h > 0 ? (t - s->t)/s->h : 1;
    for (int n = 0; n < scene_NX; ++n) {
        real sum = 0;
        for (int j = 0; j < STAGES; ++j) {
            sum += weights_dense[j]*s->k[j][n];
        }
        const real d = s->x1[n] - s->x0[n], b = s->h*s->k[0][n] - d;
        const real top = d - s->h*s->k[STAGES - 1][n] - b;
        x[n] = s->x0[n] + r*(d + (1 - r)*(b + r*(top + (1 - r)*s->h*sum)));
    }
}

/* As the loop of a fixed step, on the grid t0 + i*h of rows and inputs; `total` is where the
   run ends. Steps reach over points of the grid unless inputs change there. */
int scene_run(real t0, real h, long long first, long long count, long long every,
              real *state, const real *u, long long stride, const real *p,
              real *xs, real *ys, long long *done,
              long long total, const real *tolerance, void *memory)
{
    pair_step *const s = memory;
    const long long last = first + count;
    int status = scene_OK;
    long long i = first;
    if (first == 0) {
        s->t = t0, s->h = 0, s->next = 1e-3*h;
        memcpy(s->x1, state, scene_NX*sizeof *state);
    }
    for (; i < last; ++i) {
        const real t = t0 + (real)(i + 1)*h;
        const real limit = stride ? t : t0 + (real)total*h;
        while (!status && s->t + s->h < t) {
            status = advance(s, limit, u + (i - first)*stride, p, tolerance, !stride && s->h > 0);
        }
        if (status) {
            break;
        }
        if (t < s->t + s->h) {
            interpolate(s, t, state);
        } else {
            memcpy(state, s->x1, scene_NX*sizeof *state);
        }
        if ((i + 1) % every == 0) {
            memcpy(xs, state, scene_NX*sizeof *state);
            status = scene_out(t, state, u + (i + 1 - first)*stride, p, ys);
            xs += scene_NX;
            ys += scene_NY;
        }
    }
    *done = i - first;
    return status;
}
