/* Written by nsode: the augmented ODE of a model, in plain C. */
#include "gripper.h"

#include <math.h>

typedef gripper_real real;

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
    (void)u;
    const real x_p_x = x[gripper_X_p_x];
    const real x_v_x = x[gripper_X_v_x];
    const real x_v_y = x[gripper_X_v_y];
    const real x_a = x[gripper_X_a];
    const real x_b = x[gripper_X_b];
    const real x_va = x[gripper_X_va];
    const real x_vb = x[gripper_X_vb];
    const real x_L_e = x[gripper_X_L_e];
    const real x_R_e = x[gripper_X_R_e];
    const real x_FL_a = x[gripper_X_FL_a];
    const real x_FR_a = x[gripper_X_FR_a];
    const real p_M = p[gripper_P_M];
    const real p_m = p[gripper_P_m];
    const real p_d = p[gripper_P_d];
    const real p_G = p[gripper_P_G];
    const real p_mu = p[gripper_P_mu];
    const real p_g = p[gripper_P_g];
    const real p_c = p[gripper_P_c];
    const real p_A = p[gripper_P_A];
    const real p_omega = p[gripper_P_omega];
    const real p_L_K = p[gripper_P_L_K];
    const real p_L_alpha = p[gripper_P_L_alpha];
    const real p_L_beta = p[gripper_P_L_beta];
    const real p_R_K = p[gripper_P_R_K];
    const real p_R_alpha = p[gripper_P_R_alpha];
    const real p_R_beta = p[gripper_P_R_beta];
    const real p_FL_K = p[gripper_P_FL_K];
    const real p_FL_beta = p[gripper_P_FL_beta];
    const real p_FR_K = p[gripper_P_FR_K];
    const real p_FR_beta = p[gripper_P_FR_beta];
    const real b_lift = p_A*p_omega*sin(p_omega*t);
    const real b_L_psi = x_p_x - p_d/2 - x_a;
    const real b_L = p_L_K*max0(x_L_e - p_L_beta*(b_L_psi + x_L_e)*(1/p_L_alpha));
    const real b_R_psi = x_b - x_p_x - p_d/2;
    const real b_R = p_R_K*max0(x_R_e - p_R_beta*(b_R_psi + x_R_e)*(1/p_R_alpha));
    const real b_FL_z = x_FL_a + p_FL_beta*(x_v_y - b_lift);
    const real b_FL_Z = p_mu*b_L*(1/p_FL_K);
    const real b_FL_s = sat(b_FL_Z, b_FL_z);
    const real b_FL = p_FL_K*b_FL_s;
    const real b_FR_z = x_FR_a + p_FR_beta*(x_v_y - b_lift);
    const real b_FR_Z = p_mu*b_R*(1/p_FR_K);
    const real b_FR_s = sat(b_FR_Z, b_FR_z);
    const real b_FR = p_FR_K*b_FR_s;
    dx[gripper_X_p_x] = x_v_x;
    dx[gripper_X_p_y] = x_v_y;
    dx[gripper_X_v_x] = (b_L - b_R)*(1/p_M);
    dx[gripper_X_v_y] = (-p_M*p_g - b_FL - b_FR)*(1/p_M);
    dx[gripper_X_a] = x_va;
    dx[gripper_X_b] = x_vb;
    dx[gripper_X_va] = (p_G - b_L - p_c*x_va)*(1/p_m);
    dx[gripper_X_vb] = (b_R - p_G - p_c*x_vb)*(1/p_m);
    dx[gripper_X_L_e] = larger(-x_L_e*(1/p_L_beta), -(b_L_psi + x_L_e)*(1/p_L_alpha));
    dx[gripper_X_R_e] = larger(-x_R_e*(1/p_R_beta), -(b_R_psi + x_R_e)*(1/p_R_alpha));
    dx[gripper_X_FL_a] = (b_FL_s - x_FL_a)*(1/p_FL_beta);
    dx[gripper_X_FR_a] = (b_FR_s - x_FR_a)*(1/p_FR_beta);
    return gripper_OK;
}

