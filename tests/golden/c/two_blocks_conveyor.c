/* Written by nsode: the augmented ODE of a model, in plain C. */
#include "two_blocks_conveyor.h"

#include <math.h>

typedef two_blocks_conveyor_real real;

static inline real max0(real y)
{
    return y <= 0 ? 0 : y;
}

static inline real larger(real a, real b)
{
    return a > b ? a : b >= a ? b : a + b;
}

/* The point of the interval [-Z, Z] nearest to x. */
static inline real sat(real Z, real x)
{
    return fabs(x) <= Z ? x : x > 0 ? Z : x < 0 ? -Z : x + Z;
}

static inline int rates(real t, const real *x, const real *u, const real *p, real *dx)
{
    (void)t;
    (void)u;
    const real x_p1_x = x[two_blocks_conveyor_X_p1_x];
    const real x_p1_y = x[two_blocks_conveyor_X_p1_y];
    const real x_p2_x = x[two_blocks_conveyor_X_p2_x];
    const real x_p2_y = x[two_blocks_conveyor_X_p2_y];
    const real x_v1_x = x[two_blocks_conveyor_X_v1_x];
    const real x_v1_y = x[two_blocks_conveyor_X_v1_y];
    const real x_v2_x = x[two_blocks_conveyor_X_v2_x];
    const real x_v2_y = x[two_blocks_conveyor_X_v2_y];
    const real x_N1_e = x[two_blocks_conveyor_X_N1_e];
    const real x_N2_e = x[two_blocks_conveyor_X_N2_e];
    const real x_N3_e = x[two_blocks_conveyor_X_N3_e];
    const real x_F1_a = x[two_blocks_conveyor_X_F1_a];
    const real x_F2_a = x[two_blocks_conveyor_X_F2_a];
    const real x_F3_a = x[two_blocks_conveyor_X_F3_a];
    const real p_M1 = p[two_blocks_conveyor_P_M1];
    const real p_M2 = p[two_blocks_conveyor_P_M2];
    const real p_Ks = p[two_blocks_conveyor_P_Ks];
    const real p_mu1 = p[two_blocks_conveyor_P_mu1];
    const real p_mu2 = p[two_blocks_conveyor_P_mu2];
    const real p_mu3 = p[two_blocks_conveyor_P_mu3];
    const real p_u = p[two_blocks_conveyor_P_u];
    const real p_g = p[two_blocks_conveyor_P_g];
    const real p_N1_K = p[two_blocks_conveyor_P_N1_K];
    const real p_N1_alpha = p[two_blocks_conveyor_P_N1_alpha];
    const real p_N1_beta = p[two_blocks_conveyor_P_N1_beta];
    const real p_N2_K = p[two_blocks_conveyor_P_N2_K];
    const real p_N2_alpha = p[two_blocks_conveyor_P_N2_alpha];
    const real p_N2_beta = p[two_blocks_conveyor_P_N2_beta];
    const real p_N3_K = p[two_blocks_conveyor_P_N3_K];
    const real p_N3_alpha = p[two_blocks_conveyor_P_N3_alpha];
    const real p_N3_beta = p[two_blocks_conveyor_P_N3_beta];
    const real p_F1_K = p[two_blocks_conveyor_P_F1_K];
    const real p_F1_beta = p[two_blocks_conveyor_P_F1_beta];
    const real p_F2_K = p[two_blocks_conveyor_P_F2_K];
    const real p_F2_beta = p[two_blocks_conveyor_P_F2_beta];
    const real p_F3_K = p[two_blocks_conveyor_P_F3_K];
    const real p_F3_beta = p[two_blocks_conveyor_P_F3_beta];
    const real b_N1_psi = x_p1_x;
    const real b_N1 = p_N1_K*max0(x_N1_e - p_N1_beta*(b_N1_psi + x_N1_e)*(1/p_N1_alpha));
    const real b_N2_psi = x_p2_x - x_p1_x;
    const real b_N2 = p_N2_K*max0(x_N2_e - p_N2_beta*(b_N2_psi + x_N2_e)*(1/p_N2_alpha));
    const real b_N3_psi = x_p2_y;
    const real b_N3 = p_N3_K*max0(x_N3_e - p_N3_beta*(b_N3_psi + x_N3_e)*(1/p_N3_alpha));
    const real b_F1_z = x_F1_a + p_F1_beta*x_v1_y;
    const real b_F1_Z = p_mu1*b_N1*(1/p_F1_K);
    const real b_F1_s = sat(b_F1_Z, b_F1_z);
    const real b_F1 = p_F1_K*b_F1_s;
    const real b_F2_z = x_F2_a + p_F2_beta*(x_v1_y - x_v2_y);
    const real b_F2_Z = p_mu2*b_N2*(1/p_F2_K);
    const real b_F2_s = sat(b_F2_Z, b_F2_z);
    const real b_F2 = p_F2_K*b_F2_s;
    const real b_F3_z = x_F3_a + p_F3_beta*(x_v2_x + p_u);
    const real b_F3_Z = p_mu3*b_N3*(1/p_F3_K);
    const real b_F3_s = sat(b_F3_Z, b_F3_z);
    const real b_F3 = p_F3_K*b_F3_s;
    dx[two_blocks_conveyor_X_p1_x] = x_v1_x;
    dx[two_blocks_conveyor_X_p1_y] = x_v1_y;
    dx[two_blocks_conveyor_X_p2_x] = x_v2_x;
    dx[two_blocks_conveyor_X_p2_y] = x_v2_y;
    dx[two_blocks_conveyor_X_v1_x] = (b_N1 - b_N2)*(1/p_M1);
    dx[two_blocks_conveyor_X_v1_y] = (-b_F1 - b_F2 - p_Ks*x_p1_y)*(1/p_M1);
    dx[two_blocks_conveyor_X_v2_x] = (b_N2 - b_F3)*(1/p_M2);
    dx[two_blocks_conveyor_X_v2_y] = (b_F2 + b_N3 - p_M2*p_g)*(1/p_M2);
    dx[two_blocks_conveyor_X_N1_e] = larger(-x_N1_e*(1/p_N1_beta), -(b_N1_psi +
        x_N1_e)*(1/p_N1_alpha));
    dx[two_blocks_conveyor_X_N2_e] = larger(-x_N2_e*(1/p_N2_beta), -(b_N2_psi +
        x_N2_e)*(1/p_N2_alpha));
    dx[two_blocks_conveyor_X_N3_e] = larger(-x_N3_e*(1/p_N3_beta), -(b_N3_psi +
        x_N3_e)*(1/p_N3_alpha));
    dx[two_blocks_conveyor_X_F1_a] = (b_F1_s - x_F1_a)*(1/p_F1_beta);
    dx[two_blocks_conveyor_X_F2_a] = (b_F2_s - x_F2_a)*(1/p_F2_beta);
    dx[two_blocks_conveyor_X_F3_a] = (b_F3_s - x_F3_a)*(1/p_F3_beta);
    return two_blocks_conveyor_OK;
}

