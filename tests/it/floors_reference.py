"""The least that a body feels within a travel, by linear programmes over forces that are constant on 120 and 240 steps.

Judge of tests/it/floors.rs. Needs scipy: python3 floors_reference.py > floors_reference.csv

Unknown is the force in each step. The approach of body and support is kept within the travel at the end of every step,
up to a horizon, long after the stop where no weight has to be borne then; no window of steps may have more impulse
than the criterion allows. The severity index is convex: its powers are bounded by tangents, so that this is a linear
programme, too. The support is a mass on a spring and a dashpot, whose response to a unit impulse is written down here
and integrated by Gauss's rule.

Steps of a constant force cost most where a window begins with a peak (s^-0.4): on a fixed support, where the least HIC
is known in closed form, errors fall as the length of the steps to the power 1.6. Both counts are printed.
"""

from math import cosh, cos, exp, sin, sinh, sqrt

import numpy as np
from scipy.optimize import linprog
from scipy.sparse import coo_matrix, csr_matrix, hstack, vstack

G0 = 9.80665
TANGENTS = 240

# name, mass, speed, gravity, travel, cap, support's mass (0: fixed), spring, dashpot, horizon in D/v0
CASES = [
    ("fixed", 10.0, 10.0, 0.0, 0.02, 0.015, 0.0, 0.0, 0.0, 4.0),
    ("weight", 8.0, 2.0, G0, 0.05, 1.0, 0.0, 0.0, 0.0, 3.05),
    ("short-window", 5.0, 4.0, 0.0, 0.06, 0.015, 0.0, 0.0, 0.0, 4.0),
    ("free-mass", 10.0, 10.0, 0.0, 0.02, 0.015, 90.0, 0.0, 0.0, 4.0),
    ("mounted", 10.0, 10.0, 0.0, 0.02, 0.015, 100.0, 50e6, 10e3, 4.0),
    ("soft-mount", 10.0, 10.0, 0.0, 0.02, 0.015, 30.0, 3e6, 1e3, 6.0),
]

NODES, WEIGHTS = np.polynomial.legendre.leggauss(6)


def response(mass, spring, dashpot):
    """Displacement after a unit impulse."""
    if mass == 0.0:
        return lambda t: 0.0
    if spring == 0.0:
        return lambda t: t / mass
    decay = dashpot / (2 * mass)
    square = spring / mass - decay**2
    omega = sqrt(abs(square))
    wave = sin if square > 0 else sinh
    return lambda t: exp(-decay * t) * wave(omega * t) / (mass * omega)


def approach(case, steps):
    """Free approach at the ends of steps, and what a unit force in a step takes off it."""
    _, mass, speed, gravity, travel, _, under, spring, dashpot, horizon = case
    length = horizon * travel / speed / steps
    own = response(under, spring, dashpot)
    kernel = [
        0.5 * length * sum(w * ((lag := length * (k + 0.5 - 0.5 * x)) / mass + own(lag)) for x, w in zip(NODES, WEIGHTS))
        for k in range(steps)
    ]
    times = length * np.arange(1, steps + 1)
    free = speed * times + 0.5 * gravity * times**2
    takes = np.array([[kernel[k - j] if j <= k else 0.0 for j in range(steps)] for k in range(steps)])
    return length, free, takes


def solved(cost, rows, most, bounds):
    found = linprog(cost, A_ub=rows, b_ub=most, bounds=bounds, method="highs")
    assert found.status == 0, found.message
    return found.fun


def peak(case, steps):
    """Unknowns: forces in units of m v0^2/D, and their largest."""
    _, mass, speed, _, travel, *_ = case
    _, free, takes = approach(case, steps)
    unit = mass * speed**2 / travel
    kept = hstack([csr_matrix(-takes * unit / travel), csr_matrix((steps, 1))])
    under = hstack([csr_matrix(np.eye(steps)), csr_matrix(-np.ones((steps, 1)))])
    rows = vstack([kept, under])
    most = np.concatenate([1 - free / travel, np.zeros(steps)])
    cost = np.append(np.zeros(steps), 1.0)
    return solved(cost, rows, most, [(0, None)] * (steps + 1)) * unit / mass


def hic(case, steps):
    """Unknowns: impulses up to the end of each step in units of m v0, and HIC^0.4."""
    _, mass, speed, _, travel, cap, *_ = case
    length, free, takes = approach(case, steps)
    unit = mass * speed / length
    difference = np.eye(steps) - np.eye(steps, k=-1)
    kept = hstack([csr_matrix(-takes @ difference * unit / travel), csr_matrix((steps, 1))])
    rising = hstack([csr_matrix(-difference), csr_matrix((steps, 1))])
    row, column, value = [], [], []
    count = 0
    for a in range(steps):
        for b in range(a + 1, steps + 1):
            window = (b - a) * length
            if window > cap * (1 + 1e-12):
                break
            row += [count, count]
            column += [b - 1, steps]
            value += [1.0, -G0 * window**0.6 / speed]
            if a:
                row.append(count)
                column.append(a - 1)
                value.append(-1.0)
            count += 1
    windows = coo_matrix((value, (row, column)), shape=(count, steps + 1))
    rows = vstack([kept, rising, windows])
    most = np.concatenate([1 - free / travel, np.zeros(steps + count)])
    cost = np.append(np.zeros(steps), 1.0)
    return solved(cost, rows, most, [(0, None)] * (steps + 1)) ** 2.5


def severity(case, steps):
    """Unknowns: forces in units of m v0^2/D, and their powers 2.5 above tangents."""
    _, mass, speed, _, travel, *_ = case
    length, free, takes = approach(case, steps)
    unit = mass * speed**2 / travel
    kept = hstack([csr_matrix(-takes * unit / travel), csr_matrix((steps, steps))])
    rows, most = [kept], [1 - free / travel]
    for at in np.linspace(0.02, 1.6, TANGENTS):
        slope = 2.5 * at**1.5
        rows.append(hstack([csr_matrix(slope * np.eye(steps)), csr_matrix(-np.eye(steps))]))
        most.append(np.full(steps, slope * at - at**2.5))
    cost = np.concatenate([np.zeros(steps), np.ones(steps)])
    least = solved(cost, vstack(rows), np.concatenate(most), [(0, None)] * (2 * steps))
    return least * length * (unit / mass / G0) ** 2.5


counted = [f"{name} of {steps}" for name in ("acceleration", "hic", "severity index") for steps in (120, 240)]
print("case,mass,speed,gravity,travel,cap,support mass,spring,dashpot", *counted, sep=",")
for case in CASES:
    values = [f"{least(case, steps):.10g}" for least in (peak, hic, severity) for steps in (120, 240)]
    print(",".join([case[0], *(f"{own:g}" if own != G0 else f"{own}" for own in case[1:9]), *values]), flush=True)
