"""Makes the records of docs/jobs/parcel.md: a platen of 4 kg that falls from 30, 45 and 60 cm onto a block of foam, 50 mm thick
with 100 cm2, by its acceleration over time.

The foam is that of Avalle, Belingardi and Ibba with 500 kPa, 30 kPa and 8 kPa, beside a dashpot of 0.2 kPa s; its equation of
motion, with the weight, is integrated by the classical Runge-Kutta method. Noise of 0.2 g, the zero of the accelerometer and the
clock have a fixed seed.
"""

import math
import random

stream = random.Random(8)
G0 = 9.80665


def stress(strain, rate):
    elastic = 30e3 * (1 - math.exp(-500e3 * strain / 30e3)) + 8e3 * (strain / (1 - strain)) ** 2
    return elastic + 200.0 * rate


def record(height):
    mass, thickness, area, step, every = 4.0, 50e-3, 100e-4, 2e-6, 50

    def force(state):
        return area * stress(max(state[0], 0.0) / thickness, state[1] / thickness)

    def rates(state):
        return (state[1], G0 - force(state) / mass)

    state, readings, at = (0.0, math.sqrt(2 * G0 * height)), [], 0
    while force(state) > 0:
        if at % every == 0:
            readings.append(force(state) / mass / G0)
        k1 = rates(state)
        k2 = rates([s + step / 2 * k for s, k in zip(state, k1)])
        k3 = rates([s + step / 2 * k for s, k in zip(state, k2)])
        k4 = rates([s + step * k for s, k in zip(state, k3)])
        state = [s + step / 6 * (a + 2 * b + 2 * c + d) for s, a, b, c, d in zip(state, k1, k2, k3, k4)]
        at += 1
    zero, before = stream.gauss(0, 0.2), 30
    rows = ["t [ms],A [g0]"]
    for at in range(before + len(readings) + 60):
        index = at - before
        reading = readings[index] if 0 <= index < len(readings) else 0.0
        rows.append(f"{at / 10:.1f},{reading + zero + stream.gauss(0, 0.2):.3f}")
    return rows


for height, name in [(0.30, "low"), (0.45, "middle"), (0.60, "high")]:
    with open(f"parcel-rig-{name}.csv", "w", encoding="utf-8") as file:
        file.write("\n".join(record(height)) + "\n")