#ifdef two_blocks_conveyor_CHECKS
static int check(real t, const real *x, const real *u, const real *p)
{
    (void)t;
    (void)u;
    const real x_p1_x = x[two_blocks_conveyor_X_p1_x];
    const real x_p2_x = x[two_blocks_conveyor_X_p2_x];
    const real x_p2_y = x[two_blocks_conveyor_X_p2_y];
    const real x_N1_e = x[two_blocks_conveyor_X_N1_e];
    const real x_N2_e = x[two_blocks_conveyor_X_N2_e];
    const real x_N3_e = x[two_blocks_conveyor_X_N3_e];
    const real p_mu1 = p[two_blocks_conveyor_P_mu1];
    const real p_mu2 = p[two_blocks_conveyor_P_mu2];
    const real p_mu3 = p[two_blocks_conveyor_P_mu3];
    const real p_N1_K = p[two_blocks_conveyor_P_N1_K];
    const real p_N1_alpha = p[two_blocks_conveyor_P_N1_alpha];
    const real p_N1_beta = p[two_blocks_conveyor_P_N1_beta];
    const real p_N2_K = p[two_blocks_conveyor_P_N2_K];
    const real p_N2_alpha = p[two_blocks_conveyor_P_N2_alpha];
    const real p_N2_beta = p[two_blocks_conveyor_P_N2_beta];
    const real p_N3_K = p[two_blocks_conveyor_P_N3_K];
    const real p_N3_alpha = p[two_blocks_conveyor_P_N3_alpha];
    const real p_N3_beta = p[two_blocks_conveyor_P_N3_beta];
    const real p_F1_K = p[two_blocks_conveyor_P_F1_K];
    const real p_F1_beta = p[two_blocks_conveyor_P_F1_beta];
    const real p_F2_K = p[two_blocks_conveyor_P_F2_K];
    const real p_F2_beta = p[two_blocks_conveyor_P_F2_beta];
    const real p_F3_K = p[two_blocks_conveyor_P_F3_K];
    const real p_F3_beta = p[two_blocks_conveyor_P_F3_beta];
    const real b_N1_psi = x_p1_x;
    const real b_N1 = p_N1_K*max0(x_N1_e - p_N1_beta*(b_N1_psi + x_N1_e)*(1/p_N1_alpha));
    const real b_N2_psi = x_p2_x - x_p1_x;
    const real b_N2 = p_N2_K*max0(x_N2_e - p_N2_beta*(b_N2_psi + x_N2_e)*(1/p_N2_alpha));
    const real b_N3_psi = x_p2_y;
    const real b_N3 = p_N3_K*max0(x_N3_e - p_N3_beta*(b_N3_psi + x_N3_e)*(1/p_N3_alpha));
    if (!(p_mu1*b_N1 >= 0)) {
        return two_blocks_conveyor_BROKEN + 0;
    }
    if (!(p_mu1 >= 0)) {
        return two_blocks_conveyor_BROKEN + 1;
    }
    if (!(p_mu2*b_N2 >= 0)) {
        return two_blocks_conveyor_BROKEN + 2;
    }
    if (!(p_mu2 >= 0)) {
        return two_blocks_conveyor_BROKEN + 3;
    }
    if (!(p_mu3*b_N3 >= 0)) {
        return two_blocks_conveyor_BROKEN + 4;
    }
    if (!(p_mu3 >= 0)) {
        return two_blocks_conveyor_BROKEN + 5;
    }
    if (!(p_N1_K > 0)) {
        return two_blocks_conveyor_BROKEN + 6;
    }
    if (!(p_N1_alpha > 0)) {
        return two_blocks_conveyor_BROKEN + 7;
    }
    if (!(p_N1_alpha <= p_N1_beta)) {
        return two_blocks_conveyor_BROKEN + 8;
    }
    if (!(p_N1_beta > 0)) {
        return two_blocks_conveyor_BROKEN + 9;
    }
    if (!(p_N2_K > 0)) {
        return two_blocks_conveyor_BROKEN + 10;
    }
    if (!(p_N2_alpha > 0)) {
        return two_blocks_conveyor_BROKEN + 11;
    }
    if (!(p_N2_alpha <= p_N2_beta)) {
        return two_blocks_conveyor_BROKEN + 12;
    }
    if (!(p_N2_beta > 0)) {
        return two_blocks_conveyor_BROKEN + 13;
    }
    if (!(p_N3_K > 0)) {
        return two_blocks_conveyor_BROKEN + 14;
    }
    if (!(p_N3_alpha > 0)) {
        return two_blocks_conveyor_BROKEN + 15;
    }
    if (!(p_N3_alpha <= p_N3_beta)) {
        return two_blocks_conveyor_BROKEN + 16;
    }
    if (!(p_N3_beta > 0)) {
        return two_blocks_conveyor_BROKEN + 17;
    }
    if (!(p_F1_K > 0)) {
        return two_blocks_conveyor_BROKEN + 18;
    }
    if (!(p_F1_beta > 0)) {
        return two_blocks_conveyor_BROKEN + 19;
    }
    if (!(p_F2_K > 0)) {
        return two_blocks_conveyor_BROKEN + 20;
    }
    if (!(p_F2_beta > 0)) {
        return two_blocks_conveyor_BROKEN + 21;
    }
    if (!(p_F3_K > 0)) {
        return two_blocks_conveyor_BROKEN + 22;
    }
    if (!(p_F3_beta > 0)) {
        return two_blocks_conveyor_BROKEN + 23;
    }
    return two_blocks_conveyor_OK;
}
#endif

