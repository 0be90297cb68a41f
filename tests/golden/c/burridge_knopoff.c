/* Written by nsode: the augmented ODE of a model, in plain C. */
#include "burridge_knopoff.h"

#include <math.h>

typedef burridge_knopoff_real real;

/* The point of the interval [-Z, Z] nearest to x. */
static inline real sat(real Z, real x)
{
    return fabs(x) <= Z ? x : x > 0 ? Z : x < 0 ? -Z : x + Z;
}

static inline int rates(real t, const real *x, const real *u, const real *p, real *dx)
{
    (void)u;
    const real *const x_x = x + burridge_knopoff_X_x;
    const real *const x_v = x + burridge_knopoff_X_v;
    const real *const x_F_a = x + burridge_knopoff_X_F_a;
    const real p_m = p[burridge_knopoff_P_m];
    const real p_kc = p[burridge_knopoff_P_kc];
    const real p_kp = p[burridge_knopoff_P_kp];
    const real p_V = p[burridge_knopoff_P_V];
    const real p_vc = p[burridge_knopoff_P_vc];
    const real *const p_F0 = p + burridge_knopoff_P_F0;
    const real p_F_K = p[burridge_knopoff_P_F_K];
    const real p_F_beta = p[burridge_knopoff_P_F_beta];
    real b_right[32];
    real b_left[32];
    real b_F[32];
    for (int i = 1; i <= 31; ++i) {
        b_right[i - 1] = x_x[i] - x_x[i - 1];
    }
    b_right[31] = 0;
    b_left[0] = 0;
    for (int i = 2; i <= 32; ++i) {
        b_left[i - 1] = x_x[i - 1] - x_x[i - 2];
    }
    for (int i = 1; i <= 32; ++i) {
        const real b_F_z = x_F_a[i - 1] + p_F_beta*x_v[i - 1];
        const real b_F_Z = p_F0[i - 1]/(1 + fabs(x_v[i - 1])*(1/p_vc))*(1/p_F_K);
        const real b_F_s = sat(b_F_Z, b_F_z);
        b_F[i - 1] = p_F_K*b_F_s;
        dx[burridge_knopoff_X_x + i - 1] = x_v[i - 1];
        dx[burridge_knopoff_X_F_a + i - 1] = (b_F_s - x_F_a[i - 1])*(1/p_F_beta);
    }
    dx[burridge_knopoff_X_v] = (p_kc*(b_right[0] - b_left[0]) + p_kp*(p_V*t - x_x[0]) -
        b_F[0])*(1/p_m);
    for (int i = 2; i <= 31; ++i) {
        dx[burridge_knopoff_X_v + i - 1] = (p_kc*(b_right[i - 1] - b_left[i - 1]) + p_kp*(p_V*t -
            x_x[i - 1]) - b_F[i - 1])*(1/p_m);
    }
    dx[burridge_knopoff_X_v + 31] = (p_kc*(b_right[31] - b_left[31]) + p_kp*(p_V*t - x_x[31]) -
        b_F[31])*(1/p_m);
    return burridge_knopoff_OK;
}

#ifdef burridge_knopoff_CHECKS
static int check(real t, const real *x, const real *u, const real *p)
{
    (void)t;
    (void)u;
    const real *const x_v = x + burridge_knopoff_X_v;
    const real p_vc = p[burridge_knopoff_P_vc];
    const real *const p_F0 = p + burridge_knopoff_P_F0;
    const real p_F_K = p[burridge_knopoff_P_F_K];
    const real p_F_beta = p[burridge_knopoff_P_F_beta];
    for (int i = 1; i <= 32; ++i) {
        if (!(p_F0[i - 1]/(1 + fabs(x_v[i - 1])/p_vc) >= 0)) {
            return burridge_knopoff_BROKEN + 0;
        }
        if (!(p_F0[i - 1] >= 0)) {
            return burridge_knopoff_BROKEN + 1;
        }
    }
    if (!(p_vc > 0)) {
        return burridge_knopoff_BROKEN + 2;
    }
    if (!(p_F_K > 0)) {
        return burridge_knopoff_BROKEN + 3;
    }
    if (!(p_F_beta > 0)) {
        return burridge_knopoff_BROKEN + 4;
    }
    return burridge_knopoff_OK;
}
#endif

