/* Written by nsode: the augmented ODE of a model, in plain C. */
#include "cart_pole.h"

#include <math.h>

typedef cart_pole_real real;

/* The point of the interval [-Z, Z] nearest to x. */
static inline real sat(real Z, real x)
{
    return fabs(x) <= Z ? x : x > 0 ? Z : x < 0 ? -Z : x + Z;
}

/* Solves a 2x2 system in place; 0 if the matrix is singular to working accuracy. */
static inline int solve2(const real *a, real *b)
{
    const real down = a[0]*a[3], up = a[1]*a[2], det = down - up;
    const real first = a[3]*b[0] - a[1]*b[1];
    const real second = a[0]*b[1] - a[2]*b[0];
    if (fabs(det) <= (real)8.9e-16*(fabs(down) + fabs(up))) {
        return 0;
    }
    b[0] = first/det;
    b[1] = second/det;
    return 1;
}

static inline int rates(real t, const real *x, const real *u, const real *p, real *dx)
{
    (void)t;
    const real x_phi = x[cart_pole_X_phi];
    const real x_v = x[cart_pole_X_v];
    const real x_w = x[cart_pole_X_w];
    const real x_F_a = x[cart_pole_X_F_a];
    const real x_T_a = x[cart_pole_X_T_a];
    const real u_fe = u[cart_pole_U_fe];
    const real p_mc = p[cart_pole_P_mc];
    const real p_mp = p[cart_pole_P_mp];
    const real p_l = p[cart_pole_P_l];
    const real p_g = p[cart_pole_P_g];
    const real p_Fc = p[cart_pole_P_Fc];
    const real p_T0 = p[cart_pole_P_T0];
    const real p_F_K = p[cart_pole_P_F_K];
    const real p_F_beta = p[cart_pole_P_F_beta];
    const real p_T_K = p[cart_pole_P_T_K];
    const real p_T_beta = p[cart_pole_P_T_beta];
    const real b_F_z = x_F_a + p_F_beta*x_v;
    const real b_F_Z = p_Fc/p_F_K;
    const real b_F_s = sat(b_F_Z, b_F_z);
    const real b_F = p_F_K*b_F_s;
    const real b_T_z = x_T_a + p_T_beta*x_w;
    const real b_T_Z = p_T0/p_T_K;
    const real b_T_s = sat(b_T_Z, b_T_z);
    const real b_T = p_T_K*b_T_s;
    real matrix1[] = {p_mc + p_mp, p_mp*p_l*cos(x_phi), p_mp*p_l*cos(x_phi), p_mp*(p_l*p_l)};
    real vector2[] = {u_fe + p_mp*p_l*(x_w*x_w)*sin(x_phi) - b_F, -p_mp*p_g*p_l*sin(x_phi) - b_T};
    if (!solve2(matrix1, vector2)) {
        return cart_pole_SINGULAR;
    }
    const real b_v_rate = vector2[0];
    const real b_w_rate = vector2[1];
    dx[cart_pole_X_x] = x_v;
    dx[cart_pole_X_phi] = x_w;
    dx[cart_pole_X_v] = b_v_rate;
    dx[cart_pole_X_w] = b_w_rate;
    dx[cart_pole_X_F_a] = (b_F_s - x_F_a)*(1/p_F_beta);
    dx[cart_pole_X_T_a] = (b_T_s - x_T_a)*(1/p_T_beta);
    return cart_pole_OK;
}

