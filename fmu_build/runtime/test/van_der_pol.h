/* How often van_der_pol.c was evaluated. */
#ifndef VAN_DER_POL_H
#define VAN_DER_POL_H

extern int derivative_calls, jacobian_calls;

#endif