static const int jac_rows[] = {
    32, 33, 32, 33, 34, 33, 34, 35, 34, 35, 36, 35, 36, 37, 36, 37,
    38, 37, 38, 39, 38, 39, 40, 39, 40, 41, 40, 41, 42, 41, 42, 43,
    42, 43, 44, 43, 44, 45, 44, 45, 46, 45, 46, 47, 46, 47, 48, 47,
    48, 49, 48, 49, 50, 49, 50, 51, 50, 51, 52, 51, 52, 53, 52, 53,
    54, 53, 54, 55, 54, 55, 56, 55, 56, 57, 56, 57, 58, 57, 58, 59,
    58, 59, 60, 59, 60, 61, 60, 61, 62, 61, 62, 63, 62, 63, 0, 32,
    64, 1, 33, 65, 2, 34, 66, 3, 35, 67, 4, 36, 68, 5, 37, 69,
    6, 38, 70, 7, 39, 71, 8, 40, 72, 9, 41, 73, 10, 42, 74, 11,
    43, 75, 12, 44, 76, 13, 45, 77, 14, 46, 78, 15, 47, 79, 16, 48,
    80, 17, 49, 81, 18, 50, 82, 19, 51, 83, 20, 52, 84, 21, 53, 85,
    22, 54, 86, 23, 55, 87, 24, 56, 88, 25, 57, 89, 26, 58, 90, 27,
    59, 91, 28, 60, 92, 29, 61, 93, 30, 62, 94, 31, 63, 95, 32, 64,
    33, 65, 34, 66, 35, 67, 36, 68, 37, 69, 38, 70, 39, 71, 40, 72,
    41, 73, 42, 74, 43, 75, 44, 76, 45, 77, 46, 78, 47, 79, 48, 80,
    49, 81, 50, 82, 51, 83, 52, 84, 53, 85, 54, 86, 55, 87, 56, 88,
    57, 89, 58, 90, 59, 91, 60, 92, 61, 93, 62, 94, 63, 95
};

static const int jac_columns[] = {
    0, 2, 5, 8, 11, 14, 17, 20, 23, 26, 29, 32, 35, 38, 41, 44,
    47, 50, 53, 56, 59, 62, 65, 68, 71, 74, 77, 80, 83, 86, 89, 92,
    94, 97, 100, 103, 106, 109, 112, 115, 118, 121, 124, 127, 130, 133, 136, 139,
    142, 145, 148, 151, 154, 157, 160, 163, 166, 169, 172, 175, 178, 181, 184, 187,
    190, 192, 194, 196, 198, 200, 202, 204, 206, 208, 210, 212, 214, 216, 218, 220,
    222, 224, 226, 228, 230, 232, 234, 236, 238, 240, 242, 244, 246, 248, 250, 252,
    254
};

static const int jac_places[] = {
    94, 97, 100, 103, 106, 109, 112, 115, 118, 121, 124, 127, 130, 133, 136, 139,
    142, 145, 148, 151, 154, 157, 160, 163, 166, 169, 172, 175, 178, 181, 184, 187,
    2, 5, 8, 11, 14, 17, 20, 23, 26, 29, 32, 35, 38, 41, 44, 47,
    50, 53, 56, 59, 62, 65, 68, 71, 74, 77, 80, 83, 86, 89, 92, -1,
    0, 3, 6, 9, 12, 15, 18, 21, 24, 27, 30, 33, 36, 39, 42, 45,
    48, 51, 54, 57, 60, 63, 66, 69, 72, 75, 78, 81, 84, 87, 90, 93,
    -1, 1, 4, 7, 10, 13, 16, 19, 22, 25, 28, 31, 34, 37, 40, 43,
    46, 49, 52, 55, 58, 61, 64, 67, 70, 73, 76, 79, 82, 85, 88, 91,
    190, 192, 194, 196, 198, 200, 202, 204, 206, 208, 210, 212, 214, 216, 218, 220,
    222, 224, 226, 228, 230, 232, 234, 236, 238, 240, 242, 244, 246, 248, 250, 252,
    95, 98, 101, 104, 107, 110, 113, 116, 119, 122, 125, 128, 131, 134, 137, 140,
    143, 146, 149, 152, 155, 158, 161, 164, 167, 170, 173, 176, 179, 182, 185, 188,
    191, 193, 195, 197, 199, 201, 203, 205, 207, 209, 211, 213, 215, 217, 219, 221,
    223, 225, 227, 229, 231, 233, 235, 237, 239, 241, 243, 245, 247, 249, 251, 253,
    96, 99, 102, 105, 108, 111, 114, 117, 120, 123, 126, 129, 132, 135, 138, 141,
    144, 147, 150, 153, 156, 159, 162, 165, 168, 171, 174, 177, 180, 183, 186, 189
};

int burridge_knopoff_rhs(real t, const real *x, const real *u, const real *p, real *dx)
{
#ifdef burridge_knopoff_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    return rates(t, x, u, p, dx);
}