#ifdef cart_pole_CHECKS
static int check(real t, const real *x, const real *u, const real *p)
{
    (void)t;
    (void)x;
    (void)u;
    const real p_Fc = p[cart_pole_P_Fc];
    const real p_T0 = p[cart_pole_P_T0];
    const real p_F_K = p[cart_pole_P_F_K];
    const real p_F_beta = p[cart_pole_P_F_beta];
    const real p_T_K = p[cart_pole_P_T_K];
    const real p_T_beta = p[cart_pole_P_T_beta];
    if (!(p_Fc >= 0)) {
        return cart_pole_BROKEN + 0;
    }
    if (!(p_Fc >= 0)) {
        return cart_pole_BROKEN + 1;
    }
    if (!(p_T0 >= 0)) {
        return cart_pole_BROKEN + 2;
    }
    if (!(p_T0 >= 0)) {
        return cart_pole_BROKEN + 3;
    }
    if (!(p_F_K > 0)) {
        return cart_pole_BROKEN + 4;
    }
    if (!(p_F_beta > 0)) {
        return cart_pole_BROKEN + 5;
    }
    if (!(p_T_K > 0)) {
        return cart_pole_BROKEN + 6;
    }
    if (!(p_T_beta > 0)) {
        return cart_pole_BROKEN + 7;
    }
    return cart_pole_OK;
}
#endif

static const int jac_rows[] = {
    2, 3, 0, 2, 3, 4, 1, 2, 3, 5, 2, 3, 4, 2, 3, 5
};

static const int jac_columns[] = {
    0, 0, 2, 6, 10, 13, 16
};

int cart_pole_rhs(real t, const real *x, const real *u, const real *p, real *dx)
{
#ifdef cart_pole_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    return rates(t, x, u, p, dx);
}

int cart_pole_out(real t, const real *x, const real *u, const real *p, real *y)
{
    (void)t;
    (void)u;
    const real x_x = x[cart_pole_X_x];
    const real x_phi = x[cart_pole_X_phi];
    const real x_v = x[cart_pole_X_v];
    const real x_w = x[cart_pole_X_w];
    const real x_F_a = x[cart_pole_X_F_a];
    const real x_T_a = x[cart_pole_X_T_a];
    const real p_l = p[cart_pole_P_l];
    const real p_Fc = p[cart_pole_P_Fc];
    const real p_T0 = p[cart_pole_P_T0];
    const real p_F_K = p[cart_pole_P_F_K];
    const real p_F_beta = p[cart_pole_P_F_beta];
    const real p_T_K = p[cart_pole_P_T_K];
    const real p_T_beta = p[cart_pole_P_T_beta];
    const real b_F_z = x_F_a + p_F_beta*x_v;
    const real b_F_Z = p_Fc/p_F_K;
    const real b_F_s = sat(b_F_Z, b_F_z);
    const real b_F = p_F_K*b_F_s;
    const real b_T_z = x_T_a + p_T_beta*x_w;
    const real b_T_Z = p_T0/p_T_K;
    const real b_T_s = sat(b_T_Z, b_T_z);
    const real b_T = p_T_K*b_T_s;
    y[cart_pole_Y_tip_x] = x_x + p_l*sin(x_phi);
    y[cart_pole_Y_tip_y] = -p_l*cos(x_phi);
    y[cart_pole_Y_F] = b_F;
    y[cart_pole_Y_T] = b_T;
    return cart_pole_OK;
}

