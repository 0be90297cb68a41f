/* Written by nsode: the augmented ODE of a model, in plain C. */
#ifndef gripper_H
#define gripper_H

#ifdef __cplusplus
extern "C" {
#endif

typedef double gripper_real;

enum {
    gripper_NX = 12,
    gripper_NU = 0,
    gripper_NP = 19,
    gripper_NY = 4,
    gripper_JAC_NNZ = 41
};

/* states */
enum {
    gripper_X_p_x = 0,
    gripper_X_p_y = 1,
    gripper_X_v_x = 2,
    gripper_X_v_y = 3,
    gripper_X_a = 4,
    gripper_X_b = 5,
    gripper_X_va = 6,
    gripper_X_vb = 7,
    gripper_X_L_e = 8,
    gripper_X_R_e = 9,
    gripper_X_FL_a = 10,
    gripper_X_FR_a = 11
};

/* parameters */
enum {
    gripper_P_M = 0,
    gripper_P_m = 1,
    gripper_P_d = 2,
    gripper_P_G = 3,
    gripper_P_mu = 4,
    gripper_P_g = 5,
    gripper_P_c = 6,
    gripper_P_A = 7,
    gripper_P_omega = 8,
    gripper_P_L_K = 9,
    gripper_P_L_alpha = 10,
    gripper_P_L_beta = 11,
    gripper_P_R_K = 12,
    gripper_P_R_alpha = 13,
    gripper_P_R_beta = 14,
    gripper_P_FL_K = 15,
    gripper_P_FL_beta = 16,
    gripper_P_FR_K = 17,
    gripper_P_FR_beta = 18
};

/* outputs */
enum {
    gripper_Y_L = 0,
    gripper_Y_R = 1,
    gripper_Y_FL = 2,
    gripper_Y_FR = 3
};

/* What every function returns. From BROKEN on, a condition of the model does not hold (only in
   code compiled with gripper_CHECKS): check number status - BROKEN of gripper.json. */
enum {
    gripper_OK = 0,
    gripper_NOT_FINITE = 1,
    gripper_SINGULAR = 2,
    gripper_BROKEN = 16
};

/* A step leaves x untouched unless it returns 0. */

/* The rates dx of the states x at time t, for inputs u and parameters p. */
int gripper_rhs(gripper_real t, const gripper_real *x, const gripper_real *u, const gripper_real *p,
    gripper_real *dx);
/* The outputs y: the declared ones, then every force. */
int gripper_out(gripper_real t, const gripper_real *x, const gripper_real *u, const gripper_real *p,
    gripper_real *y);
/* The derivatives of the rates by the states, in the places of the pattern. */
int gripper_jac(gripper_real t, const gripper_real *x, const gripper_real *u, const gripper_real *p,
    gripper_real *J);
/* Column j of J has the rows row[k] for k from col[j] to col[j + 1] - 1. */
int gripper_jac_pattern(int *row, int *col);
/* The states at the start, for these parameters. */
int gripper_init(const gripper_real *p, gripper_real *x);
/* One step of size h: classical Runge-Kutta. */
int gripper_step_rk4(gripper_real t, gripper_real h, gripper_real *x, const gripper_real *u,
    const gripper_real *p);
/* One step of size h: Heun. */
int gripper_step_heun(gripper_real t, gripper_real h, gripper_real *x, const gripper_real *u,
    const gripper_real *p);
/* One step of size h: explicit Euler. */
int gripper_step_euler(gripper_real t, gripper_real h, gripper_real *x, const gripper_real *u,
    const gripper_real *p);

/* The parameters' defaults, and the names of all places in order, each ended by NUL. */
extern const gripper_real gripper_p0[];
extern const char gripper_x_names[];
extern const char gripper_u_names[];
extern const char gripper_p_names[];
extern const char gripper_y_names[];

#ifdef __cplusplus
}
#endif

#endif
