/* Written by nsode: the augmented ODE of a model, in plain C. */
#ifndef belt_drive_H
#define belt_drive_H

#ifdef __cplusplus
extern "C" {
#endif

typedef double belt_drive_real;

enum {
    belt_drive_NX = 5,
    belt_drive_NU = 0,
    belt_drive_NP = 11,
    belt_drive_NY = 1,
    belt_drive_JAC_NNZ = 13
};

/* states */
enum {
    belt_drive_X_q1 = 0,
    belt_drive_X_q2 = 1,
    belt_drive_X_w1 = 2,
    belt_drive_X_w2 = 3,
    belt_drive_X_T_a = 4
};

/* parameters */
enum {
    belt_drive_P_J1 = 0,
    belt_drive_P_J2 = 1,
    belt_drive_P_k = 2,
    belt_drive_P_c = 3,
    belt_drive_P_Ts = 4,
    belt_drive_P_Tc = 5,
    belt_drive_P_ws = 6,
    belt_drive_P_kp = 7,
    belt_drive_P_ref = 8,
    belt_drive_P_T_K = 9,
    belt_drive_P_T_beta = 10
};

/* outputs */
enum {
    belt_drive_Y_T = 0
};

/* What every function returns. From BROKEN on, a condition of the model does not hold (only in
   code compiled with belt_drive_CHECKS): check number status - BROKEN of belt_drive.json. */
enum {
    belt_drive_OK = 0,
    belt_drive_NOT_FINITE = 1,
    belt_drive_SINGULAR = 2,
    belt_drive_BROKEN = 16
};

/* A step leaves x untouched unless it returns 0. */

/* The rates dx of the states x at time t, for inputs u and parameters p. */
int belt_drive_rhs(belt_drive_real t, const belt_drive_real *x, const belt_drive_real *u,
    const belt_drive_real *p, belt_drive_real *dx);
/* The outputs y: the declared ones, then every force. */
int belt_drive_out(belt_drive_real t, const belt_drive_real *x, const belt_drive_real *u,
    const belt_drive_real *p, belt_drive_real *y);
/* The derivatives of the rates by the states, in the places of the pattern. */
int belt_drive_jac(belt_drive_real t, const belt_drive_real *x, const belt_drive_real *u,
    const belt_drive_real *p, belt_drive_real *J);
/* Column j of J has the rows row[k] for k from col[j] to col[j + 1] - 1. */
int belt_drive_jac_pattern(int *row, int *col);
/* The states at the start, for these parameters. */
int belt_drive_init(const belt_drive_real *p, belt_drive_real *x);
/* One step of size h: classical Runge-Kutta. */
int belt_drive_step_rk4(belt_drive_real t, belt_drive_real h, belt_drive_real *x,
    const belt_drive_real *u, const belt_drive_real *p);
/* One step of size h: Heun. */
int belt_drive_step_heun(belt_drive_real t, belt_drive_real h, belt_drive_real *x,
    const belt_drive_real *u, const belt_drive_real *p);
/* One step of size h: explicit Euler. */
int belt_drive_step_euler(belt_drive_real t, belt_drive_real h, belt_drive_real *x,
    const belt_drive_real *u, const belt_drive_real *p);

/* The parameters' defaults, and the names of all places in order, each ended by NUL. */
extern const belt_drive_real belt_drive_p0[];
extern const char belt_drive_x_names[];
extern const char belt_drive_u_names[];
extern const char belt_drive_p_names[];
extern const char belt_drive_y_names[];

#ifdef __cplusplus
}
#endif

#endif