int burridge_knopoff_out(real t, const real *x, const real *u, const real *p, real *y)
{
    (void)t;
    (void)u;
    const real *const x_v = x + burridge_knopoff_X_v;
    const real *const x_F_a = x + burridge_knopoff_X_F_a;
    const real p_vc = p[burridge_knopoff_P_vc];
    const real *const p_F0 = p + burridge_knopoff_P_F0;
    const real p_F_K = p[burridge_knopoff_P_F_K];
    const real p_F_beta = p[burridge_knopoff_P_F_beta];
    for (int i = 1; i <= 32; ++i) {
        const real b_F_z = x_F_a[i - 1] + p_F_beta*x_v[i - 1];
        const real b_F_Z = p_F0[i - 1]/(1 + fabs(x_v[i - 1])*(1/p_vc))*(1/p_F_K);
        const real b_F_s = sat(b_F_Z, b_F_z);
        const real b_F = p_F_K*b_F_s;
        y[burridge_knopoff_Y_F + i - 1] = b_F;
    }
    real sum1 = 0;
    for (int i = 1; i <= 32; ++i) {
        sum1 += x_v[i - 1];
    }
    y[burridge_knopoff_Y_slip] = sum1/32;
    return burridge_knopoff_OK;
}

int burridge_knopoff_jac(real t, const real *x, const real *u, const real *p, real *J)
{
    (void)t;
    (void)u;
    for (int k = 0; k < burridge_knopoff_JAC_NNZ; ++k) {
        J[k] = 0;
    }
    const real *const x_v = x + burridge_knopoff_X_v;
    const real *const x_F_a = x + burridge_knopoff_X_F_a;
    const real p_m = p[burridge_knopoff_P_m];
    const real p_kc = p[burridge_knopoff_P_kc];
    const real p_kp = p[burridge_knopoff_P_kp];
    const real p_vc = p[burridge_knopoff_P_vc];
    const real *const p_F0 = p + burridge_knopoff_P_F0;
    const real p_F_K = p[burridge_knopoff_P_F_K];
    const real p_F_beta = p[burridge_knopoff_P_F_beta];
    real b_right_d_x_to0[32];
    real b_left_d_x_to0[32];
    const real b_shared_1 = 1/p_vc;
    const real b_shared_2 = 1/p_m;
    const real b_shared_3 = b_shared_2*p_kc;
    const real b_shared_4 = 1/p_F_beta;
    for (int i = 1; i <= 32; ++i) {
        const real b_F_z = x_F_a[i - 1] + p_F_beta*x_v[i - 1];
        const real b_F_Z = p_F0[i - 1]/(1 + fabs(x_v[i - 1])*(1/p_vc))*(1/p_F_K);
        const real b_F_Z_part1 = 1 + fabs(x_v[i - 1])*b_shared_1;
        const real b_F_Z_part1_d_v_to0 = (x_v[i - 1] > 0 ? b_shared_1 : 0) + (x_v[i - 1] < 0 ?
            -b_shared_1 : 0);
        const real b_F_Z_d_v_to0 = 1/p_F_K*(-p_F0[i -
            1]/b_F_Z_part1/b_F_Z_part1)*b_F_Z_part1_d_v_to0;
        const real b_F_s_d_F_a_to0 = fabs(b_F_z) < b_F_Z ? (real)1 : 0;
        const real b_F_s_d_v_to0 = (fabs(b_F_z) < b_F_Z ? p_F_beta : 0) + (b_F_z >= b_F_Z && b_F_z >
            0 ? b_F_Z_d_v_to0 : 0) + (-b_F_z >= b_F_Z && b_F_z < 0 ? -b_F_Z_d_v_to0 : 0);
        const real b_F_d_F_a_to0 = p_F_K*b_F_s_d_F_a_to0;
        const real b_F_d_v_to0 = p_F_K*b_F_s_d_v_to0;
        J[jac_places[i - 1]] += 1;
        J[jac_places[128 + i - 1]] += -b_shared_2*b_F_d_F_a_to0;
        J[jac_places[160 + i - 1]] += -b_shared_2*b_F_d_v_to0;
        J[jac_places[192 + i - 1]] += b_shared_4*b_F_s_d_F_a_to0 - b_shared_4;
        J[jac_places[224 + i - 1]] += b_shared_4*b_F_s_d_v_to0;
    }
    for (int i = 1; i <= 31; ++i) {
        const real b_right_d_x_to1 = 1;
        b_right_d_x_to0[i - 1] = -1;
        if (jac_places[32 + i - 1] >= 0) {
            J[jac_places[32 + i - 1]] += b_shared_3*b_right_d_x_to1;
        }
    }
    {
        const real b_right_d_x_to1 = 0;
        b_right_d_x_to0[31] = 0;
        if (jac_places[32 + 31] >= 0) {
            J[jac_places[32 + 31]] += b_shared_3*b_right_d_x_to1;
        }
    }
    {
        b_left_d_x_to0[0] = 0;
        const real b_left_d_x_tom1 = 0;
        J[jac_places[64 + 0]] += b_shared_3*b_right_d_x_to0[0] + (-b_shared_3*b_left_d_x_to0[0]) -
            b_shared_2*p_kp;
        if (jac_places[96 + 0] >= 0) {
            J[jac_places[96 + 0]] += -b_shared_3*b_left_d_x_tom1;
        }
    }
    for (int i = 2; i <= 32; ++i) {
        b_left_d_x_to0[i - 1] = 1;
        const real b_left_d_x_tom1 = -1;
        if (jac_places[96 + i - 1] >= 0) {
            J[jac_places[96 + i - 1]] += -b_shared_3*b_left_d_x_tom1;
        }
    }
    for (int i = 2; i <= 31; ++i) {
        J[jac_places[64 + i - 1]] += b_shared_3*b_right_d_x_to0[i - 1] +
            (-b_shared_3*b_left_d_x_to0[i - 1]) - b_shared_2*p_kp;
    }
    J[jac_places[64 + 31]] += b_shared_3*b_right_d_x_to0[31] + (-b_shared_3*b_left_d_x_to0[31]) -
        b_shared_2*p_kp;
    return burridge_knopoff_OK;
}