#ifdef gripper_CHECKS
static int check(real t, const real *x, const real *u, const real *p)
{
    (void)t;
    (void)u;
    const real x_p_x = x[gripper_X_p_x];
    const real x_a = x[gripper_X_a];
    const real x_b = x[gripper_X_b];
    const real x_L_e = x[gripper_X_L_e];
    const real x_R_e = x[gripper_X_R_e];
    const real p_d = p[gripper_P_d];
    const real p_mu = p[gripper_P_mu];
    const real p_L_K = p[gripper_P_L_K];
    const real p_L_alpha = p[gripper_P_L_alpha];
    const real p_L_beta = p[gripper_P_L_beta];
    const real p_R_K = p[gripper_P_R_K];
    const real p_R_alpha = p[gripper_P_R_alpha];
    const real p_R_beta = p[gripper_P_R_beta];
    const real p_FL_K = p[gripper_P_FL_K];
    const real p_FL_beta = p[gripper_P_FL_beta];
    const real p_FR_K = p[gripper_P_FR_K];
    const real p_FR_beta = p[gripper_P_FR_beta];
    const real b_L_psi = x_p_x - p_d/2 - x_a;
    const real b_L = p_L_K*max0(x_L_e - p_L_beta*(b_L_psi + x_L_e)*(1/p_L_alpha));
    const real b_R_psi = x_b - x_p_x - p_d/2;
    const real b_R = p_R_K*max0(x_R_e - p_R_beta*(b_R_psi + x_R_e)*(1/p_R_alpha));
    if (!(p_mu*b_L >= 0)) {
        return gripper_BROKEN + 0;
    }
    if (!(p_mu >= 0)) {
        return gripper_BROKEN + 1;
    }
    if (!(p_mu*b_R >= 0)) {
        return gripper_BROKEN + 2;
    }
    if (!(p_mu >= 0)) {
        return gripper_BROKEN + 3;
    }
    if (!(p_L_K > 0)) {
        return gripper_BROKEN + 4;
    }
    if (!(p_L_alpha > 0)) {
        return gripper_BROKEN + 5;
    }
    if (!(p_L_alpha <= p_L_beta)) {
        return gripper_BROKEN + 6;
    }
    if (!(p_L_beta > 0)) {
        return gripper_BROKEN + 7;
    }
    if (!(p_R_K > 0)) {
        return gripper_BROKEN + 8;
    }
    if (!(p_R_alpha > 0)) {
        return gripper_BROKEN + 9;
    }
    if (!(p_R_alpha <= p_R_beta)) {
        return gripper_BROKEN + 10;
    }
    if (!(p_R_beta > 0)) {
        return gripper_BROKEN + 11;
    }
    if (!(p_FL_K > 0)) {
        return gripper_BROKEN + 12;
    }
    if (!(p_FL_beta > 0)) {
        return gripper_BROKEN + 13;
    }
    if (!(p_FR_K > 0)) {
        return gripper_BROKEN + 14;
    }
    if (!(p_FR_beta > 0)) {
        return gripper_BROKEN + 15;
    }
    return gripper_OK;
}
#endif

static const int jac_rows[] = {
    2, 3, 6, 7, 8, 9, 10, 11, 0, 1, 3, 10, 11, 2, 3, 6,
    8, 10, 2, 3, 7, 9, 11, 4, 6, 5, 7, 2, 3, 6, 8, 10,
    2, 3, 7, 9, 11, 3, 10, 3, 11
};

static const int jac_columns[] = {
    0, 8, 8, 9, 13, 18, 23, 25, 27, 32, 37, 39, 41
};

int gripper_rhs(real t, const real *x, const real *u, const real *p, real *dx)
{
#ifdef gripper_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    return rates(t, x, u, p, dx);
}

