/* Written by nsode: the augmented ODE of a model, in plain C. */
#ifndef dry_friction_H
#define dry_friction_H

#ifdef __cplusplus
extern "C" {
#endif

typedef double dry_friction_real;

enum {
    dry_friction_NX = 3,
    dry_friction_NU = 0,
    dry_friction_NP = 9,
    dry_friction_NY = 1,
    dry_friction_JAC_NNZ = 5
};

/* states */
enum {
    dry_friction_X_p = 0,
    dry_friction_X_v = 1,
    dry_friction_X_F_a = 2
};

/* parameters */
enum {
    dry_friction_P_M = 0,
    dry_friction_P_F0 = 1,
    dry_friction_P_ramp = 2,
    dry_friction_P_top = 3,
    dry_friction_P_mean = 4,
    dry_friction_P_swing = 5,
    dry_friction_P_omega = 6,
    dry_friction_P_F_K = 7,
    dry_friction_P_F_beta = 8
};

/* outputs */
enum {
    dry_friction_Y_F = 0
};

/* What every function returns. From BROKEN on, a condition of the model does not hold (only in
   code compiled with dry_friction_CHECKS): check number status - BROKEN of dry_friction.json. */
enum {
    dry_friction_OK = 0,
    dry_friction_NOT_FINITE = 1,
    dry_friction_SINGULAR = 2,
    dry_friction_BROKEN = 16
};

/* A step leaves x untouched unless it returns 0. */

/* The rates dx of the states x at time t, for inputs u and parameters p. */
int dry_friction_rhs(dry_friction_real t, const dry_friction_real *x, const dry_friction_real *u,
    const dry_friction_real *p, dry_friction_real *dx);
/* The outputs y: the declared ones, then every force. */
int dry_friction_out(dry_friction_real t, const dry_friction_real *x, const dry_friction_real *u,
    const dry_friction_real *p, dry_friction_real *y);
/* The derivatives of the rates by the states, in the places of the pattern. */
int dry_friction_jac(dry_friction_real t, const dry_friction_real *x, const dry_friction_real *u,
    const dry_friction_real *p, dry_friction_real *J);
/* Column j of J has the rows row[k] for k from col[j] to col[j + 1] - 1. */
int dry_friction_jac_pattern(int *row, int *col);
/* The states at the start, for these parameters. */
int dry_friction_init(const dry_friction_real *p, dry_friction_real *x);
/* One step of size h: classical Runge-Kutta. */
int dry_friction_step_rk4(dry_friction_real t, dry_friction_real h, dry_friction_real *x,
    const dry_friction_real *u, const dry_friction_real *p);
/* One step of size h: Heun. */
int dry_friction_step_heun(dry_friction_real t, dry_friction_real h, dry_friction_real *x,
    const dry_friction_real *u, const dry_friction_real *p);
/* One step of size h: explicit Euler. */
int dry_friction_step_euler(dry_friction_real t, dry_friction_real h, dry_friction_real *x,
    const dry_friction_real *u, const dry_friction_real *p);

/* The parameters' defaults, and the names of all places in order, each ended by NUL. */
extern const dry_friction_real dry_friction_p0[];
extern const char dry_friction_x_names[];
extern const char dry_friction_u_names[];
extern const char dry_friction_p_names[];
extern const char dry_friction_y_names[];

#ifdef __cplusplus
}
#endif

#endif