int cart_pole_jac(real t, const real *x, const real *u, const real *p, real *J)
{
    (void)t;
    const real x_phi = x[cart_pole_X_phi];
    const real x_v = x[cart_pole_X_v];
    const real x_w = x[cart_pole_X_w];
    const real x_F_a = x[cart_pole_X_F_a];
    const real x_T_a = x[cart_pole_X_T_a];
    const real u_fe = u[cart_pole_U_fe];
    const real p_mc = p[cart_pole_P_mc];
    const real p_mp = p[cart_pole_P_mp];
    const real p_l = p[cart_pole_P_l];
    const real p_g = p[cart_pole_P_g];
    const real p_Fc = p[cart_pole_P_Fc];
    const real p_T0 = p[cart_pole_P_T0];
    const real p_F_K = p[cart_pole_P_F_K];
    const real p_F_beta = p[cart_pole_P_F_beta];
    const real p_T_K = p[cart_pole_P_T_K];
    const real p_T_beta = p[cart_pole_P_T_beta];
    const real b_shared_1 = p_mp*p_l;
    const real b_shared_2 = p_mc + p_mp;
    const real b_shared_3 = cos(x_phi);
    const real b_shared_4 = b_shared_1*b_shared_3;
    const real b_shared_5 = p_mp*(p_l*p_l);
    const real b_shared_6 = sin(x_phi);
    const real b_shared_7 = 1/p_F_beta;
    const real b_shared_8 = 1/p_T_beta;
    const real b_F_z = x_F_a + p_F_beta*x_v;
    const real b_F_Z = p_Fc/p_F_K;
    const real b_F_s = sat(b_F_Z, b_F_z);
    const real b_F = p_F_K*b_F_s;
    const real b_T_z = x_T_a + p_T_beta*x_w;
    const real b_T_Z = p_T0/p_T_K;
    const real b_T_s = sat(b_T_Z, b_T_z);
    const real b_T = p_T_K*b_T_s;
    real matrix1[] = {p_mc + p_mp, p_mp*p_l*cos(x_phi), p_mp*p_l*cos(x_phi), p_mp*(p_l*p_l)};
    real vector2[] = {u_fe + p_mp*p_l*(x_w*x_w)*sin(x_phi) - b_F, -p_mp*p_g*p_l*sin(x_phi) - b_T};
    if (!solve2(matrix1, vector2)) {
        return cart_pole_SINGULAR;
    }
    const real b_v_rate = vector2[0];
    const real b_w_rate = vector2[1];
    const real b_F_s_d_F_a = fabs(b_F_z) < b_F_Z ? (real)1 : 0;
    const real b_F_s_d_v = fabs(b_F_z) < b_F_Z ? p_F_beta : 0;
    const real b_T_s_d_T_a = fabs(b_T_z) < b_T_Z ? (real)1 : 0;
    const real b_T_s_d_w = fabs(b_T_z) < b_T_Z ? p_T_beta : 0;
    const real b_v_rate_part1 = b_shared_1*(x_w*x_w);
    const real b_v_rate_part1_d_w = b_shared_1*(2*x_w);
    real matrix3[] = {b_shared_2, b_shared_4, b_shared_4, b_shared_5};
    real vector4[] = {b_shared_6*b_v_rate_part1_d_w, -p_T_K*b_T_s_d_w};
    if (!solve2(matrix3, vector4)) {
        return cart_pole_SINGULAR;
    }
    const real b_v_rate_d_w = vector4[0];
    const real b_w_rate_d_w = vector4[1];
    real matrix5[] = {b_shared_2, b_shared_4, b_shared_4, b_shared_5};
    real vector6[] = {b_v_rate_part1*b_shared_3 + (-b_w_rate*b_shared_1*(-b_shared_6)),
        -p_mp*p_g*p_l*b_shared_3 + (-b_v_rate*b_shared_1*(-b_shared_6))};
    if (!solve2(matrix5, vector6)) {
        return cart_pole_SINGULAR;
    }
    const real b_v_rate_d_phi = vector6[0];
    const real b_w_rate_d_phi = vector6[1];
    real matrix7[] = {b_shared_2, b_shared_4, b_shared_4, b_shared_5};
    real vector8[] = {-p_F_K*b_F_s_d_F_a, 0};
    if (!solve2(matrix7, vector8)) {
        return cart_pole_SINGULAR;
    }
    const real b_v_rate_d_F_a = vector8[0];
    const real b_w_rate_d_F_a = vector8[1];
    real matrix9[] = {b_shared_2, b_shared_4, b_shared_4, b_shared_5};
    real vector10[] = {-p_F_K*b_F_s_d_v, 0};
    if (!solve2(matrix9, vector10)) {
        return cart_pole_SINGULAR;
    }
    const real b_v_rate_d_v = vector10[0];
    const real b_w_rate_d_v = vector10[1];
    real matrix11[] = {b_shared_2, b_shared_4, b_shared_4, b_shared_5};
    real vector12[] = {0, -p_T_K*b_T_s_d_T_a};
    if (!solve2(matrix11, vector12)) {
        return cart_pole_SINGULAR;
    }
    const real b_v_rate_d_T_a = vector12[0];
    const real b_w_rate_d_T_a = vector12[1];
    J[2] = 1;
    J[6] = 1;
    J[7] = b_v_rate_d_w;
    J[0] = b_v_rate_d_phi;
    J[10] = b_v_rate_d_F_a;
    J[3] = b_v_rate_d_v;
    J[13] = b_v_rate_d_T_a;
    J[8] = b_w_rate_d_w;
    J[1] = b_w_rate_d_phi;
    J[11] = b_w_rate_d_F_a;
    J[4] = b_w_rate_d_v;
    J[14] = b_w_rate_d_T_a;
    J[12] = b_shared_7*b_F_s_d_F_a - b_shared_7;
    J[5] = b_shared_7*b_F_s_d_v;
    J[15] = b_shared_8*b_T_s_d_T_a - b_shared_8;
    J[9] = b_shared_8*b_T_s_d_w;
    return cart_pole_OK;
}