int gripper_out(real t, const real *x, const real *u, const real *p, real *y)
{
    (void)u;
    const real x_p_x = x[gripper_X_p_x];
    const real x_v_y = x[gripper_X_v_y];
    const real x_a = x[gripper_X_a];
    const real x_b = x[gripper_X_b];
    const real x_L_e = x[gripper_X_L_e];
    const real x_R_e = x[gripper_X_R_e];
    const real x_FL_a = x[gripper_X_FL_a];
    const real x_FR_a = x[gripper_X_FR_a];
    const real p_d = p[gripper_P_d];
    const real p_mu = p[gripper_P_mu];
    const real p_A = p[gripper_P_A];
    const real p_omega = p[gripper_P_omega];
    const real p_L_K = p[gripper_P_L_K];
    const real p_L_alpha = p[gripper_P_L_alpha];
    const real p_L_beta = p[gripper_P_L_beta];
    const real p_R_K = p[gripper_P_R_K];
    const real p_R_alpha = p[gripper_P_R_alpha];
    const real p_R_beta = p[gripper_P_R_beta];
    const real p_FL_K = p[gripper_P_FL_K];
    const real p_FL_beta = p[gripper_P_FL_beta];
    const real p_FR_K = p[gripper_P_FR_K];
    const real p_FR_beta = p[gripper_P_FR_beta];
    const real b_lift = p_A*p_omega*sin(p_omega*t);
    const real b_L_psi = x_p_x - p_d/2 - x_a;
    const real b_L = p_L_K*max0(x_L_e - p_L_beta*(b_L_psi + x_L_e)*(1/p_L_alpha));
    const real b_R_psi = x_b - x_p_x - p_d/2;
    const real b_R = p_R_K*max0(x_R_e - p_R_beta*(b_R_psi + x_R_e)*(1/p_R_alpha));
    const real b_FL_z = x_FL_a + p_FL_beta*(x_v_y - b_lift);
    const real b_FL_Z = p_mu*b_L*(1/p_FL_K);
    const real b_FL_s = sat(b_FL_Z, b_FL_z);
    const real b_FL = p_FL_K*b_FL_s;
    const real b_FR_z = x_FR_a + p_FR_beta*(x_v_y - b_lift);
    const real b_FR_Z = p_mu*b_R*(1/p_FR_K);
    const real b_FR_s = sat(b_FR_Z, b_FR_z);
    const real b_FR = p_FR_K*b_FR_s;
    y[gripper_Y_L] = b_L;
    y[gripper_Y_R] = b_R;
    y[gripper_Y_FL] = b_FL;
    y[gripper_Y_FR] = b_FR;
    return gripper_OK;
}

