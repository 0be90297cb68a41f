/* Written by nsode: the augmented ODE of a model, in plain C. */
#ifndef frictional_contact_H
#define frictional_contact_H

#ifdef __cplusplus
extern "C" {
#endif

typedef double frictional_contact_real;

enum {
    frictional_contact_NX = 9,
    frictional_contact_NU = 0,
    frictional_contact_NP = 7,
    frictional_contact_NY = 3,
    frictional_contact_JAC_NNZ = 31
};

/* states */
enum {
    frictional_contact_X_p_x = 0,
    frictional_contact_X_p_y = 1,
    frictional_contact_X_p_z = 2,
    frictional_contact_X_v_x = 3,
    frictional_contact_X_v_y = 4,
    frictional_contact_X_v_z = 5,
    frictional_contact_X_N_e = 6,
    frictional_contact_X_F_a_x = 7,
    frictional_contact_X_F_a_y = 8
};

/* parameters */
enum {
    frictional_contact_P_M = 0,
    frictional_contact_P_mu = 1,
    frictional_contact_P_N_K = 2,
    frictional_contact_P_N_alpha = 3,
    frictional_contact_P_N_beta = 4,
    frictional_contact_P_F_K = 5,
    frictional_contact_P_F_beta = 6
};

/* outputs */
enum {
    frictional_contact_Y_N = 0,
    frictional_contact_Y_F_x = 1,
    frictional_contact_Y_F_y = 2
};

/* What every function returns. From BROKEN on, a condition of the model does not hold (only in
   code compiled with frictional_contact_CHECKS): check number status - BROKEN of frictional_contact.json. */
enum {
    frictional_contact_OK = 0,
    frictional_contact_NOT_FINITE = 1,
    frictional_contact_SINGULAR = 2,
    frictional_contact_BROKEN = 16
};

/* A step leaves x untouched unless it returns 0. */

/* The rates dx of the states x at time t, for inputs u and parameters p. */
int frictional_contact_rhs(frictional_contact_real t, const frictional_contact_real *x,
    const frictional_contact_real *u, const frictional_contact_real *p, frictional_contact_real
    *dx);
/* The outputs y: the declared ones, then every force. */
int frictional_contact_out(frictional_contact_real t, const frictional_contact_real *x,
    const frictional_contact_real *u, const frictional_contact_real *p, frictional_contact_real *y);
/* The derivatives of the rates by the states, in the places of the pattern. */
int frictional_contact_jac(frictional_contact_real t, const frictional_contact_real *x,
    const frictional_contact_real *u, const frictional_contact_real *p, frictional_contact_real *J);
/* Column j of J has the rows row[k] for k from col[j] to col[j + 1] - 1. */
int frictional_contact_jac_pattern(int *row, int *col);
/* The states at the start, for these parameters. */
int frictional_contact_init(const frictional_contact_real *p, frictional_contact_real *x);
/* One step of size h: classical Runge-Kutta. */
int frictional_contact_step_rk4(frictional_contact_real t, frictional_contact_real h,
    frictional_contact_real *x, const frictional_contact_real *u, const frictional_contact_real *p);
/* One step of size h: Heun. */
int frictional_contact_step_heun(frictional_contact_real t, frictional_contact_real h,
    frictional_contact_real *x, const frictional_contact_real *u, const frictional_contact_real *p);
/* One step of size h: explicit Euler. */
int frictional_contact_step_euler(frictional_contact_real t, frictional_contact_real h,
    frictional_contact_real *x, const frictional_contact_real *u, const frictional_contact_real *p);

/* The parameters' defaults, and the names of all places in order, each ended by NUL. */
extern const frictional_contact_real frictional_contact_p0[];
extern const char frictional_contact_x_names[];
extern const char frictional_contact_u_names[];
extern const char frictional_contact_p_names[];
extern const char frictional_contact_y_names[];

#ifdef __cplusplus
}
#endif

#endif
