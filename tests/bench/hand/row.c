/* A row of 100 masses between two walls as one would write it by hand: arrays and loops that
   vectorize. x: x v e; p: M d K beta alpha (in that order). */
#define N 100
#define NX (3 * N + 1)

struct scene { double inv_M, d, K, beta_alpha, inv_beta, inv_alpha; };

static struct scene prepare(const double *p)
{
    return (struct scene){ 1 / p[0], p[1], p[2], p[3] / p[4], 1 / p[3], 1 / p[4] };
}

static inline void rhs(const struct scene *s, const double *restrict x, double *restrict dx)
{
    const double *v = x + N, *e = x + 2 * N;
    double gap[N + 1], force[N + 1];
    gap[0] = x[0] - s->d + e[0];
    for (int i = 1; i < N; i++) gap[i] = x[i] - x[i - 1] - s->d + e[i];
    gap[N] = 0.02 * N - x[N - 1] + e[N];
    for (int i = 0; i <= N; i++) {
        const double pressed = e[i] - s->beta_alpha * gap[i];
        const double relax = -e[i] * s->inv_beta, follow = -gap[i] * s->inv_alpha;
        force[i] = pressed > 0 ? s->K * pressed : 0;
        dx[2 * N + i] = relax > follow ? relax : follow;
    }
    for (int i = 0; i < N; i++) dx[i] = v[i];
    for (int i = 0; i < N; i++) dx[N + i] = (force[i] - force[i + 1]) * s->inv_M;
}

#include "rk4.h"
