/* Written by nsode: the augmented ODE of a model, in plain C. */
#ifndef haptic_wall_H
#define haptic_wall_H

#ifdef __cplusplus
extern "C" {
#endif

typedef double haptic_wall_real;

enum {
    haptic_wall_NX = 6,
    haptic_wall_NU = 2,
    haptic_wall_NP = 10,
    haptic_wall_NY = 4,
    haptic_wall_JAC_NNZ = 16
};

/* states */
enum {
    haptic_wall_X_p_x = 0,
    haptic_wall_X_p_y = 1,
    haptic_wall_X_v_x = 2,
    haptic_wall_X_v_y = 3,
    haptic_wall_X_N_e = 4,
    haptic_wall_X_F_a = 5
};

/* inputs */
enum {
    haptic_wall_U_hand_x = 0,
    haptic_wall_U_hand_y = 1
};

/* parameters */
enum {
    haptic_wall_P_m = 0,
    haptic_wall_P_b = 1,
    haptic_wall_P_k = 2,
    haptic_wall_P_c = 3,
    haptic_wall_P_mu = 4,
    haptic_wall_P_N_K = 5,
    haptic_wall_P_N_alpha = 6,
    haptic_wall_P_N_beta = 7,
    haptic_wall_P_F_K = 8,
    haptic_wall_P_F_beta = 9
};

/* outputs */
enum {
    haptic_wall_Y_felt_x = 0,
    haptic_wall_Y_felt_y = 1,
    haptic_wall_Y_N = 2,
    haptic_wall_Y_F = 3
};

/* What every function returns. From BROKEN on, a condition of the model does not hold (only in
   code compiled with haptic_wall_CHECKS): check number status - BROKEN of haptic_wall.json. */
enum {
    haptic_wall_OK = 0,
    haptic_wall_NOT_FINITE = 1,
    haptic_wall_SINGULAR = 2,
    haptic_wall_BROKEN = 16
};

/* A step leaves x untouched unless it returns 0. */

/* The rates dx of the states x at time t, for inputs u and parameters p. */
int haptic_wall_rhs(haptic_wall_real t, const haptic_wall_real *x, const haptic_wall_real *u,
    const haptic_wall_real *p, haptic_wall_real *dx);
/* The outputs y: the declared ones, then every force. */
int haptic_wall_out(haptic_wall_real t, const haptic_wall_real *x, const haptic_wall_real *u,
    const haptic_wall_real *p, haptic_wall_real *y);
/* The derivatives of the rates by the states, in the places of the pattern. */
int haptic_wall_jac(haptic_wall_real t, const haptic_wall_real *x, const haptic_wall_real *u,
    const haptic_wall_real *p, haptic_wall_real *J);
/* Column j of J has the rows row[k] for k from col[j] to col[j + 1] - 1. */
int haptic_wall_jac_pattern(int *row, int *col);
/* The states at the start, for these parameters. */
int haptic_wall_init(const haptic_wall_real *p, haptic_wall_real *x);
/* One step of size h: classical Runge-Kutta. */
int haptic_wall_step_rk4(haptic_wall_real t, haptic_wall_real h, haptic_wall_real *x,
    const haptic_wall_real *u, const haptic_wall_real *p);
/* One step of size h: Heun. */
int haptic_wall_step_heun(haptic_wall_real t, haptic_wall_real h, haptic_wall_real *x,
    const haptic_wall_real *u, const haptic_wall_real *p);
/* One step of size h: explicit Euler. */
int haptic_wall_step_euler(haptic_wall_real t, haptic_wall_real h, haptic_wall_real *x,
    const haptic_wall_real *u, const haptic_wall_real *p);

/* The parameters' defaults, and the names of all places in order, each ended by NUL. */
extern const haptic_wall_real haptic_wall_p0[];
extern const char haptic_wall_x_names[];
extern const char haptic_wall_u_names[];
extern const char haptic_wall_p_names[];
extern const char haptic_wall_y_names[];

#ifdef __cplusplus
}
#endif

#endif
