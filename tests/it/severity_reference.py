"""Severity index and time of tension of the reference impact, at 30 digits.

Judge of tests/it/thesis.rs. Needs mpmath: python3 severity_reference.py
Prints: support damping [N s/m], time of tension [s], integral of (a/g)^2.5 up to it [s].
"""

from mpmath import eig, exp, findroot, lu_solve, matrix, mp, mpf, quad

mp.dps = 30
m1, m3 = 10, 100
K1 = K2 = mpf(20) * 10**6
C1, C2 = 4000, 6000
K3 = mpf(50) * 10**6
g = mpf("9.80665")

for C3, bracket in ((mpf(10) ** 4, (0.0070, 0.0078)), (mpf(10) ** 7, (0.0055, 0.0060))):
    # x1, v1, x2, v2, deformation of C2, deformation of the Kelvin element
    force = [K2, 0, -K2, 0, -K2, -K2]
    A = matrix(6, 6)
    A[0, 1] = A[2, 3] = 1
    for j in range(6):
        A[1, j], A[3, j] = -force[j] / m1, force[j] / m3
        A[4, j], A[5, j] = force[j] / C2, force[j] / C1
    A[3, 2] -= K3 / m3
    A[3, 3] -= C3 / m3
    A[5, 5] -= K1 / C1
    rates, modes = eig(A)
    start = lu_solve(modes, matrix([0, 10, 0, 0, 0, 0]))
    weights = [sum(force[i] * modes[i, k] for i in range(6)) * start[k] for k in range(6)]

    def F(t):
        return sum(weights[k] * exp(rates[k] * t) for k in range(6)).real

    tension = findroot(F, bracket, solver="anderson", tol=1e-18)
    pieces = [mpf(0)] + [tension * mpf(10) ** -k for k in range(6, 0, -1)]
    pieces += [tension * k / 20 for k in range(3, 21)]
    index = quad(lambda t: (abs(F(t)) / m1 / g) ** mpf("2.5"), pieces)
    print(mp.nstr(C3, 3), mp.nstr(tension, 16), mp.nstr(index, 16))