int burridge_knopoff_jac_pattern(int *row, int *col)
{
    for (int k = 0; k < burridge_knopoff_JAC_NNZ; ++k) {
        row[k] = jac_rows[k];
    }
    for (int k = 0; k <= burridge_knopoff_NX; ++k) {
        col[k] = jac_columns[k];
    }
    return burridge_knopoff_OK;
}

int burridge_knopoff_init(const real *p, real *x)
{
    (void)p;
    for (int i = 1; i <= 32; ++i) {
        x[burridge_knopoff_X_x + i - 1] = (real)0.02*sin(3*(real)i);
        x[burridge_knopoff_X_v + i - 1] = 0;
        x[burridge_knopoff_X_F_a + i - 1] = 0;
    }
    return burridge_knopoff_OK;
}

/* Takes over the next state if it is finite; tiny values become zero. */
static inline int finish(real *x, const real *next)
{
    int finite = 1;
    for (int i = 0; i < burridge_knopoff_NX; ++i) {
        finite &= next[i] - next[i] == 0;
    }
    if (!finite) {
        return burridge_knopoff_NOT_FINITE;
    }
    for (int i = 0; i < burridge_knopoff_NX; ++i) {
        x[i] = fabs(next[i]) < (real)1e-290 ? 0 : next[i];
    }
    return burridge_knopoff_OK;
}

int burridge_knopoff_step_rk4(real t, real h, real *x, const real *u, const real *p)
{
#ifdef burridge_knopoff_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[96], k2[96], k3[96], k4[96], next[96];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < burridge_knopoff_NX; ++i) {
        next[i] = x[i] + h/2*k1[i];
    }
    status = rates(t + h/2, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < burridge_knopoff_NX; ++i) {
        next[i] = x[i] + h/2*k2[i];
    }
    status = rates(t + h/2, next, u, p, k3);
    if (status) {
        return status;
    }
    for (int i = 0; i < burridge_knopoff_NX; ++i) {
        next[i] = x[i] + h*k3[i];
    }
    status = rates(t + h, next, u, p, k4);
    if (status) {
        return status;
    }
    for (int i = 0; i < burridge_knopoff_NX; ++i) {
        next[i] = x[i] + h/6*(k1[i] + 2*k2[i] + 2*k3[i] + k4[i]);
    }
    return finish(x, next);
}

int burridge_knopoff_step_heun(real t, real h, real *x, const real *u, const real *p)
{
#ifdef burridge_knopoff_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[96], k2[96], next[96];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < burridge_knopoff_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    status = rates(t + h, next, u, p, k2);
    if (status) {
        return status;
    }
    for (int i = 0; i < burridge_knopoff_NX; ++i) {
        next[i] = x[i] + h/2*(k1[i] + k2[i]);
    }
    return finish(x, next);
}

