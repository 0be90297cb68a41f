/* Equation (45) as one would write it by hand: divisions hoisted out of the stages, one
   right-hand side inlined four times.
   x: p1 p2 v1 v2 e1 e2 e3 a1 a2 a3; p: M1 M2 Ks mu1 mu2 mu3 u g, then K beta alpha of
   N1, N2, N3 and K beta of F1, F2, F3 (in that order). */
#define NX 14

struct contact { double K, beta_alpha, inv_beta, inv_alpha; };
struct friction { double K, mu_K, beta, inv_beta; };
struct scene {
    double inv_M1, inv_M2, Ks, u, g;
    struct contact n[3];
    struct friction f[3];
};

static struct scene prepare(const double *p)
{
    struct scene s;
    s.inv_M1 = 1 / p[0];
    s.inv_M2 = 1 / p[1];
    s.Ks = p[2];
    s.u = p[6];
    s.g = p[7];
    for (int i = 0; i < 3; i++) {
        const double *c = p + 8 + 3 * i, *f = p + 17 + 2 * i;
        s.n[i] = (struct contact){ c[0], c[1] / c[2], 1 / c[1], 1 / c[2] };
        s.f[i] = (struct friction){ f[0], p[3 + i] / f[0], f[1], 1 / f[1] };
    }
    return s;
}

static inline double press(const struct contact *c, double psi, double e, double *de)
{
    const double gap = psi + e, pressed = e - c->beta_alpha * gap;
    const double relax = -e * c->inv_beta, follow = -gap * c->inv_alpha;
    *de = relax > follow ? relax : follow;
    return pressed > 0 ? c->K * pressed : 0;
}

static inline double rub(const struct friction *f, double N, double theta, double a, double *da)
{
    const double Z = f->mu_K * N, z = a + f->beta * theta;
    const double s = z > Z ? Z : z < -Z ? -Z : z;
    *da = (s - a) * f->inv_beta;
    return f->K * s;
}

static inline void rhs(const struct scene *s, const double *restrict x, double *restrict dx)
{
    const double *p1 = x, *p2 = x + 2, *v1 = x + 4, *v2 = x + 6, *e = x + 8, *a = x + 11;
    const double N1 = press(&s->n[0], p1[0], e[0], &dx[8]);
    const double N2 = press(&s->n[1], p2[0] - p1[0], e[1], &dx[9]);
    const double N3 = press(&s->n[2], p2[1], e[2], &dx[10]);
    const double F1 = rub(&s->f[0], N1, v1[1], a[0], &dx[11]);
    const double F2 = rub(&s->f[1], N2, v1[1] - v2[1], a[1], &dx[12]);
    const double F3 = rub(&s->f[2], N3, v2[0] + s->u, a[2], &dx[13]);
    dx[0] = v1[0];
    dx[1] = v1[1];
    dx[2] = v2[0];
    dx[3] = v2[1];
    dx[4] = (N1 - N2) * s->inv_M1;
    dx[5] = -(F1 + F2 + s->Ks * p1[1]) * s->inv_M1;
    dx[6] = (N2 - F3) * s->inv_M2;
    dx[7] = (F2 + N3) * s->inv_M2 - s->g;
}

#include "rk4.h"