static const int jac_rows[] = {
    4, 5, 6, 7, 8, 9, 11, 12, 5, 4, 5, 6, 7, 9, 12, 6,
    7, 10, 13, 0, 1, 5, 7, 11, 12, 2, 6, 13, 3, 5, 7, 12,
    4, 5, 8, 11, 4, 5, 6, 7, 9, 12, 6, 7, 10, 13, 5, 11,
    5, 7, 12, 6, 13
};

static const int jac_columns[] = {
    0, 8, 9, 15, 19, 20, 25, 28, 32, 36, 42, 46, 48, 51, 53
};

int two_blocks_conveyor_rhs(real t, const real *x, const real *u, const real *p, real *dx)
{
#ifdef two_blocks_conveyor_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    return rates(t, x, u, p, dx);
}

int two_blocks_conveyor_out(real t, const real *x, const real *u, const real *p, real *y)
{
    (void)t;
    (void)u;
    const real x_p1_x = x[two_blocks_conveyor_X_p1_x];
    const real x_p2_x = x[two_blocks_conveyor_X_p2_x];
    const real x_p2_y = x[two_blocks_conveyor_X_p2_y];
    const real x_v1_y = x[two_blocks_conveyor_X_v1_y];
    const real x_v2_x = x[two_blocks_conveyor_X_v2_x];
    const real x_v2_y = x[two_blocks_conveyor_X_v2_y];
    const real x_N1_e = x[two_blocks_conveyor_X_N1_e];
    const real x_N2_e = x[two_blocks_conveyor_X_N2_e];
    const real x_N3_e = x[two_blocks_conveyor_X_N3_e];
    const real x_F1_a = x[two_blocks_conveyor_X_F1_a];
    const real x_F2_a = x[two_blocks_conveyor_X_F2_a];
    const real x_F3_a = x[two_blocks_conveyor_X_F3_a];
    const real p_mu1 = p[two_blocks_conveyor_P_mu1];
    const real p_mu2 = p[two_blocks_conveyor_P_mu2];
    const real p_mu3 = p[two_blocks_conveyor_P_mu3];
    const real p_u = p[two_blocks_conveyor_P_u];
    const real p_N1_K = p[two_blocks_conveyor_P_N1_K];
    const real p_N1_alpha = p[two_blocks_conveyor_P_N1_alpha];
    const real p_N1_beta = p[two_blocks_conveyor_P_N1_beta];
    const real p_N2_K = p[two_blocks_conveyor_P_N2_K];
    const real p_N2_alpha = p[two_blocks_conveyor_P_N2_alpha];
    const real p_N2_beta = p[two_blocks_conveyor_P_N2_beta];
    const real p_N3_K = p[two_blocks_conveyor_P_N3_K];
    const real p_N3_alpha = p[two_blocks_conveyor_P_N3_alpha];
    const real p_N3_beta = p[two_blocks_conveyor_P_N3_beta];
    const real p_F1_K = p[two_blocks_conveyor_P_F1_K];
    const real p_F1_beta = p[two_blocks_conveyor_P_F1_beta];
    const real p_F2_K = p[two_blocks_conveyor_P_F2_K];
    const real p_F2_beta = p[two_blocks_conveyor_P_F2_beta];
    const real p_F3_K = p[two_blocks_conveyor_P_F3_K];
    const real p_F3_beta = p[two_blocks_conveyor_P_F3_beta];
    const real b_N1_psi = x_p1_x;
    const real b_N1 = p_N1_K*max0(x_N1_e - p_N1_beta*(b_N1_psi + x_N1_e)*(1/p_N1_alpha));
    const real b_N2_psi = x_p2_x - x_p1_x;
    const real b_N2 = p_N2_K*max0(x_N2_e - p_N2_beta*(b_N2_psi + x_N2_e)*(1/p_N2_alpha));
    const real b_N3_psi = x_p2_y;
    const real b_N3 = p_N3_K*max0(x_N3_e - p_N3_beta*(b_N3_psi + x_N3_e)*(1/p_N3_alpha));
    const real b_F1_z = x_F1_a + p_F1_beta*x_v1_y;
    const real b_F1_Z = p_mu1*b_N1*(1/p_F1_K);
    const real b_F1_s = sat(b_F1_Z, b_F1_z);
    const real b_F1 = p_F1_K*b_F1_s;
    const real b_F2_z = x_F2_a + p_F2_beta*(x_v1_y - x_v2_y);
    const real b_F2_Z = p_mu2*b_N2*(1/p_F2_K);
    const real b_F2_s = sat(b_F2_Z, b_F2_z);
    const real b_F2 = p_F2_K*b_F2_s;
    const real b_F3_z = x_F3_a + p_F3_beta*(x_v2_x + p_u);
    const real b_F3_Z = p_mu3*b_N3*(1/p_F3_K);
    const real b_F3_s = sat(b_F3_Z, b_F3_z);
    const real b_F3 = p_F3_K*b_F3_s;
    y[two_blocks_conveyor_Y_N1] = b_N1;
    y[two_blocks_conveyor_Y_N2] = b_N2;
    y[two_blocks_conveyor_Y_N3] = b_N3;
    y[two_blocks_conveyor_Y_F1] = b_F1;
    y[two_blocks_conveyor_Y_F2] = b_F2;
    y[two_blocks_conveyor_Y_F3] = b_F3;
    return two_blocks_conveyor_OK;
}