int burridge_knopoff_step_euler(real t, real h, real *x, const real *u, const real *p)
{
#ifdef burridge_knopoff_CHECKS
    const int broken = check(t, x, u, p);
    if (broken) {
        return broken;
    }
#endif
    real k1[96], next[96];
    int status;
    status = rates(t, x, u, p, k1);
    if (status) {
        return status;
    }
    for (int i = 0; i < burridge_knopoff_NX; ++i) {
        next[i] = x[i] + h*k1[i];
    }
    return finish(x, next);
}

const burridge_knopoff_real burridge_knopoff_p0[] = {
    1, 40, 10, (real)0.01, (real)0.1, (real)1.5205378626684307, (real)1.7279894445553152,
    (real)2.3251439200785584, (real)2.456472625363814, (real)1.9338241249511134,
    (real)1.5059841879535691, (real)1.7859086652519245, (real)2.3725565802396744,
    (real)2.425451762267059, (real)1.8688125731480356, (real)1.50012241332069,
    (real)1.8475946894488917, (real)2.4134143397450516, (real)2.3869453407789445,
    (real)1.8061091822952848, (real)1.5030556730383124, (real)1.9119621900257064,
    (real)2.446998331800279, (real)2.3416308573680604, (real)1.7468171794451206,
    (real)1.5147323582312575, (real)1.9778786609574646, (real)2.472717667012385,
    (real)2.290305592106157, (real)1.6919797704056718, (real)1.534947024906619,
    (real)2.0441843430520006, (real)2.4901198297201557, (real)2.233872581022567,
    (real)1.6425617851854177, (real)1.5633440086126762, (real)2.1097126291895023, 10000,
    (real)0.01
};

const char burridge_knopoff_x_names[] =
    "x[1]\0x[2]\0x[3]\0x[4]\0x[5]\0x[6]\0x[7]\0x[8]\0x[9]\0x[10]\0x[11]\0x[12]\0x[13]\0x[14]\0"
    "x[15]\0x[16]\0x[17]\0x[18]\0x[19]\0x[20]\0x[21]\0x[22]\0x[23]\0x[24]\0x[25]\0x[26]\0"
    "x[27]\0x[28]\0x[29]\0x[30]\0x[31]\0x[32]\0v[1]\0v[2]\0v[3]\0v[4]\0v[5]\0v[6]\0v[7]\0v[8]\0"
    "v[9]\0v[10]\0v[11]\0v[12]\0v[13]\0v[14]\0v[15]\0v[16]\0v[17]\0v[18]\0v[19]\0v[20]\0v[21]\0"
    "v[22]\0v[23]\0v[24]\0v[25]\0v[26]\0v[27]\0v[28]\0v[29]\0v[30]\0v[31]\0v[32]\0F[1].a\0"
    "F[2].a\0F[3].a\0F[4].a\0F[5].a\0F[6].a\0F[7].a\0F[8].a\0F[9].a\0F[10].a\0F[11].a\0"
    "F[12].a\0F[13].a\0F[14].a\0F[15].a\0F[16].a\0F[17].a\0F[18].a\0F[19].a\0F[20].a\0F[21].a\0"
    "F[22].a\0F[23].a\0F[24].a\0F[25].a\0F[26].a\0F[27].a\0F[28].a\0F[29].a\0F[30].a\0F[31].a\0"
    "F[32].a\0";

const char burridge_knopoff_u_names[] =
    "";

const char burridge_knopoff_p_names[] =
    "m\0kc\0kp\0V\0vc\0F0[1]\0F0[2]\0F0[3]\0F0[4]\0F0[5]\0F0[6]\0F0[7]\0F0[8]\0F0[9]\0F0[10]\0"
    "F0[11]\0F0[12]\0F0[13]\0F0[14]\0F0[15]\0F0[16]\0F0[17]\0F0[18]\0F0[19]\0F0[20]\0F0[21]\0"
    "F0[22]\0F0[23]\0F0[24]\0F0[25]\0F0[26]\0F0[27]\0F0[28]\0F0[29]\0F0[30]\0F0[31]\0F0[32]\0"
    "F.K\0F.beta\0";

const char burridge_knopoff_y_names[] =
    "slip\0F[1]\0F[2]\0F[3]\0F[4]\0F[5]\0F[6]\0F[7]\0F[8]\0F[9]\0F[10]\0F[11]\0F[12]\0F[13]\0"
    "F[14]\0F[15]\0F[16]\0F[17]\0F[18]\0F[19]\0F[20]\0F[21]\0F[22]\0F[23]\0F[24]\0F[25]\0"
    "F[26]\0F[27]\0F[28]\0F[29]\0F[30]\0F[31]\0F[32]\0";