int gripper_jac(real t, const real *x, const real *u, const real *p, real *J)
{
    (void)u;
    const real x_p_x = x[gripper_X_p_x];
    const real x_v_y = x[gripper_X_v_y];
    const real x_a = x[gripper_X_a];
    const real x_b = x[gripper_X_b];
    const real x_L_e = x[gripper_X_L_e];
    const real x_R_e = x[gripper_X_R_e];
    const real x_FL_a = x[gripper_X_FL_a];
    const real x_FR_a = x[gripper_X_FR_a];
    const real p_M = p[gripper_P_M];
    const real p_m = p[gripper_P_m];
    const real p_d = p[gripper_P_d];
    const real p_mu = p[gripper_P_mu];
    const real p_c = p[gripper_P_c];
    const real p_A = p[gripper_P_A];
    const real p_omega = p[gripper_P_omega];
    const real p_L_K = p[gripper_P_L_K];
    const real p_L_alpha = p[gripper_P_L_alpha];
    const real p_L_beta = p[gripper_P_L_beta];
    const real p_R_K = p[gripper_P_R_K];
    const real p_R_alpha = p[gripper_P_R_alpha];
    const real p_R_beta = p[gripper_P_R_beta];
    const real p_FL_K = p[gripper_P_FL_K];
    const real p_FL_beta = p[gripper_P_FL_beta];
    const real p_FR_K = p[gripper_P_FR_K];
    const real p_FR_beta = p[gripper_P_FR_beta];
    const real b_shared_1 = 1/p_L_alpha;
    const real b_shared_2 = -b_shared_1*p_L_beta;
    const real b_shared_3 = 1/p_R_alpha;
    const real b_shared_4 = -b_shared_3*p_R_beta;
    const real b_shared_5 = 1/p_FL_K*p_mu;
    const real b_shared_6 = 1/p_FR_K*p_mu;
    const real b_shared_7 = 1/p_L_beta;
    const real b_shared_8 = 1/p_R_beta;
    const real b_shared_9 = 1/p_M;
    const real b_shared_10 = 1/p_m;
    const real b_shared_11 = -b_shared_10*p_c;
    const real b_shared_14 = 1/p_FL_beta;
    const real b_shared_15 = 1/p_FR_beta;
    const real b_lift = p_A*p_omega*sin(p_omega*t);
    const real b_L_psi = x_p_x - p_d/2 - x_a;
    const real b_L = p_L_K*max0(x_L_e - p_L_beta*(b_L_psi + x_L_e)*(1/p_L_alpha));
    const real b_R_psi = x_b - x_p_x - p_d/2;
    const real b_R = p_R_K*max0(x_R_e - p_R_beta*(b_R_psi + x_R_e)*(1/p_R_alpha));
    const real b_FL_z = x_FL_a + p_FL_beta*(x_v_y - b_lift);
    const real b_FL_Z = p_mu*b_L*(1/p_FL_K);
    const real b_FR_z = x_FR_a + p_FR_beta*(x_v_y - b_lift);
    const real b_FR_Z = p_mu*b_R*(1/p_FR_K);
    const real b_L_part1 = x_L_e - p_L_beta*(b_L_psi + x_L_e)*b_shared_1;
    const real b_L_part1_d_L_e = 1 + b_shared_2;
    const real b_L_part1_d_p_x = b_shared_2;
    const real b_L_part1_d_a = -b_shared_2;
    const real b_L_d_L_e = 0 < b_L_part1 ? p_L_K*b_L_part1_d_L_e : 0;
    const real b_L_d_p_x = 0 < b_L_part1 ? p_L_K*b_L_part1_d_p_x : 0;
    const real b_L_d_a = 0 < b_L_part1 ? p_L_K*b_L_part1_d_a : 0;
    const real b_R_part2 = x_R_e - p_R_beta*(b_R_psi + x_R_e)*b_shared_3;
    const real b_R_part2_d_R_e = 1 + b_shared_4;
    const real b_R_part2_d_b = b_shared_4;
    const real b_R_part2_d_p_x = -b_shared_4;
    const real b_R_d_R_e = 0 < b_R_part2 ? p_R_K*b_R_part2_d_R_e : 0;
    const real b_R_d_b = 0 < b_R_part2 ? p_R_K*b_R_part2_d_b : 0;
    const real b_R_d_p_x = 0 < b_R_part2 ? p_R_K*b_R_part2_d_p_x : 0;
    const real b_FL_Z_d_L_e = b_shared_5*b_L_d_L_e;
    const real b_FL_Z_d_p_x = b_shared_5*b_L_d_p_x;
    const real b_FL_Z_d_a = b_shared_5*b_L_d_a;
    const real b_FL_s_d_FL_a = fabs(b_FL_z) < b_FL_Z ? (real)1 : 0;
    const real b_FL_s_d_v_y = fabs(b_FL_z) < b_FL_Z ? p_FL_beta : 0;
    const real b_FL_s_d_L_e = (b_FL_z >= b_FL_Z && b_FL_z > 0 ? b_FL_Z_d_L_e : 0) + (-b_FL_z >=
        b_FL_Z && b_FL_z < 0 ? -b_FL_Z_d_L_e : 0);
    const real b_FL_s_d_p_x = (b_FL_z >= b_FL_Z && b_FL_z > 0 ? b_FL_Z_d_p_x : 0) + (-b_FL_z >=
        b_FL_Z && b_FL_z < 0 ? -b_FL_Z_d_p_x : 0);
    const real b_FL_s_d_a = (b_FL_z >= b_FL_Z && b_FL_z > 0 ? b_FL_Z_d_a : 0) + (-b_FL_z >= b_FL_Z
        && b_FL_z < 0 ? -b_FL_Z_d_a : 0);
    const real b_FR_Z_d_R_e = b_shared_6*b_R_d_R_e;
    const real b_FR_Z_d_b = b_shared_6*b_R_d_b;
    const real b_FR_Z_d_p_x = b_shared_6*b_R_d_p_x;
    const real b_FR_s_d_FR_a = fabs(b_FR_z) < b_FR_Z ? (real)1 : 0;
    const real b_FR_s_d_v_y = fabs(b_FR_z) < b_FR_Z ? p_FR_beta : 0;
    const real b_FR_s_d_R_e = (b_FR_z >= b_FR_Z && b_FR_z > 0 ? b_FR_Z_d_R_e : 0) + (-b_FR_z >=
        b_FR_Z && b_FR_z < 0 ? -b_FR_Z_d_R_e : 0);
    const real b_FR_s_d_b = (b_FR_z >= b_FR_Z && b_FR_z > 0 ? b_FR_Z_d_b : 0) + (-b_FR_z >= b_FR_Z
        && b_FR_z < 0 ? -b_FR_Z_d_b : 0);
    const real b_FR_s_d_p_x = (b_FR_z >= b_FR_Z && b_FR_z > 0 ? b_FR_Z_d_p_x : 0) + (-b_FR_z >=
        b_FR_Z && b_FR_z < 0 ? -b_FR_Z_d_p_x : 0);
    const real b_L_e_rate_part3 = -x_L_e*b_shared_7;
    const real b_L_e_rate_part4 = -(b_L_psi + x_L_e)*b_shared_1;
    const real b_shared_12 = b_L_e_rate_part3 < b_L_e_rate_part4 ? -b_shared_1 : 0;
    const real b_R_e_rate_part5 = -x_R_e*b_shared_8;
    const real b_R_e_rate_part6 = -(b_R_psi + x_R_e)*b_shared_3;
    const real b_shared_13 = b_R_e_rate_part5 < b_R_e_rate_part6 ? -b_shared_3 : 0;
    J[8] = 1;
    J[9] = 1;
    J[27] = b_shared_9*b_L_d_L_e;
    J[0] = b_shared_9*b_L_d_p_x + (-b_shared_9*b_R_d_p_x);
    J[13] = b_shared_9*b_L_d_a;
    J[32] = -b_shared_9*b_R_d_R_e;
    J[18] = -b_shared_9*b_R_d_b;
    J[37] = -b_shared_9*(p_FL_K*b_FL_s_d_FL_a);
    J[10] = -b_shared_9*(p_FL_K*b_FL_s_d_v_y) + (-b_shared_9*(p_FR_K*b_FR_s_d_v_y));
    J[28] = -b_shared_9*(p_FL_K*b_FL_s_d_L_e);
    J[1] = -b_shared_9*(p_FL_K*b_FL_s_d_p_x) + (-b_shared_9*(p_FR_K*b_FR_s_d_p_x));
    J[14] = -b_shared_9*(p_FL_K*b_FL_s_d_a);
    J[39] = -b_shared_9*(p_FR_K*b_FR_s_d_FR_a);
    J[33] = -b_shared_9*(p_FR_K*b_FR_s_d_R_e);
    J[19] = -b_shared_9*(p_FR_K*b_FR_s_d_b);
    J[23] = 1;
    J[25] = 1;
    J[29] = -b_shared_10*b_L_d_L_e;
    J[2] = -b_shared_10*b_L_d_p_x;
    J[15] = -b_shared_10*b_L_d_a;
    J[24] = b_shared_11;
    J[34] = b_shared_10*b_R_d_R_e;
    J[20] = b_shared_10*b_R_d_b;
    J[3] = b_shared_10*b_R_d_p_x;
    J[26] = b_shared_11;
    J[30] = (b_L_e_rate_part3 >= b_L_e_rate_part4 ? -b_shared_7 : 0) + b_shared_12;
    J[4] = b_shared_12;
    J[16] = b_L_e_rate_part3 < b_L_e_rate_part4 ? b_shared_1 : 0;
    J[35] = (b_R_e_rate_part5 >= b_R_e_rate_part6 ? -b_shared_8 : 0) + b_shared_13;
    J[21] = b_shared_13;
    J[5] = b_R_e_rate_part5 < b_R_e_rate_part6 ? b_shared_3 : 0;
    J[38] = b_shared_14*b_FL_s_d_FL_a - b_shared_14;
    J[11] = b_shared_14*b_FL_s_d_v_y;
    J[31] = b_shared_14*b_FL_s_d_L_e;
    J[6] = b_shared_14*b_FL_s_d_p_x;
    J[17] = b_shared_14*b_FL_s_d_a;
    J[40] = b_shared_15*b_FR_s_d_FR_a - b_shared_15;
    J[12] = b_shared_15*b_FR_s_d_v_y;
    J[36] = b_shared_15*b_FR_s_d_R_e;
    J[22] = b_shared_15*b_FR_s_d_b;
    J[7] = b_shared_15*b_FR_s_d_p_x;
    return gripper_OK;
}