int two_blocks_conveyor_jac(real t, const real *x, const real *u, const real *p, real *J)
{
    (void)t;
    (void)u;
    const real x_p1_x = x[two_blocks_conveyor_X_p1_x];
    const real x_p2_x = x[two_blocks_conveyor_X_p2_x];
    const real x_p2_y = x[two_blocks_conveyor_X_p2_y];
    const real x_v1_y = x[two_blocks_conveyor_X_v1_y];
    const real x_v2_x = x[two_blocks_conveyor_X_v2_x];
    const real x_v2_y = x[two_blocks_conveyor_X_v2_y];
    const real x_N1_e = x[two_blocks_conveyor_X_N1_e];
    const real x_N2_e = x[two_blocks_conveyor_X_N2_e];
    const real x_N3_e = x[two_blocks_conveyor_X_N3_e];
    const real x_F1_a = x[two_blocks_conveyor_X_F1_a];
    const real x_F2_a = x[two_blocks_conveyor_X_F2_a];
    const real x_F3_a = x[two_blocks_conveyor_X_F3_a];
    const real p_M1 = p[two_blocks_conveyor_P_M1];
    const real p_M2 = p[two_blocks_conveyor_P_M2];
    const real p_Ks = p[two_blocks_conveyor_P_Ks];
    const real p_mu1 = p[two_blocks_conveyor_P_mu1];
    const real p_mu2 = p[two_blocks_conveyor_P_mu2];
    const real p_mu3 = p[two_blocks_conveyor_P_mu3];
    const real p_u = p[two_blocks_conveyor_P_u];
    const real p_N1_K = p[two_blocks_conveyor_P_N1_K];
    const real p_N1_alpha = p[two_blocks_conveyor_P_N1_alpha];
    const real p_N1_beta = p[two_blocks_conveyor_P_N1_beta];
    const real p_N2_K = p[two_blocks_conveyor_P_N2_K];
    const real p_N2_alpha = p[two_blocks_conveyor_P_N2_alpha];
    const real p_N2_beta = p[two_blocks_conveyor_P_N2_beta];
    const real p_N3_K = p[two_blocks_conveyor_P_N3_K];
    const real p_N3_alpha = p[two_blocks_conveyor_P_N3_alpha];
    const real p_N3_beta = p[two_blocks_conveyor_P_N3_beta];
    const real p_F1_K = p[two_blocks_conveyor_P_F1_K];
    const real p_F1_beta = p[two_blocks_conveyor_P_F1_beta];
    const real p_F2_K = p[two_blocks_conveyor_P_F2_K];
    const real p_F2_beta = p[two_blocks_conveyor_P_F2_beta];
    const real p_F3_K = p[two_blocks_conveyor_P_F3_K];
    const real p_F3_beta = p[two_blocks_conveyor_P_F3_beta];
    const real b_shared_1 = 1/p_N1_alpha;
    const real b_shared_2 = -b_shared_1*p_N1_beta;
    const real b_shared_3 = 1/p_N2_alpha;
    const real b_shared_4 = -b_shared_3*p_N2_beta;
    const real b_shared_5 = 1/p_N3_alpha;
    const real b_shared_6 = -b_shared_5*p_N3_beta;
    const real b_shared_7 = 1/p_F1_K*p_mu1;
    const real b_shared_8 = 1/p_F2_K*p_mu2;
    const real b_shared_10 = 1/p_F3_K*p_mu3;
    const real b_shared_11 = 1/p_N1_beta;
    const real b_shared_12 = 1/p_N2_beta;
    const real b_shared_13 = 1/p_N3_beta;
    const real b_shared_14 = 1/p_M1;
    const real b_shared_15 = 1/p_M2;
    const real b_shared_19 = 1/p_F1_beta;
    const real b_shared_20 = 1/p_F2_beta;
    const real b_shared_21 = 1/p_F3_beta;
    const real b_N1_psi = x_p1_x;
    const real b_N1 = p_N1_K*max0(x_N1_e - p_N1_beta*(b_N1_psi + x_N1_e)*(1/p_N1_alpha));
    const real b_N2_psi = x_p2_x - x_p1_x;
    const real b_N2 = p_N2_K*max0(x_N2_e - p_N2_beta*(b_N2_psi + x_N2_e)*(1/p_N2_alpha));
    const real b_N3_psi = x_p2_y;
    const real b_N3 = p_N3_K*max0(x_N3_e - p_N3_beta*(b_N3_psi + x_N3_e)*(1/p_N3_alpha));
    const real b_F1_z = x_F1_a + p_F1_beta*x_v1_y;
    const real b_F1_Z = p_mu1*b_N1*(1/p_F1_K);
    const real b_F2_z = x_F2_a + p_F2_beta*(x_v1_y - x_v2_y);
    const real b_shared_9 = fabs(b_F2_z);
    const real b_F2_Z = p_mu2*b_N2*(1/p_F2_K);
    const real b_F3_z = x_F3_a + p_F3_beta*(x_v2_x + p_u);
    const real b_F3_Z = p_mu3*b_N3*(1/p_F3_K);
    const real b_N1_part1 = x_N1_e - p_N1_beta*(b_N1_psi + x_N1_e)*b_shared_1;
    const real b_N1_part1_d_N1_e = 1 + b_shared_2;
    const real b_N1_part1_d_p1_x = b_shared_2;
    const real b_N1_d_N1_e = 0 < b_N1_part1 ? p_N1_K*b_N1_part1_d_N1_e : 0;
    const real b_N1_d_p1_x = 0 < b_N1_part1 ? p_N1_K*b_N1_part1_d_p1_x : 0;
    const real b_N2_part2 = x_N2_e - p_N2_beta*(b_N2_psi + x_N2_e)*b_shared_3;
    const real b_N2_part2_d_N2_e = 1 + b_shared_4;
    const real b_N2_part2_d_p2_x = b_shared_4;
    const real b_N2_part2_d_p1_x = -b_shared_4;
    const real b_N2_d_N2_e = 0 < b_N2_part2 ? p_N2_K*b_N2_part2_d_N2_e : 0;
    const real b_N2_d_p2_x = 0 < b_N2_part2 ? p_N2_K*b_N2_part2_d_p2_x : 0;
    const real b_N2_d_p1_x = 0 < b_N2_part2 ? p_N2_K*b_N2_part2_d_p1_x : 0;
    const real b_N3_part3 = x_N3_e - p_N3_beta*(b_N3_psi + x_N3_e)*b_shared_5;
    const real b_N3_part3_d_N3_e = 1 + b_shared_6;
    const real b_N3_part3_d_p2_y = b_shared_6;
    const real b_N3_d_N3_e = 0 < b_N3_part3 ? p_N3_K*b_N3_part3_d_N3_e : 0;
    const real b_N3_d_p2_y = 0 < b_N3_part3 ? p_N3_K*b_N3_part3_d_p2_y : 0;
    const real b_F1_Z_d_N1_e = b_shared_7*b_N1_d_N1_e;
    const real b_F1_Z_d_p1_x = b_shared_7*b_N1_d_p1_x;
    const real b_F1_s_d_F1_a = fabs(b_F1_z) < b_F1_Z ? (real)1 : 0;
    const real b_F1_s_d_v1_y = fabs(b_F1_z) < b_F1_Z ? p_F1_beta : 0;
    const real b_F1_s_d_N1_e = (b_F1_z >= b_F1_Z && b_F1_z > 0 ? b_F1_Z_d_N1_e : 0) + (-b_F1_z >=
        b_F1_Z && b_F1_z < 0 ? -b_F1_Z_d_N1_e : 0);
    const real b_F1_s_d_p1_x = (b_F1_z >= b_F1_Z && b_F1_z > 0 ? b_F1_Z_d_p1_x : 0) + (-b_F1_z >=
        b_F1_Z && b_F1_z < 0 ? -b_F1_Z_d_p1_x : 0);
    const real b_F2_Z_d_N2_e = b_shared_8*b_N2_d_N2_e;
    const real b_F2_Z_d_p2_x = b_shared_8*b_N2_d_p2_x;
    const real b_F2_Z_d_p1_x = b_shared_8*b_N2_d_p1_x;
    const real b_F2_s_d_F2_a = b_shared_9 < b_F2_Z ? (real)1 : 0;
    const real b_F2_s_d_v1_y = b_shared_9 < b_F2_Z ? p_F2_beta : 0;
    const real b_F2_s_d_v2_y = b_shared_9 < b_F2_Z ? -p_F2_beta : 0;
    const real b_F2_s_d_N2_e = (b_F2_z >= b_F2_Z && b_F2_z > 0 ? b_F2_Z_d_N2_e : 0) + (-b_F2_z >=
        b_F2_Z && b_F2_z < 0 ? -b_F2_Z_d_N2_e : 0);
    const real b_F2_s_d_p2_x = (b_F2_z >= b_F2_Z && b_F2_z > 0 ? b_F2_Z_d_p2_x : 0) + (-b_F2_z >=
        b_F2_Z && b_F2_z < 0 ? -b_F2_Z_d_p2_x : 0);
    const real b_F2_s_d_p1_x = (b_F2_z >= b_F2_Z && b_F2_z > 0 ? b_F2_Z_d_p1_x : 0) + (-b_F2_z >=
        b_F2_Z && b_F2_z < 0 ? -b_F2_Z_d_p1_x : 0);
    const real b_F3_Z_d_N3_e = b_shared_10*b_N3_d_N3_e;
    const real b_F3_Z_d_p2_y = b_shared_10*b_N3_d_p2_y;
    const real b_F3_s_d_F3_a = fabs(b_F3_z) < b_F3_Z ? (real)1 : 0;
    const real b_F3_s_d_v2_x = fabs(b_F3_z) < b_F3_Z ? p_F3_beta : 0;
    const real b_F3_s_d_N3_e = (b_F3_z >= b_F3_Z && b_F3_z > 0 ? b_F3_Z_d_N3_e : 0) + (-b_F3_z >=
        b_F3_Z && b_F3_z < 0 ? -b_F3_Z_d_N3_e : 0);
    const real b_F3_s_d_p2_y = (b_F3_z >= b_F3_Z && b_F3_z > 0 ? b_F3_Z_d_p2_y : 0) + (-b_F3_z >=
        b_F3_Z && b_F3_z < 0 ? -b_F3_Z_d_p2_y : 0);
    const real b_N1_e_rate_part4 = -x_N1_e*b_shared_11;
    const real b_N1_e_rate_part5 = -(b_N1_psi + x_N1_e)*b_shared_1;
    const real b_shared_16 = b_N1_e_rate_part4 < b_N1_e_rate_part5 ? -b_shared_1 : 0;
    const real b_N2_e_rate_part6 = -x_N2_e*b_shared_12;
    const real b_N2_e_rate_part7 = -(b_N2_psi + x_N2_e)*b_shared_3;
    const real b_shared_17 = b_N2_e_rate_part6 < b_N2_e_rate_part7 ? -b_shared_3 : 0;
    const real b_N3_e_rate_part8 = -x_N3_e*b_shared_13;
    const real b_N3_e_rate_part9 = -(b_N3_psi + x_N3_e)*b_shared_5;
    const real b_shared_18 = b_N3_e_rate_part8 < b_N3_e_rate_part9 ? -b_shared_5 : 0;
    J[19] = 1;
    J[20] = 1;
    J[25] = 1;
    J[28] = 1;
    J[32] = b_shared_14*b_N1_d_N1_e;
    J[0] = b_shared_14*b_N1_d_p1_x + (-b_shared_14*b_N2_d_p1_x);
    J[36] = -b_shared_14*b_N2_d_N2_e;
    J[9] = -b_shared_14*b_N2_d_p2_x;
    J[46] = -b_shared_14*(p_F1_K*b_F1_s_d_F1_a);
    J[21] = -b_shared_14*(p_F1_K*b_F1_s_d_v1_y) + (-b_shared_14*(p_F2_K*b_F2_s_d_v1_y));
    J[33] = -b_shared_14*(p_F1_K*b_F1_s_d_N1_e);
    J[1] = -b_shared_14*(p_F1_K*b_F1_s_d_p1_x) + (-b_shared_14*(p_F2_K*b_F2_s_d_p1_x));
    J[48] = -b_shared_14*(p_F2_K*b_F2_s_d_F2_a);
    J[29] = -b_shared_14*(p_F2_K*b_F2_s_d_v2_y);
    J[37] = -b_shared_14*(p_F2_K*b_F2_s_d_N2_e);
    J[10] = -b_shared_14*(p_F2_K*b_F2_s_d_p2_x);
    J[8] = -b_shared_14*p_Ks;
    J[38] = b_shared_15*b_N2_d_N2_e;
    J[11] = b_shared_15*b_N2_d_p2_x;
    J[2] = b_shared_15*b_N2_d_p1_x;
    J[51] = -b_shared_15*(p_F3_K*b_F3_s_d_F3_a);
    J[26] = -b_shared_15*(p_F3_K*b_F3_s_d_v2_x);
    J[42] = -b_shared_15*(p_F3_K*b_F3_s_d_N3_e);
    J[15] = -b_shared_15*(p_F3_K*b_F3_s_d_p2_y);
    J[49] = b_shared_15*(p_F2_K*b_F2_s_d_F2_a);
    J[22] = b_shared_15*(p_F2_K*b_F2_s_d_v1_y);
    J[30] = b_shared_15*(p_F2_K*b_F2_s_d_v2_y);
    J[39] = b_shared_15*(p_F2_K*b_F2_s_d_N2_e);
    J[12] = b_shared_15*(p_F2_K*b_F2_s_d_p2_x);
    J[3] = b_shared_15*(p_F2_K*b_F2_s_d_p1_x);
    J[43] = b_shared_15*b_N3_d_N3_e;
    J[16] = b_shared_15*b_N3_d_p2_y;
    J[34] = (b_N1_e_rate_part4 >= b_N1_e_rate_part5 ? -b_shared_11 : 0) + b_shared_16;
    J[4] = b_shared_16;
    J[40] = (b_N2_e_rate_part6 >= b_N2_e_rate_part7 ? -b_shared_12 : 0) + b_shared_17;
    J[13] = b_shared_17;
    J[5] = b_N2_e_rate_part6 < b_N2_e_rate_part7 ? b_shared_3 : 0;
    J[44] = (b_N3_e_rate_part8 >= b_N3_e_rate_part9 ? -b_shared_13 : 0) + b_shared_18;
    J[17] = b_shared_18;
    J[47] = b_shared_19*b_F1_s_d_F1_a - b_shared_19;
    J[23] = b_shared_19*b_F1_s_d_v1_y;
    J[35] = b_shared_19*b_F1_s_d_N1_e;
    J[6] = b_shared_19*b_F1_s_d_p1_x;
    J[50] = b_shared_20*b_F2_s_d_F2_a - b_shared_20;
    J[24] = b_shared_20*b_F2_s_d_v1_y;
    J[31] = b_shared_20*b_F2_s_d_v2_y;
    J[41] = b_shared_20*b_F2_s_d_N2_e;
    J[14] = b_shared_20*b_F2_s_d_p2_x;
    J[7] = b_shared_20*b_F2_s_d_p1_x;
    J[52] = b_shared_21*b_F3_s_d_F3_a - b_shared_21;
    J[27] = b_shared_21*b_F3_s_d_v2_x;
    J[45] = b_shared_21*b_F3_s_d_N3_e;
    J[18] = b_shared_21*b_F3_s_d_p2_y;
    return two_blocks_conveyor_OK;
}

