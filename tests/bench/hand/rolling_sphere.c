/* Equation (37) as one would write it by hand: divisions hoisted out of the stages,
   no square root while the contact sticks, one right-hand side inlined four times.
   x: p v w q e a; p: M R mu g, K beta alpha of N, K beta of F (in that order). */
#include <math.h>

#define NX 16

struct scene {
    double R, g, K1, beta_alpha, inv_beta1, inv_alpha, mu_K2, K2, beta2, inv_beta2;
    double inv_M, arm;
};

static struct scene prepare(const double *p)
{
    const double M = p[0], R = p[1], mu = p[2], g = p[3];
    const double K1 = p[4], beta1 = p[5], alpha = p[6], K2 = p[7], beta2 = p[8];
    return (struct scene){ R, g, K1, beta1 / alpha, 1 / beta1, 1 / alpha, mu / K2, K2, beta2,
                           1 / beta2, 1 / M, 2.5 / (M * R) };
}

static inline void rhs(const struct scene *s, const double *restrict x, double *restrict dx)
{
    const double *v = x + 3, *w = x + 6, *q = x + 9, *a = x + 14;
    const double e = x[13], gap = x[2] - s->R + e;
    const double pressed = e - s->beta_alpha * gap;
    const double N = pressed > 0 ? s->K1 * pressed : 0;
    const double Z = s->mu_K2 * N;
    const double zx = a[0] + s->beta2 * (v[0] - s->R * w[1]);
    const double zy = a[1] + s->beta2 * (v[1] + s->R * w[0]);
    const double n2 = zx * zx + zy * zy;
    const double shrink = n2 > Z * Z ? Z / sqrt(n2) : 1;
    const double sx = shrink * zx, sy = shrink * zy;
    const double fx = -s->K2 * sx, fy = -s->K2 * sy;
    const double relax = -e * s->inv_beta1, follow = -gap * s->inv_alpha;

    dx[0] = v[0];
    dx[1] = v[1];
    dx[2] = v[2];
    dx[3] = fx * s->inv_M;
    dx[4] = fy * s->inv_M;
    dx[5] = N * s->inv_M - s->g;
    dx[6] = fy * s->arm;
    dx[7] = -fx * s->arm;
    dx[8] = 0;
    dx[9] = -0.5 * (w[0] * q[1] + w[1] * q[2] + w[2] * q[3]);
    dx[10] = 0.5 * (w[0] * q[0] + w[1] * q[3] - w[2] * q[2]);
    dx[11] = 0.5 * (w[1] * q[0] + w[2] * q[1] - w[0] * q[3]);
    dx[12] = 0.5 * (w[2] * q[0] + w[0] * q[2] - w[1] * q[1]);
    dx[13] = relax > follow ? relax : follow;
    dx[14] = (sx - a[0]) * s->inv_beta2;
    dx[15] = (sy - a[1]) * s->inv_beta2;
}

#include "rk4.h"
