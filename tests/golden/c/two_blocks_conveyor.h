/* Written by nsode: the augmented ODE of a model, in plain C. */
#ifndef two_blocks_conveyor_H
#define two_blocks_conveyor_H

#ifdef __cplusplus
extern "C" {
#endif

typedef double two_blocks_conveyor_real;

enum {
    two_blocks_conveyor_NX = 14,
    two_blocks_conveyor_NU = 0,
    two_blocks_conveyor_NP = 23,
    two_blocks_conveyor_NY = 6,
    two_blocks_conveyor_JAC_NNZ = 53
};

/* states */
enum {
    two_blocks_conveyor_X_p1_x = 0,
    two_blocks_conveyor_X_p1_y = 1,
    two_blocks_conveyor_X_p2_x = 2,
    two_blocks_conveyor_X_p2_y = 3,
    two_blocks_conveyor_X_v1_x = 4,
    two_blocks_conveyor_X_v1_y = 5,
    two_blocks_conveyor_X_v2_x = 6,
    two_blocks_conveyor_X_v2_y = 7,
    two_blocks_conveyor_X_N1_e = 8,
    two_blocks_conveyor_X_N2_e = 9,
    two_blocks_conveyor_X_N3_e = 10,
    two_blocks_conveyor_X_F1_a = 11,
    two_blocks_conveyor_X_F2_a = 12,
    two_blocks_conveyor_X_F3_a = 13
};

/* parameters */
enum {
    two_blocks_conveyor_P_M1 = 0,
    two_blocks_conveyor_P_M2 = 1,
    two_blocks_conveyor_P_Ks = 2,
    two_blocks_conveyor_P_mu1 = 3,
    two_blocks_conveyor_P_mu2 = 4,
    two_blocks_conveyor_P_mu3 = 5,
    two_blocks_conveyor_P_u = 6,
    two_blocks_conveyor_P_g = 7,
    two_blocks_conveyor_P_N1_K = 8,
    two_blocks_conveyor_P_N1_alpha = 9,
    two_blocks_conveyor_P_N1_beta = 10,
    two_blocks_conveyor_P_N2_K = 11,
    two_blocks_conveyor_P_N2_alpha = 12,
    two_blocks_conveyor_P_N2_beta = 13,
    two_blocks_conveyor_P_N3_K = 14,
    two_blocks_conveyor_P_N3_alpha = 15,
    two_blocks_conveyor_P_N3_beta = 16,
    two_blocks_conveyor_P_F1_K = 17,
    two_blocks_conveyor_P_F1_beta = 18,
    two_blocks_conveyor_P_F2_K = 19,
    two_blocks_conveyor_P_F2_beta = 20,
    two_blocks_conveyor_P_F3_K = 21,
    two_blocks_conveyor_P_F3_beta = 22
};

/* outputs */
enum {
    two_blocks_conveyor_Y_N1 = 0,
    two_blocks_conveyor_Y_N2 = 1,
    two_blocks_conveyor_Y_N3 = 2,
    two_blocks_conveyor_Y_F1 = 3,
    two_blocks_conveyor_Y_F2 = 4,
    two_blocks_conveyor_Y_F3 = 5
};

/* What every function returns. From BROKEN on, a condition of the model does not hold (only in
   code compiled with two_blocks_conveyor_CHECKS): check number status - BROKEN of two_blocks_conveyor.json. */
enum {
    two_blocks_conveyor_OK = 0,
    two_blocks_conveyor_NOT_FINITE = 1,
    two_blocks_conveyor_SINGULAR = 2,
    two_blocks_conveyor_BROKEN = 16
};

/* A step leaves x untouched unless it returns 0. */

/* The rates dx of the states x at time t, for inputs u and parameters p. */
int two_blocks_conveyor_rhs(two_blocks_conveyor_real t, const two_blocks_conveyor_real *x,
    const two_blocks_conveyor_real *u, const two_blocks_conveyor_real *p, two_blocks_conveyor_real
    *dx);
/* The outputs y: the declared ones, then every force. */
int two_blocks_conveyor_out(two_blocks_conveyor_real t, const two_blocks_conveyor_real *x,
    const two_blocks_conveyor_real *u, const two_blocks_conveyor_real *p, two_blocks_conveyor_real
    *y);
/* The derivatives of the rates by the states, in the places of the pattern. */
int two_blocks_conveyor_jac(two_blocks_conveyor_real t, const two_blocks_conveyor_real *x,
    const two_blocks_conveyor_real *u, const two_blocks_conveyor_real *p, two_blocks_conveyor_real
    *J);
/* Column j of J has the rows row[k] for k from col[j] to col[j + 1] - 1. */
int two_blocks_conveyor_jac_pattern(int *row, int *col);
/* The states at the start, for these parameters. */
int two_blocks_conveyor_init(const two_blocks_conveyor_real *p, two_blocks_conveyor_real *x);
/* One step of size h: classical Runge-Kutta. */
int two_blocks_conveyor_step_rk4(two_blocks_conveyor_real t, two_blocks_conveyor_real h,
    two_blocks_conveyor_real *x, const two_blocks_conveyor_real *u, const two_blocks_conveyor_real
    *p);
/* One step of size h: Heun. */
int two_blocks_conveyor_step_heun(two_blocks_conveyor_real t, two_blocks_conveyor_real h,
    two_blocks_conveyor_real *x, const two_blocks_conveyor_real *u, const two_blocks_conveyor_real
    *p);
/* One step of size h: explicit Euler. */
int two_blocks_conveyor_step_euler(two_blocks_conveyor_real t, two_blocks_conveyor_real h,
    two_blocks_conveyor_real *x, const two_blocks_conveyor_real *u, const two_blocks_conveyor_real
    *p);

/* The parameters' defaults, and the names of all places in order, each ended by NUL. */
extern const two_blocks_conveyor_real two_blocks_conveyor_p0[];
extern const char two_blocks_conveyor_x_names[];
extern const char two_blocks_conveyor_u_names[];
extern const char two_blocks_conveyor_p_names[];
extern const char two_blocks_conveyor_y_names[];

#ifdef __cplusplus
}
#endif

#endif