int two_blocks_conveyor_jac_pattern(int *row, int *col)
{
    for (int k = 0; k < two_blocks_conveyor_JAC_NNZ; ++k) {
        row[k] = jac_rows[k];
    }
    for (int k = 0; k <= two_blocks_conveyor_NX; ++k) {
        col[k] = jac_columns[k];
    }
    return two_blocks_conveyor_OK;
}

int two_blocks_conveyor_init(const real *p, real *x)
{
    (void)p;
    x[two_blocks_conveyor_X_p1_x] = 0;
    x[two_blocks_conveyor_X_p1_y] = (real)0.25;
    x[two_blocks_conveyor_X_p2_x] = (real)0.05;
    x[two_blocks_conveyor_X_p2_y] = 0;
    x[two_blocks_conveyor_X_v1_x] = 0;
    x[two_blocks_conveyor_X_v1_y] = 0;
    x[two_blocks_conveyor_X_v2_x] = 0;
    x[two_blocks_conveyor_X_v2_y] = 0;
    x[two_blocks_conveyor_X_N1_e] = 0;
    x[two_blocks_conveyor_X_N2_e] = 0;
    x[two_blocks_conveyor_X_N3_e] = 0;
    x[two_blocks_conveyor_X_F1_a] = 0;
    x[two_blocks_conveyor_X_F2_a] = 0;
    x[two_blocks_conveyor_X_F3_a] = 0;
    return two_blocks_conveyor_OK;
}

