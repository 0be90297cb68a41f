/* Written by nsode: the augmented ODE of a model, in plain C. */
#ifndef diode_circuit_H
#define diode_circuit_H

#ifdef __cplusplus
extern "C" {
#endif

typedef double diode_circuit_real;

enum {
    diode_circuit_NX = 3,
    diode_circuit_NU = 0,
    diode_circuit_NP = 9,
    diode_circuit_NY = 2,
    diode_circuit_JAC_NNZ = 7
};

/* states */
enum {
    diode_circuit_X_i = 0,
    diode_circuit_X_vc = 1,
    diode_circuit_X_D_e = 2
};

/* parameters */
enum {
    diode_circuit_P_L = 0,
    diode_circuit_P_C = 1,
    diode_circuit_P_Rs = 2,
    diode_circuit_P_R = 3,
    diode_circuit_P_U = 4,
    diode_circuit_P_omega = 5,
    diode_circuit_P_D_K = 6,
    diode_circuit_P_D_alpha = 7,
    diode_circuit_P_D_beta = 8
};

/* outputs */
enum {
    diode_circuit_Y_load = 0,
    diode_circuit_Y_D = 1
};

/* What every function returns. From BROKEN on, a condition of the model does not hold (only in
   code compiled with diode_circuit_CHECKS): check number status - BROKEN of diode_circuit.json. */
enum {
    diode_circuit_OK = 0,
    diode_circuit_NOT_FINITE = 1,
    diode_circuit_SINGULAR = 2,
    diode_circuit_BROKEN = 16
};

/* A step leaves x untouched unless it returns 0. */

/* The rates dx of the states x at time t, for inputs u and parameters p. */
int diode_circuit_rhs(diode_circuit_real t, const diode_circuit_real *x, const diode_circuit_real
    *u, const diode_circuit_real *p, diode_circuit_real *dx);
/* The outputs y: the declared ones, then every force. */
int diode_circuit_out(diode_circuit_real t, const diode_circuit_real *x, const diode_circuit_real
    *u, const diode_circuit_real *p, diode_circuit_real *y);
/* The derivatives of the rates by the states, in the places of the pattern. */
int diode_circuit_jac(diode_circuit_real t, const diode_circuit_real *x, const diode_circuit_real
    *u, const diode_circuit_real *p, diode_circuit_real *J);
/* Column j of J has the rows row[k] for k from col[j] to col[j + 1] - 1. */
int diode_circuit_jac_pattern(int *row, int *col);
/* The states at the start, for these parameters. */
int diode_circuit_init(const diode_circuit_real *p, diode_circuit_real *x);
/* One step of size h: classical Runge-Kutta. */
int diode_circuit_step_rk4(diode_circuit_real t, diode_circuit_real h, diode_circuit_real *x,
    const diode_circuit_real *u, const diode_circuit_real *p);
/* One step of size h: Heun. */
int diode_circuit_step_heun(diode_circuit_real t, diode_circuit_real h, diode_circuit_real *x,
    const diode_circuit_real *u, const diode_circuit_real *p);
/* One step of size h: explicit Euler. */
int diode_circuit_step_euler(diode_circuit_real t, diode_circuit_real h, diode_circuit_real *x,
    const diode_circuit_real *u, const diode_circuit_real *p);

/* The parameters' defaults, and the names of all places in order, each ended by NUL. */
extern const diode_circuit_real diode_circuit_p0[];
extern const char diode_circuit_x_names[];
extern const char diode_circuit_u_names[];
extern const char diode_circuit_p_names[];
extern const char diode_circuit_y_names[];

#ifdef __cplusplus
}
#endif

#endif