int gripper_jac_pattern(int *row, int *col)
{
    for (int k = 0; k < gripper_JAC_NNZ; ++k) {
        row[k] = jac_rows[k];
    }
    for (int k = 0; k <= gripper_NX; ++k) {
        col[k] = jac_columns[k];
    }
    return gripper_OK;
}

int gripper_init(const real *p, real *x)
{
    const real p_d = p[gripper_P_d];
    x[gripper_X_p_x] = 0;
    x[gripper_X_p_y] = 0;
    x[gripper_X_v_x] = 0;
    x[gripper_X_v_y] = 0;
    x[gripper_X_a] = -p_d/2;
    x[gripper_X_b] = p_d/2;
    x[gripper_X_va] = 0;
    x[gripper_X_vb] = 0;
    x[gripper_X_L_e] = 0;
    x[gripper_X_R_e] = 0;
    x[gripper_X_FL_a] = 0;
    x[gripper_X_FR_a] = 0;
    return gripper_OK;
}

/* Takes over the next state if it is finite; tiny values become zero. */
static inline int finish(real *x, const real *next)
{
    int finite = 1;
    for (int i = 0; i < gripper_NX; ++i) {
        finite &= next[i] - next[i] == 0;
    }
    if (!finite) {
        return gripper_NOT_FINITE;
    }
    for (int i = 0; i < gripper_NX; ++i) {
        x[i] = fabs(next[i]) < (real)1e-290 ? 0 : next[i];
    }
    return gripper_OK;
}