/* Takes over the next state if it is finite; tiny values become zero. */
static inline int finish(real *x, const real *next)
{
    int finite = 1;
    for (int i = 0; i < two_blocks_conveyor_NX; ++i) {
        finite &= next[i] - next[i] == 0;
    }
    if (!finite) {
        return two_blocks_conveyor_NOT_FINITE;
    }
    for (int i = 0; i < two_blocks_conveyor_NX; ++i) {
        x[i] = fabs(next[i]) < (real)1e-290 ? 0 : next[i];
    }
    return two_blocks_conveyor_OK;
}

int two_blocks_conveyor_step_rk4(real t, real h, real *x, const real *u, const real *p)
{
#ifdef two_blocks_conveyor_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[14], k2[14], k3[14], k4[14], next[14];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < two_blocks_conveyor_NX; ++i) {
        next[i] = x[i] + h/2*k1[i];
    }
    status = rates(t + h/2, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < two_blocks_conveyor_NX; ++i) {
        next[i] = x[i] + h/2*k2[i];
    }
    status = rates(t + h/2, next, u, p, k3);
    if (status) {
        return status;
    }
    for (int i = 0; i < two_blocks_conveyor_NX; ++i) {
        next[i] = x[i] + h*k3[i];
    }
    status = rates(t + h, next, u, p, k4);
    if (status) {
        return status;
    }
    for (int i = 0; i < two_blocks_conveyor_NX; ++i) {
        next[i] = x[i] + h/6*(k1[i] + 2*k2[i] + 2*k3[i] + k4[i]);
    }
    return finish(x, next);
}

