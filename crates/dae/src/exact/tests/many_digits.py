"""Reference values for hard.rs, with 60 digits (needs mpmath; run: python3 many_digits.py).

The matrices are built from doubles, exactly as the tests build them, and then taken as exact.
"""

from mpmath import mp, mpf, matrix, eig, lu_solve, exp, re

mp.dps = 60


def solve(rows, initial, times, outputs):
    size = len(rows)
    a = matrix(size, size)
    for i in range(size):
        for j in range(size):
            a[i, j] = mpf(rows[i][j])
    rates, modes = eig(a)
    start = lu_solve(modes, matrix([mpf(z) for z in initial]))
    for t in times:
        weights = [start[j] * exp(rates[j] * mpf(t)) for j in range(size)]
        values = [re(sum(modes[i, j] * weights[j] for j in range(size))) for i in outputs]
        print("   ", t, [mp.nstr(v, 18) for v in values])


def maxwell_branches(relaxation_times):
    count = len(relaxation_times)
    rows = [[0.0] * (count + 2) for _ in range(count + 2)]
    rows[0][1] = 1.0
    rows[1][0] = -float(count)
    for k, tau in enumerate(relaxation_times):
        rows[1][2 + k] = 1.0
        rows[2 + k][0] = 1.0 / tau
        rows[2 + k][2 + k] = -(1.0 / tau)
    return rows


def chain(count):
    """Masses 1 + k/8 between springs and dashpots whose values jump about."""
    rows = [[0.0] * (2 * count) for _ in range(2 * count)]
    stiffness = [1.0 + (k * 7) % 11 for k in range(count + 1)]
    damping = [0.0625 * (1 + (k * 5) % 7) for k in range(count + 1)]
    for k in range(count):
        mass = 1.0 + 0.125 * k
        rows[k][count + k] = 1.0
        for offset, values in ((0, stiffness), (count, damping)):
            row = rows[count + k]
            row[offset + k] = -(values[k] + values[k + 1]) / mass
            if k > 0:
                row[offset + k - 1] = values[k] / mass
            if k + 1 < count:
                row[offset + k + 1] = values[k + 1] / mass
    return rows


print("thirteen decades of relaxation times: x, v")
decades = [1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1, 1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6]
solve(
    maxwell_branches(decades), [0.0, 1.0] + [0.0] * 13, [1e-3, 1.0, 30.0, 1e3, 1e5, 1e6], [0, 1]
)
print("relaxation times 1e-9 and 1e3: x, v")
solve(maxwell_branches([1e-9, 1e3]), [0.0, 1.0, 0.0, 0.0], [1e-9, 1.0, 100.0, 1e4], [0, 1])
print("mass ratio 1e12: light and heavy place")
heavy = [
    [0.0, 0.0, 1.0, 0.0],
    [0.0, 0.0, 0.0, 1.0],
    [-2e12, 1e12, 0.0, 0.0],
    [1.0, -2.0, 0.0, 0.0],
]
solve(heavy, [0.0, 0.0, 0.0, 1.0], [1e-6, 0.125, 1.0], [0, 1])
print("chain of fifteen masses: first and last place")
solve(chain(15), [0.0] * 15 + [1.0] + [0.0] * 14, [0.5, 5.0, 50.0], [0, 14])