int cart_pole_jac_pattern(int *row, int *col)
{
    for (int k = 0; k < cart_pole_JAC_NNZ; ++k) {
        row[k] = jac_rows[k];
    }
    for (int k = 0; k <= cart_pole_NX; ++k) {
        col[k] = jac_columns[k];
    }
    return cart_pole_OK;
}

int cart_pole_init(const real *p, real *x)
{
    (void)p;
    x[cart_pole_X_x] = 0;
    x[cart_pole_X_phi] = (real)2.9670597283903604;
    x[cart_pole_X_v] = 0;
    x[cart_pole_X_w] = 0;
    x[cart_pole_X_F_a] = 0;
    x[cart_pole_X_T_a] = 0;
    return cart_pole_OK;
}

/* Takes over the next state if it is finite; tiny values become zero. */
static inline int finish(real *x, const real *next)
{
    int finite = 1;
    for (int i = 0; i < cart_pole_NX; ++i) {
        finite &= next[i] - next[i] == 0;
    }
    if (!finite) {
        return cart_pole_NOT_FINITE;
    }
    for (int i = 0; i < cart_pole_NX; ++i) {
        x[i] = fabs(next[i]) < (real)1e-290 ? 0 : next[i];
    }
    return cart_pole_OK;
}

int cart_pole_step_rk4(real t, real h, real *x, const real *u, const real *p)
{
#ifdef cart_pole_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[6], k2[6], k3[6], k4[6], next[6];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < cart_pole_NX; ++i) {
        next[i] = x[i] + h/2*k1[i];
    }
    status = rates(t + h/2, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < cart_pole_NX; ++i) {
        next[i] = x[i] + h/2*k2[i];
    }
    status = rates(t + h/2, next, u, p, k3);
    if (status) {
        return status;
    }
    for (int i = 0; i < cart_pole_NX; ++i) {
        next[i] = x[i] + h*k3[i];
    }
    status = rates(t + h, next, u, p, k4);
    if (status) {
        return status;
    }
    for (int i = 0; i < cart_pole_NX; ++i) {
        next[i] = x[i] + h/6*(k1[i] + 2*k2[i] + 2*k3[i] + k4[i]);
    }
    return finish(x, next);
}

int cart_pole_step_heun(real t, real h, real *x, const real *u, const real *p)
{
#ifdef cart_pole_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[6], k2[6], next[6];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < cart_pole_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    status = rates(t + h, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < cart_pole_NX; ++i) {
        next[i] = x[i] + h/2*(k1[i] + k2[i]);
    }
    return finish(x, next);
}

int cart_pole_step_euler(real t, real h, real *x, const real *u, const real *p)
{
#ifdef cart_pole_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[6], next[6];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < cart_pole_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    return finish(x, next);
}

const cart_pole_real cart_pole_p0[] = {
    1, (real)0.2, (real)0.4, (real)9.81, (real)0.4, (real)0.004, 20000, (real)0.005, 50,
    (real)0.02
};

const char cart_pole_x_names[] =
    "x\0phi\0v\0w\0F.a\0T.a\0";

const char cart_pole_u_names[] =
    "fe\0";

const char cart_pole_p_names[] =
    "mc\0mp\0l\0g\0Fc\0T0\0F.K\0F.beta\0T.K\0T.beta\0";

const char cart_pole_y_names[] =
    "tip.x\0tip.y\0F\0T\0";