int two_blocks_conveyor_step_heun(real t, real h, real *x, const real *u, const real *p)
{
#ifdef two_blocks_conveyor_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[14], k2[14], next[14];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < two_blocks_conveyor_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    status = rates(t + h, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < two_blocks_conveyor_NX; ++i) {
        next[i] = x[i] + h/2*(k1[i] + k2[i]);
    }
    return finish(x, next);
}

int two_blocks_conveyor_step_euler(real t, real h, real *x, const real *u, const real *p)
{
#ifdef two_blocks_conveyor_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[14], next[14];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < two_blocks_conveyor_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    return finish(x, next);
}

const two_blocks_conveyor_real two_blocks_conveyor_p0[] = {
    (real)0.5, 1, 100, (real)0.5, (real)0.5, (real)0.5, 1, (real)9.8, 500000, (real)0.0016,
    (real)0.002, 500000, (real)0.0016, (real)0.002, 500000, (real)0.0016, (real)0.002, 500000,
    (real)0.002, 500000, (real)0.002, 500000, (real)0.002
};

const char two_blocks_conveyor_x_names[] =
    "p1.x\0p1.y\0p2.x\0p2.y\0v1.x\0v1.y\0v2.x\0v2.y\0N1.e\0N2.e\0N3.e\0F1.a\0F2.a\0F3.a\0";

const char two_blocks_conveyor_u_names[] =
    "";

const char two_blocks_conveyor_p_names[] =
    "M1\0M2\0Ks\0mu1\0mu2\0mu3\0u\0g\0N1.K\0N1.alpha\0N1.beta\0N2.K\0N2.alpha\0N2.beta\0N3.K\0"
    "N3.alpha\0N3.beta\0F1.K\0F1.beta\0F2.K\0F2.beta\0F3.K\0F3.beta\0";

const char two_blocks_conveyor_y_names[] =
    "N1\0N2\0N3\0F1\0F2\0F3\0";