int gripper_step_rk4(real t, real h, real *x, const real *u, const real *p)
{
#ifdef gripper_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[12], k2[12], k3[12], k4[12], next[12];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < gripper_NX; ++i) {
        next[i] = x[i] + h/2*k1[i];
    }
    status = rates(t + h/2, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < gripper_NX; ++i) {
        next[i] = x[i] + h/2*k2[i];
    }
    status = rates(t + h/2, next, u, p, k3);
    if (status) {
        return status;
    }
    for (int i = 0; i < gripper_NX; ++i) {
        next[i] = x[i] + h*k3[i];
    }
    status = rates(t + h, next, u, p, k4);
    if (status) {
        return status;
    }
    for (int i = 0; i < gripper_NX; ++i) {
        next[i] = x[i] + h/6*(k1[i] + 2*k2[i] + 2*k3[i] + k4[i]);
    }
    return finish(x, next);
}

int gripper_step_heun(real t, real h, real *x, const real *u, const real *p)
{
#ifdef gripper_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[12], k2[12], next[12];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < gripper_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    status = rates(t + h, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < gripper_NX; ++i) {
        next[i] = x[i] + h/2*(k1[i] + k2[i]);
    }
    return finish(x, next);
}

int gripper_step_euler(real t, real h, real *x, const real *u, const real *p)
{
#ifdef gripper_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[12], next[12];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < gripper_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    return finish(x, next);
}

const gripper_real gripper_p0[] = {
    (real)0.5, (real)0.2, (real)0.06, 12, (real)0.5, (real)9.81, 20, (real)0.02, 12, 100000,
    (real)0.001, (real)0.002, 100000, (real)0.001, (real)0.002, 50000, (real)0.002, 50000,
    (real)0.002
};

const char gripper_x_names[] =
    "p.x\0p.y\0v.x\0v.y\0a\0b\0va\0vb\0L.e\0R.e\0FL.a\0FR.a\0";

const char gripper_u_names[] =
    "";

const char gripper_p_names[] =
    "M\0m\0d\0G\0mu\0g\0c\0A\0omega\0L.K\0L.alpha\0L.beta\0R.K\0R.alpha\0R.beta\0FL.K\0"
    "FL.beta\0FR.K\0FR.beta\0";

const char gripper_y_names[] =
    "L\0R\0FL\0FR\0";
